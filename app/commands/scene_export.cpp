#include "app/commands/scene_export.h"

#include <fmt/format.h>

#include "render/export/mitsuba.h"
#include "render/export/pbrt.h"
#include "render/export/povray.h"
#include "render/image/image_io.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

ExportedScene exported(const Scene& scene, const std::filesystem::path& out) {
    if (extension_of(out) == "xml") return mitsuba_scene(scene, out.stem().string());
    if (extension_of(out) == "pbrt") return pbrt_scene(scene, out.stem().string());
    return povray_scene(scene);
}

}  // namespace

bool is_for_renderers(const std::filesystem::path& out) {
    const std::string ending = extension_of(out);
    return ending == "pov" || ending == "xml" || ending == "pbrt";
}

std::vector<std::string> export_scene(const std::filesystem::path& in,
                                      const std::vector<std::string>& overrides,
                                      const StoneScene& choices, const std::filesystem::path& out) {
    const Scene scene = read_any_scene(in, overrides, choices);
    const ExportedScene converted = exported(scene, out);
    const std::filesystem::path folder = out.parent_path();
    for (const auto& [name, text] : converted.meshes) write_text(folder / name, text);
    if (converted.environment)
        write_picture(converted.environment->second, folder / converted.environment->first);
    write_text(out, converted.text);
    std::vector<std::string> notes = scene.notes;
    for (const std::string& note : converted.notes)
        notes.push_back(fmt::format("{}: not carried: {}", out.string(), note));
    return notes;
}

}  // namespace culet
