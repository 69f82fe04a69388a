#pragma once
// Eye rays that miss the stone, at the sample points of the table.

#include "render/raytable/exit_lights.h"
#include "render/raytable/table_key.h"
#include "render/reference/sampling.h"

namespace culet {

/// A ray of a row: its pixel and its sample point. AirRayMaker::make sets x below 0 if the camera
/// has no ray there.
struct RaySample {
    int x = 0, sample = 0;
};

class AirRayMaker {
public:
    /// Keeps a reference to the camera. Ray origins are relative to `middle`.
    AirRayMaker(const Scene& scene, const TableRays& rays, const Vec3& middle);

    /// Makes the rays of some samples of a row, in their order; origins only on request.
    void make(int y, std::vector<RaySample>& samples, bool origins, AirRays& rays) const;

private:
    void make_plain(int y, const std::vector<RaySample>& samples, bool origins,
                    AirRays& rays) const;

    const Camera& camera_;
    EyeRays eyes_;
    std::vector<SamplePoint> pattern_;
    Vec3 middle_;
    // A pinhole's rays before normalisation: at the picture's corner, and their change from pixel
    // to pixel. Likewise the origins.
    bool plain_ = false;
    std::array<float, 3> direction_{}, direction_x_{}, direction_y_{};
    std::array<float, 3> origin_{}, origin_x_{}, origin_y_{};
};

}  // namespace culet
