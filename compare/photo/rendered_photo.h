#pragma once
// A render used as a photograph.

#include "compare/photo/photo.h"
#include "render/render.h"

namespace culet {

/// As a perfect camera would have taken it: linear, with its coverage.
Photo photo_of(const Picture& picture);

}  // namespace culet
