#pragma once
// Eye rays that miss the stone: through the points of the table's pattern of samples.

#include "render/raytable/leaf_lights.h"
#include "render/raytable/table_key.h"
#include "render/reference/sampling.h"

namespace culet {

class AirRayMaker {
public:
    /// Keeps a reference to the camera. `middle`: of the origins.
    AirRayMaker(const Scene& scene, const TableRays& rays, const Vec3& middle);

    /// Ray of the table, about the stone's own origin.
    EyeRay eye_ray(std::uint32_t ray) const;

    /// Makes room for so many rays, and has none.
    void start(AirRays& rays, std::size_t most) const;
    /// Adds a pixel's ray; false where the camera has none there.
    bool add(int x, int y, int sample, AirRays& rays) const;

private:
    const Camera& camera_;
    EyeRays eyes_;
    std::vector<SamplePoint> pattern_;
    Vec3 middle_;
    // A pinhole's rays, before they are brought to length 1: at the picture's corner, and how they
    // change from pixel to pixel. Origins likewise.
    bool plain_ = false;
    std::array<float, 3> direction_{}, direction_x_{}, direction_y_{};
    std::array<float, 3> origin_{}, origin_x_{}, origin_y_{};
};

}  // namespace culet
