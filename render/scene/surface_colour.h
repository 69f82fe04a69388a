#pragma once
// A surface's colour as RGB.

#include "render/scene/objects.h"

namespace culet {

inline Rgb rgb_of(const SurfaceColour& colour) {
    if (const double* grey = std::get_if<double>(&colour.value)) return {*grey, *grey, *grey};
    return std::get<Rgb>(colour.value);
}

}  // namespace culet
