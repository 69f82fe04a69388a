#pragma once
// What a ray table depends on, in four parts, so that a mismatch can be named. Lights and
// absorption are not included: they may differ.

#include <string>

#include "render/raytable/ray_table.h"
#include "render/reference/prepared_scene.h"

namespace culet {

/// The rays of a scene, and the optics that their paths depend on.
struct TableRays {
    OpticalSetup setup;       ///< of the scene to draw
    std::vector<Band> bands;  ///< of the table: one if all wavelengths follow the same paths
    PathLimits limits;
    int samples = 1;
};

/// Rays per pixel if the scene names none.
constexpr int k_table_samples = 1;
/// Weight at which branching paths end if the scene names none.
constexpr double k_table_cut = 1e-3;

/// Uses the scene's wavelengths; if none, `wavelengths_nm` (of a table with dispersion); if these
/// are empty, as many as make_optical_setup takes. Nothing depends on the lights, which may change:
/// a tolerance cuts paths by weight alone, at k_table_cut if they branch, else at a twentieth of
/// the tolerance, at most k_table_cut.
TableRays table_rays(const Scene& scene, std::span<const double> wavelengths_nm = {});

/// Why this kind of scene has no ray table, to be continued with ": say engine = ..."; empty if it
/// has one.
std::string refused_by_table(const Scene& scene, const OpticalSetup& setup);

/// The keys of a scene's table, in an otherwise empty header.
RayTableHeader keys_of(const Scene& scene, const TableRays& rays);

/// What differs between the scene and the table, in words; empty if they fit.
std::string difference_to(const RayTableHeader& table, const Scene& scene, const TableRays& rays);

}  // namespace culet
