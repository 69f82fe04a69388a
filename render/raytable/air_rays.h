#pragma once
// Eye rays that miss the stone: through the points of the table's pattern of samples.

#include "render/raytable/exit_lights.h"
#include "render/raytable/table_key.h"
#include "render/reference/sampling.h"

namespace culet {

/// A ray of a row: its pixel, and its place in the pattern. After AirRayMaker::make x is below 0
/// where the camera has no ray there.
struct RaySample {
    int x = 0, sample = 0;
};

class AirRayMaker {
public:
    /// Keeps a reference to the camera. `middle`: of the origins.
    AirRayMaker(const Scene& scene, const TableRays& rays, const Vec3& middle);

    /// The rays of some samples of a row, in their order; origins only where they are asked for.
    void make(int y, std::vector<RaySample>& samples, bool origins, AirRays& rays) const;

private:
    void make_plain(int y, const std::vector<RaySample>& samples, bool origins,
                    AirRays& rays) const;

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
