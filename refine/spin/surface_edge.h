#pragma once

namespace culet {

/// A straight edge of an upright stone's surface: across `azimuth`, at `radius` from the axis.
struct SurfaceEdge {
    double azimuth = 0, radius = 0, height = 0;
    double strength = 0;  ///< robust standard deviations above the rest of the sweep
};

}  // namespace culet
