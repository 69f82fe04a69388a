#include "stone/file_kind.h"

#include "stone/solid_input.h"
#include "stone/text/text_scan.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace {

FileKind kind_of_toml(const std::filesystem::path& file,
                      const std::vector<std::string>& overrides) {
    const TomlTable root = read_toml(file, overrides);
    if (root.has("fit") && !root.has("stone")) return FileKind::job;
    if (root.has("camera") || root.has("light")) return FileKind::scene;
    if (root.kind("stone") == TomlTable::Kind::table) return FileKind::stone;
    // A job's [render] names a scene; a scene's [render] holds settings.
    if (root.kind("render") == TomlTable::Kind::table && root.table("render")->has("scene"))
        return FileKind::job;
    if (root.has("render")) return FileKind::scene;
    if (root.has("stone") || root.has("mesh")) return FileKind::scene;
    return root.has("material") ? FileKind::material : FileKind::unknown;
}

}  // namespace

FileKind kind_of(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    if (is_solid_file(file)) return FileKind::solid;
    const std::string extension = extension_of(file);
    if (extension == "toml") return kind_of_toml(file, overrides);
    if (extension == "csv") return FileKind::table;
    // Include pictures that culet cannot read: the picture reader reports them.
    for (const char* picture : {"exr", "hdr", "pfm", "png", "jpg", "jpeg", "tif", "tiff", "heic",
                                "heif", "avif", "webp", "gif", "bmp", "jxl", "jp2", "psd", "ppm"}) {
        if (extension == picture) return FileKind::picture;
    }
    return FileKind::unknown;
}

const char* words_for(FileKind kind) {
    switch (kind) {
        case FileKind::solid:
            return "a mesh or cut design";
        case FileKind::stone:
            return "a stone file";
        case FileKind::scene:
            return "a scene";
        case FileKind::job:
            return "a job";
        case FileKind::material:
            return "a material";
        case FileKind::picture:
            return "a picture";
        case FileKind::table:
            return "a table of readings";
        case FileKind::unknown:
            break;
    }
    return "of an unknown kind";
}

}  // namespace culet
