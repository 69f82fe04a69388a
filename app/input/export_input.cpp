#include "app/input/export_input.h"

#include <fmt/format.h>

#include "app/input/readings_form.h"
#include "app/program/file_kinds.h"
#include "fit/readings/measurement.h"
#include "render/colour/material_colour.h"
#include "render/scene/scene_io.h"
#include "render/scene/stone_scene.h"
#include "stone/export/export_frame.h"
#include "stone/material/material_io.h"
#include "stone/solid/checks.h"
#include "stone/solid_input.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

ExportInput drawn_stone_file(const std::filesystem::path& file, const ExportChoices& choices) {
    StoneFile read = read_stone(file, choices.overrides);
    ExportInput input;
    input.stone = std::move(read.stone);
    input.has_material = read.has_material;
    input.notes = std::move(read.notes);
    input.details = std::move(read.details);
    if (!read_readings(file, choices.overrides).empty()) {
        input.notes.push_back(fmt::format(
            "written as drawn, not fitted to its readings: culet fit {} -o FITTED.obj, then "
            "convert that",
            file.filename().string()));
    }
    return input;
}

ExportInput scene_stone(const std::filesystem::path& file, const ExportChoices& choices) {
    Scene scene = read_scene(file, choices.overrides);
    if (!scene.has_stone()) throw InputError(file, "has no stone to be written");
    ExportInput input;
    if (scene.has_objects())
        input.notes.emplace_back("the scene's stone alone is written, nothing of what is round it");
    input.stone = std::move(scene.stone);
    input.has_material = true;
    return input;
}

ExportInput bare_solid(const std::filesystem::path& file, const ExportChoices& choices) {
    SolidInput read = load_solid(file, choices.cut);
    ExportInput input;
    input.stone.solid = std::move(read.solid);
    input.stone.convex = is_convex(input.stone.solid);
    input.notes = std::move(read.notes);
    input.details = std::move(read.details);
    if (!choices.width_mm && !has_size(input.stone.solid)) {
        scale_to_width(input.stone.solid, k_usual_width_mm);
        input.notes.push_back(fmt::format("has no size: written {:g} mm wide (--width for another)",
                                          k_usual_width_mm));
    }
    return input;
}

}  // namespace

ExportInput read_for_export(const std::filesystem::path& file, const ExportChoices& choices) {
    require_kind(file, {FileKind::solid, FileKind::stone, FileKind::scene}, "culet convert",
                 choices.overrides);
    const FileKind kind = kind_of(file, choices.overrides);
    if (kind == FileKind::scene && choices.width_mm)
        throw InputError(file, "is a scene, which gives the stone's size: leave out --width");
    if (kind != FileKind::stone && kind != FileKind::scene && !choices.overrides.empty())
        throw InputError(file, "has no keys that --set could change");
    ExportInput input = kind == FileKind::stone   ? drawn_stone_file(file, choices)
                        : kind == FileKind::scene ? scene_stone(file, choices)
                                                  : bare_solid(file, choices);
    if (choices.width_mm) {
        withdraw_size_doubt(input.stone.solid, input.notes);
        scale_to_width(input.stone.solid, *choices.width_mm);
        input.stone.unit = LengthUnit::mm;
    }
    if (!choices.material.empty()) {
        input.stone.material = material_called(choices.material);
        input.has_material = true;
    }
    const std::vector<std::string>& said = input.stone.material.notes;
    if (kind != FileKind::scene) input.notes.insert(input.notes.end(), said.begin(), said.end());
    if (input.stone.name.empty()) input.stone.name = file.stem().string();
    input.stone = in_export_frame(input.stone);
    return input;
}

}  // namespace culet
