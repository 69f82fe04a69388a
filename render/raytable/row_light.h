#pragma once
// The light of one row of a picture made from a ray table: from exit events, and past the stone.

#include "render/raytable/air_rays.h"
#include "render/raytable/exit_shader.h"

namespace culet {

/// One thread's memory, kept from row to row.
struct RowMemory {
    std::vector<float> stone, air;  // planes, one per node
    std::vector<float> block, weight, colour;
    std::vector<int> stone_rays;  // per pixel
    std::vector<int> hit_pixel;   // per hit; -1: something is nearer than the stone
    std::vector<RaySample> bare_samples, hit_samples;
    AirRays bare;
};

class RowLight {
public:
    /// Keeps references. `origins`: there are near lights or objects, so that the origin of a ray
    /// past the stone matters.
    RowLight(const RayTable& table, const Scene& scene, const TableRays& rays,
             const ExitShader& shader, bool origins);

    /// Adds the light of hits first .. last - 1 at the nodes of a band to `memory.stone`, at the
    /// pixels of `memory.hit_pixel`. Returns their weight after absorption, summed over nodes.
    double add_exits(std::size_t band, std::size_t first, std::size_t last,
                     RowMemory& memory) const;
    /// Adds what the rays `memory.bare_samples` see to `memory.air`.
    void add_air(int y, RowMemory& memory) const;

    const AirRayMaker& air() const { return air_; }

private:
    void use_factors(const std::uint32_t* end, std::size_t hits, std::uint32_t begin,
                     RowMemory& memory) const;
    ExitRun run_of(std::uint32_t from, std::uint32_t to) const;

    const RayTable& table_;
    const RenderSettings& settings_;
    const TableRays& rays_;
    const ExitShader& shader_;
    AirRayMaker air_;
    int width_;
    bool origins_;
};

}  // namespace culet
