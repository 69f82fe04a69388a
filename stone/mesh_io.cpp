#include "stone/mesh_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "stone/errors.h"
#include "stone/mesh_formats.h"
#include "stone/output_file.h"

namespace culet {

std::optional<MeshFormat> mesh_format(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".obj") return MeshFormat::obj;
    if (extension == ".off") return MeshFormat::off;
    if (extension == ".ply") return MeshFormat::ply;
    if (extension == ".stl") return MeshFormat::stl;
    return std::nullopt;
}

ReadSolid parse_mesh(std::string_view bytes, MeshFormat format, const std::filesystem::path& file) {
    switch (format) {
        case MeshFormat::obj:
            return solid_from_faces(parse_obj(bytes, file));
        case MeshFormat::off:
            return solid_from_faces(parse_off(bytes, file));
        case MeshFormat::ply:
            return solid_from_faces(parse_ply(bytes, file));
        case MeshFormat::stl:
            return solid_from_faces(parse_stl(bytes, file));
    }
    throw InternalError("unknown mesh format");
}

ReadSolid read_mesh(const std::filesystem::path& file) {
    const auto format = mesh_format(file);
    if (!format) {
        throw InputError(file, "is of an unknown kind: a mesh ends in .obj, .off, .ply or .stl");
    }
    const std::string bytes = read_text(file);
    if (bytes.empty()) throw InputError(file, "is empty");
    return parse_mesh(bytes, *format, file);
}

std::string mesh_text(const Solid& solid, MeshFormat format) {
    switch (format) {
        case MeshFormat::obj:
            return obj_text(solid);
        case MeshFormat::off:
            return off_text(solid);
        case MeshFormat::ply:
            return ply_text(solid);
        case MeshFormat::stl:
            return stl_text(solid);
    }
    throw InternalError("unknown mesh format");
}

void write_mesh(const Solid& solid, const std::filesystem::path& file) {
    const auto format = mesh_format(file);
    if (!format) {
        throw InputError(file, "cannot be written: a mesh must end in .obj, .off, .ply or .stl");
    }
    write_text(file, mesh_text(solid, *format));
}

}  // namespace culet
