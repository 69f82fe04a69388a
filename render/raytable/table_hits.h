#pragma once
// The eye rays of a ray table and where they meet the stone.

#include <cstdint>
#include <vector>

#include "render/geometry/stone_body.h"
#include "render/raytable/table_key.h"
#include "render/reference/sampling.h"

namespace culet {

struct TableHit {
    std::uint32_t ray = 0;  ///< (y width + x) samples + sample
    BodyHit entry;
};

class TableEyes {
public:
    TableEyes(const Scene& scene, const TableRays& rays)
        : eyes_(scene.camera),
          pattern_(sample_pattern(rays.samples, rays.setup.on(Effects::aperture),
                                  scene.settings.filter, scene.settings.filter_radius)),
          width_(static_cast<std::uint32_t>(scene.camera.width)) {}

    EyeRay ray(std::uint32_t number) const {
        const SamplePoint& p = sample(number);
        return eyes_.through(x(number) + p.x, y(number) + p.y, p.pupil_x, p.pupil_y);
    }
    EyeFrame frame(const Vec3& direction) const { return eyes_.frame(direction); }
    const std::vector<SamplePoint>& pattern() const { return pattern_; }

    /// Hits of a row, in the order of their rays.
    std::vector<TableHit> hits(int row, const StoneBody& body) const {
        std::vector<TableHit> hits;
        EntryGuess last;
        const std::uint32_t rays = width_ * samples(),
                            first = static_cast<std::uint32_t>(row) * rays;
        for (std::uint32_t number = first; number - first < rays; ++number) {
            const SamplePoint& p = sample(number);
            if (!eyes_.sees(x(number) + p.x, y(number) + p.y)) continue;
            const EyeRay eye = ray(number);
            if (const auto entry = body.entry(eye.origin, eye.direction, last))
                hits.push_back({number, *entry});
        }
        return hits;
    }

private:
    std::uint32_t samples() const { return static_cast<std::uint32_t>(pattern_.size()); }
    const SamplePoint& sample(std::uint32_t ray) const { return pattern_[ray % samples()]; }
    std::uint32_t x(std::uint32_t ray) const { return ray / samples() % width_; }
    std::uint32_t y(std::uint32_t ray) const { return ray / samples() / width_; }

    EyeRays eyes_;
    std::vector<SamplePoint> pattern_;
    std::uint32_t width_;
};

}  // namespace culet
