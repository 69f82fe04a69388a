#pragma once
// A render in a photograph's place.

#include "compare/photo/photo.h"
#include "render/render.h"

namespace culet {

/// The render as a camera without fault would have taken it: linear, with its coverage.
Photo photo_of(const Picture& picture);

}  // namespace culet
