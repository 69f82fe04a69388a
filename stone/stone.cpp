#include "stone/stone.h"

#include <fmt/format.h>

#include "stone/gemcad/gemcad_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/text/errors.h"

namespace culet {

std::string doubtful_size(const Solid& solid) {
    // The smallest cut stones are half a millimetre wide, the largest below 0.2 m.
    constexpr double k_least_mm = 0.3, k_largest_mm = 200, k_mm_per_m = 1000;
    const double across = diameter(solid);
    if (!(across > 0) || (across >= k_least_mm && across <= k_largest_mm)) return {};
    const bool metres = across < k_largest_mm / k_mm_per_m && k_mm_per_m * across >= k_least_mm;
    return fmt::format(
        "is {:.4g} across: no stone is so {} in mm; {}name the unit of the mesh in the "
        "stone file (unit = \"m\", \"cm\", \"in\")",
        across, across < k_least_mm ? "small" : "large",
        metres ? fmt::format("if it is in metres, {:.4g} mm across, ", k_mm_per_m * across) : "");
}

void require_solid_name(const std::filesystem::path& file) {
    if (!is_cut(file) && !mesh_format(file)) {
        throw InputError(
            file,
            "cannot be written: the name must end in .obj, .off, .ply, .stl, .asc, .gem "
            "or .gcs");
    }
}

std::vector<std::string> write_solid(const Solid& solid, const std::filesystem::path& file) {
    require_solid_name(file);
    if (!mesh_format(file)) return write_cut(solid, solid.design ? *solid.design : Design{}, file);
    write_mesh(solid, file);
    return {};
}

}  // namespace culet
