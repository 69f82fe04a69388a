#include "stone/solid_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/mesh/face_soup.h"
#include "stone/mesh/mesh_formats.h"
#include "stone/mesh/mesh_io.h"
#include "stone/mesh/surface_mesh.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"
#include "stone/upright.h"

namespace culet {

namespace {

// Larger or smaller solids overflow a double: areas are raised to the fourth power before a root is
// taken, and edges may be 1e-13 of the whole.
constexpr double k_largest_coordinate = 1e50, k_smallest_extent = 1e-50;

void require_sane_size(const Solid& solid, const std::filesystem::path& file) {
    if (solid.vertices.empty()) return;
    double largest = 0, extent = 0;
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)}) {
        extent = std::max(extent, width_along(solid, axis));
        for (const Vec3& v : solid.vertices)
            largest = std::max(largest, std::abs(glm::dot(axis, v)));
    }
    if (largest > k_largest_coordinate || (extent > 0 && extent < k_smallest_extent)) {
        throw InputError(file,
                         fmt::format("has coordinates up to {:.2g} and is {:.2g} across: sizes "
                                     "from {:g} to {:g} can be computed; write it in another unit",
                                     largest, extent, k_smallest_extent, k_largest_coordinate));
    }
}

// glTF has metres in single precision (specification, 3.4 and 3.6.2); a stone has millimetres.
ReadSolid solid_of_gltf(const std::filesystem::path& file) {
    const TriangleMesh mesh = read_triangle_mesh(file);
    FaceSoup soup;
    for (const Vec3& v : mesh.vertices) {
        soup.vertices.push_back(mm_per(LengthUnit::m) * v);
        for (int k = 0; k < 3; ++k) soup.precision.add_single(soup.vertices.back()[k]);
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        SoupFace& face = soup.faces.emplace_back();
        face.corners.assign(mesh.triangles[t].begin(), mesh.triangles[t].end());
        const std::string& name = mesh.facets[t];
        if (name.empty()) continue;
        if (soup.names.empty() || soup.names.back() != name) soup.names.push_back(name);
        face.name = int(soup.names.size()) - 1;
    }
    return solid_from_faces(std::move(soup));
}

void turn_table_up(SolidInput& input) {
    const std::optional<int> table = table_by_shape(input.solid);
    if (!table) return;
    const auto at = static_cast<std::size_t>(*table);
    const Facet& facet = input.solid.facets[at];
    const Vec3 up = axis_near(facet.plane.normal);
    if (up == Vec3{0, 0, 1}) return;
    const std::string why =
        fmt::format("its table, facet {}, faces {}: the stone was turned so that it faces up (+z)",
                    shown(facet.name), words_for_direction(up));
    input.notes.push_back(
        why +
        "; should the stone stand as the file has it, say so in a stone file: up = [0, 0, 1]");
    const auto off_up = [&] {
        return degrees(angle_between(input.solid.facets[at].plane.normal, {0, 0, 1}));
    };
    const double before = off_up();
    input.solid = turned(std::move(input.solid), turn_upright(up));
    input.file_up = up;
    input.changed.push_back(
        {"mesh turned upright", why, before, off_up(), "degrees of the table off +z"});
}

// `held`: the file's bytes; null: read them.
SolidInput solid_in(const std::filesystem::path& file, const std::string* held,
                    const CutReading& how, Orientation standing) {
    SolidInput input;
    input.format = extension_of(file);
    if (is_cut(file)) {
        ReadCut cut = held == nullptr ? read_cut(file, how) : parse_cut(*held, how, file);
        input.solid = std::move(cut.solid);
        input.notes = std::move(cut.notes);
        input.details = std::move(cut.details);
        input.unused_planes = std::move(cut.unused_planes);
        input.repeated_planes = std::move(cut.repeated_planes);
        input.facets_are_whole = true;
        require_sane_size(input.solid, file);
        return input;
    }
    const auto format = mesh_format(file);
    if (held != nullptr && !format)
        throw InputError(file, "is not read here: .obj, .off, .ply, .stl, .asc and .gem are");
    if (!format && !is_gltf(file) && !is_step(file)) {
        require_file(file);
        if (const std::string other = foreign_kind_of(file); !other.empty())
            throw InputError(file, other);
        throw InputError(file,
                         "is of an unknown kind: a mesh or cut ends in .obj, .off, .ply, "
                         ".stl, .gltf, .glb, .step, .asc, .gem or .gcs");
    }
    ReadSolid mesh = held != nullptr ? parse_mesh(*held, *format, file)
                     : is_gltf(file) ? solid_of_gltf(file)
                     : is_step(file) ? solid_from_faces(read_step(file))
                                     : read_mesh(file);
    input.solid = std::move(mesh.solid);
    input.notes = std::move(mesh.notes);
    input.changed = std::move(mesh.changed);
    input.facets_are_whole = mesh.planes_stated;
    require_sane_size(input.solid, file);
    if (standing == Orientation::upright) turn_table_up(input);
    return input;
}

SolidFile solid_file(SolidInput input) {
    return {std::move(input.solid), std::move(input.notes), std::move(input.details),
            input.facets_are_whole, input.file_up,          std::move(input.changed)};
}

}  // namespace

bool is_solid_file(const std::filesystem::path& file) {
    return mesh_format(file).has_value() || is_gltf(file) || is_step(file) || is_cut(file);
}

SolidInput load_solid(const std::filesystem::path& file, const CutReading& how) {
    SolidInput input = solid_in(file, nullptr, how, Orientation::upright);
    if (std::string odd = doubtful_size(input.solid); !odd.empty() && !is_cut(file))
        input.notes.push_back(std::move(odd));
    return input;
}

void withdraw_size_doubt(const Solid& solid, std::vector<std::string>& notes) {
    // Some notes begin with the file's name.
    if (const std::string odd = doubtful_size(solid); !odd.empty())
        std::erase_if(notes, [&](const std::string& note) { return note.ends_with(odd); });
}

SolidFile read_solid(const std::filesystem::path& file, Orientation standing) {
    return solid_file(solid_in(file, nullptr, {}, standing));
}

SolidFile solid_of_bytes(const std::string& bytes, const std::filesystem::path& file) {
    return solid_file(solid_in(file, &bytes, {}, Orientation::upright));
}

}  // namespace culet
