#include "stone/solid_input.h"

#include "stone/errors.h"
#include "stone/file_kind.h"
#include "stone/mesh_io.h"
#include "stone/output_file.h"

namespace culet {

bool is_solid_file(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    return mesh_format(file).has_value() || extension == "asc" || extension == "gem";
}

SolidInput load_solid(const std::filesystem::path& file, const CutReading& how) {
    SolidInput input;
    input.format = extension_of(file);
    if (input.format == "asc" || input.format == "gem") {
        ReadCut cut =
            input.format == "asc" ? read_gemcad_asc(file, how) : read_gemcad_gem(file, how);
        input.solid = std::move(cut.solid);
        input.notes = std::move(cut.notes);
        input.details = std::move(cut.details);
        input.sheet = std::move(cut.sheet);
        input.unused_planes = std::move(cut.unused_planes);
        input.repeated_planes = std::move(cut.repeated_planes);
        return input;
    }
    if (!is_solid_file(file)) {
        if (const std::string other = foreign_kind_of(file); !other.empty())
            throw InputError(file, other);
        throw InputError(file,
                         "is of an unknown kind: a mesh or cut ends in .obj, .off, .ply, "
                         ".stl, .asc or .gem");
    }
    ReadSolid mesh = read_mesh(file);
    input.solid = std::move(mesh.solid);
    input.notes = std::move(mesh.notes);
    return input;
}

}  // namespace culet
