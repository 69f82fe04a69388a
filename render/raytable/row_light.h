#pragma once
// The light of one row of a picture that a ray table makes: what its leaves bring, and what is seen
// past the stone.

#include "render/raytable/air_rays.h"
#include "render/raytable/exit_shader.h"

namespace culet {

/// What one thread keeps from row to row.
struct RowMemory {
    std::vector<float> stone, air;  // planes, one a node
    std::vector<float> block, weight, colour;
    std::vector<int> stone_rays;  // of each pixel
    std::vector<int> hit_pixel;   // of each hit; -1: something is nearer than the stone
    std::vector<RaySample> bare_samples, hit_samples;
    AirRays bare;
};

class RowLight {
public:
    /// Keeps references. `origins`: near things are looked for, so that it matters where a ray
    /// past the stone starts.
    RowLight(const RayTable& table, const Scene& scene, const TableRays& rays,
             const ExitShader& shader, bool origins);

    /// Adds what the leaves of the hits first .. last - 1 bring at the nodes of a band to
    /// `memory.stone`, where `memory.hit_pixel` says; returns their weight after absorption, summed
    /// over nodes.
    double add_leaves(std::size_t band, std::size_t first, std::size_t last,
                      RowMemory& memory) const;
    /// Adds what `memory.bare_samples` see to `memory.air`.
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
