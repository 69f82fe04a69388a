#include "render/export/exported_stone.h"

#include <fmt/format.h>

#include <cmath>

#include "render/export/gltf_look.h"
#include "render/scene/stone_scene.h"
#include "stone/design/design.h"
#include "stone/export/export_frame.h"
#include "stone/export/mean_material.h"
#include "stone/export/step.h"
#include "stone/export/three_mf.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/text/errors.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

// Allowed distance of the corners of a stone read from a file from its planes.
constexpr double k_step_tolerance_mm = 1e-5;

ExportedStone gltf(const Stone& stone, bool has_material, GltfForm form) {
    if (!has_material) {
        return {gltf_bytes(stone, std::nullopt, form),
                {"no material: a grey surface (--material NAME)"}};
    }
    GltfMaterial material = gltf_material(stone.material, outline_width(stone.solid));
    if (const std::string frosted = frosted_tiers(stone.solid); !frosted.empty())
        material.notes.push_back(fmt::format("frosting: polished here are tiers {}", frosted));
    return {gltf_bytes(stone, material.look, form), material.notes};
}

ExportedStone design(const Stone& stone, bool has_material, const std::filesystem::path& file) {
    Design design = cutting_design(stone.solid);
    // Designs state the index to four decimals at most.
    if (has_material)
        design.refractive_index = std::round(1e4 * mean_index(stone.material, k_d_line_nm)) / 1e4;
    CutFile written = cut_file(stone.solid, design, file);
    if (!design.refractive_index && extension_of(file) != "gcs") {
        written.notes.emplace_back(
            "its refractive index is not known: 1.54, GemCad's own, is written (--material NAME)");
    }
    return {std::move(written.bytes), std::move(written.notes)};
}

}  // namespace

ExportedStone exported(const Stone& stone, bool has_material, const std::filesystem::path& file) {
    if (const auto format = mesh_format(file)) return {mesh_text(stone.solid, *format), {}};
    if (is_cut(file)) return design(stone, has_material, file);
    const std::string ending = extension_of(file);
    if (ending == "3mf") return {three_mf_bytes(stone.solid, stone.name), {}};
    if (ending == "step" || ending == "stp") {
        StepFile step =
            step_text(planar_solid(stone.solid, stone.convex, k_step_tolerance_mm), stone.name);
        return {std::move(step.text), std::move(step.notes)};
    }
    if (ending == "glb") return gltf(stone, has_material, GltfForm::binary);
    if (ending == "gltf") return gltf(stone, has_material, GltfForm::text);
    throw InputError(file, "is of no kind that a stone is written as");
}

}  // namespace culet
