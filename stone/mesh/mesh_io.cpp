#include "stone/mesh/mesh_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "stone/mesh/mesh_formats.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

constexpr std::string_view k_design = "culet design ";

MeshFormat format_to_write(const std::filesystem::path& file) {
    const auto format = mesh_format(file);
    if (!format) {
        throw InputError(file, "cannot be written: a mesh must end in .obj, .off, .ply or .stl");
    }
    return *format;
}

}  // namespace

std::optional<MeshFormat> mesh_format(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    if (extension == "obj") return MeshFormat::obj;
    if (extension == "off") return MeshFormat::off;
    if (extension == "ply") return MeshFormat::ply;
    if (extension == "stl") return MeshFormat::stl;
    return std::nullopt;
}

FaceSoup soup_of(std::string_view bytes, MeshFormat format, const std::filesystem::path& file) {
    switch (format) {
        case MeshFormat::obj:
            return parse_obj(bytes, file);
        case MeshFormat::off:
            return parse_off(bytes, file);
        case MeshFormat::ply:
            return parse_ply(bytes, file);
        case MeshFormat::stl:
            return parse_stl(bytes, file);
    }
    throw InternalError("unknown mesh format");
}

ReadSolid parse_mesh(std::string_view bytes, MeshFormat format, const std::filesystem::path& file) {
    return solid_from_faces(soup_of(bytes, format, file));
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

std::string mesh_text(const Solid& solid, MeshFormat format, bool with_planes) {
    switch (format) {
        case MeshFormat::obj:
            return obj_text(solid, with_planes);
        case MeshFormat::off:
            return off_text(solid, with_planes);
        case MeshFormat::ply:
            return ply_text(solid, with_planes);
        case MeshFormat::stl:
            return stl_text(solid);
    }
    throw InternalError("unknown mesh format");
}

void write_design(const Solid& solid, const std::string& design,
                  const std::filesystem::path& file) {
    const auto format = mesh_format(file);
    if (!format || *format == MeshFormat::stl) return write_mesh(solid, file);
    std::string text = mesh_text(solid, *format);
    // In OFF and PLY, comments follow the lines that state the format.
    const std::size_t lines = *format == MeshFormat::obj ? 0 : *format == MeshFormat::off ? 1 : 2;
    std::size_t at = 0;
    for (std::size_t i = 0; i < lines; ++i) at = text.find('\n', at) + 1;
    const char* sign = *format == MeshFormat::ply ? "comment " : "# ";
    text.insert(at, std::string(sign).append(k_design).append(design).append("\n"));
    write_text(file, text);
}

std::optional<std::string> design_of(const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    if (extension == "asc" || extension == "gem") return "GemCad";
    std::ifstream stream(file, std::ios::binary);
    constexpr int k_first_lines = 5;
    std::string bytes(4096, '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    try {
        const std::string text = decoded_text(bytes, file);
        LineReader lines(text);
        for (int i = 0; i < k_first_lines; ++i) {
            const std::string_view line = lines.next().value_or("");
            const std::size_t at = line.find(k_design);
            if (at == std::string::npos || (line[0] != '#' && line[0] != 'c')) continue;
            return std::string(line.substr(at + k_design.size()));
        }
    } catch (const InputError&) {
        // The file is not text, so it has no comments.
    }
    return std::nullopt;
}

void write_mesh(const Solid& solid, const std::filesystem::path& file) {
    write_text(file, mesh_text(solid, format_to_write(file)));
}

void write_surface(const Solid& surface, const std::filesystem::path& file) {
    write_text(file, mesh_text(surface, format_to_write(file), false));
}

}  // namespace culet
