#pragma once
// Whether the light from a ball's photographs can be trusted.

#include "compare/light_probe/light_probe.h"

namespace culet {

/// Sets the disagreement, the notes for people, and `doubt`.
void assess(LightProbe& probe);

}  // namespace culet
