#include "studio/export_work.h"

#include <algorithm>

#include "compare/report/report.h"
#include "render/export/exported_stone.h"
#include "render/image/exposure.h"
#include "render/image/image_io.h"
#include "render/render.h"
#include "render/scene/shown_picture.h"
#include "render/scene/stone_scene.h"
#include "stone/export/export_frame.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/text/errors.h"
#include "studio/fit_work.h"
#include "studio/json_text.h"
#include "studio/new_project.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

ExportedStone report_file(const LoadedStone& loaded, const FittedStone& fitted,
                          const std::string& version) {
    if (fitted.report.empty())
        throw InputError("there is no fit to report yet: write what you read, on Readings");
    const Stone& stone = loaded.file.stone;
    Report report;
    report.title = stone.name;
    report.version = version;
    report.files = {{"mesh", loaded.file.mesh_file.filename().string()},
                    {"readings", loaded.readings.filename().string()}};
    report.fit_json = fitted.report;
    report.fitted = stone_shown(loaded, fitted.solid).solid;
    report.starting = stone.solid;
    report.length_unit = name_of(stone.unit);
    return {report_page(report), {}};
}

// As culet render draws it.
ExportedStone picture_file(const Stone& stone, bool has_material, const Progress& progress) {
    Scene scene = scene_around(stone, {});
    allow_usual_time(scene);
    const RenderResult result = render(scene, progress);
    PngLook look = look_of(scene, "");
    look.exposure = shown_exposure("", scene).value_or(
        exposure_for_stone(result.picture, look.share_over_white));
    ExportedStone file{png_of(result.picture, look), result.stats.notes};
    file.notes.insert(file.notes.begin(), scene.notes.begin(), scene.notes.end());
    if (!has_material)
        file.notes.emplace_back("the stone file names no material: drawn as diamond");
    return file;
}

ExportedStone stone_file(Stone stone, bool has_material, const std::string& name) {
    if (!mesh_format(name) && !is_cut(name)) stone = in_export_frame(stone);
    ExportedStone file = exported(stone, has_material, name);
    if (is_cut(name) && !stone.solid.design)
        file.notes.emplace_back("the mesh has no design: tiers and their order are as drawn");
    return file;
}

// Of a fit that should not be trusted as it is.
std::vector<std::string> doubts_of(const FittedStone& fitted) {
    if (fitted.report.empty()) return {"as drawn: the stone is not fitted to readings yet"};
    const Json report = Json::parse(fitted.report);
    const std::string status = report.value("status", "");
    if (status == "converged") return {};
    return {"the fit is " + status + ": " + report.value("message", "")};
}

}  // namespace

std::string exported_file(const LoadedStone& loaded, const FittedStone& fitted,
                          const std::string& kind, const std::string& version,
                          const Progress& progress) {
    const Stone stone = stone_shown(loaded, fitted.solid);
    const bool has_material = loaded.file.has_material;
    std::string name = stone.name + "." + kind;
    std::replace(name.begin(), name.end(), '/', '_');
    name = plain_name(name);
    const ExportedStone file = kind == "html"  ? report_file(loaded, fitted, version)
                               : kind == "png" ? picture_file(stone, has_material, progress)
                                               : stone_file(stone, has_material, name);
    Json head{{"file", name}, {"notes", doubts_of(fitted)}};
    // Advice on options of the command line is none here.
    for (const std::string& note : file.notes)
        head["notes"].push_back(note.substr(0, note.find(" (--")));
    return text_of(head) + "\n" + file.bytes;
}

}  // namespace culet
