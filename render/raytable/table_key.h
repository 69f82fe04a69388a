#pragma once
// What a ray table was made of, in four parts, so that another scene's table is told by what
// differs. Lights and absorption are not among them: they may be others.

#include <string>

#include "render/raytable/ray_table.h"
#include "render/reference/prepared_scene.h"

namespace culet {

/// The rays that a scene asks for, and the optics that their paths depend on.
struct TableRays {
    OpticalSetup setup;       ///< of the scene that is drawn
    std::vector<Band> bands;  ///< of the table: one where all wavelengths go the same way
    PathLimits limits;
    int samples = 1;
};

/// Rays a pixel where the scene does not say.
constexpr int k_table_samples = 1;
/// Weight below which a path that branches is not followed, where the scene does not say.
constexpr double k_table_cut = 1e-3;

/// Wavelengths are the scene's, or where it names none `wavelengths_nm` (of a table with
/// dispersion), or where these are empty as many as make_optical_setup takes: nothing is chosen by
/// the lights, which may be others for the same table. Likewise a tolerance cuts paths by their
/// weight alone: k_table_cut where they branch, else a twentieth of it, k_table_cut at most.
TableRays table_rays(const Scene& scene, std::span<const double> wavelengths_nm = {});

/// Why scenes of this kind have no ray table, in words that go on with ": say engine = ..."; empty:
/// they have.
std::string refused_by_table(const Scene& scene, const OpticalSetup& setup);

/// The keys of a scene's table, in a header that is empty otherwise.
RayTableHeader keys_of(const Scene& scene, const TableRays& rays);

/// What of the scene is not as the table has it, in words; empty: they fit.
std::string difference_to(const RayTableHeader& table, const Scene& scene, const TableRays& rays);

}  // namespace culet
