#pragma once
// Scenes of a stone, mesh or cut design alone, face up in a preset light.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/colour/material_colour.h"
#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Preset used by default.
constexpr const char* k_usual_light = "photograph";
/// The smaller of the outline's extents along x and y.
double outline_width(const Solid& solid);

/// False if the outline is at most 2 wide, like GemCad's designs and unit spheres.
bool has_size(const Solid& solid);

struct StoneScene {
    std::string material;            ///< catalogue name or material file; empty: from the file
    std::string light;               ///< preset or view; empty: from the file, else k_usual_light
    std::optional<double> width_mm;  ///< smaller extent of the outline
    HeldFiles held = {};             ///< a mesh or design that is in memory, by its name
};

/// Reads any file that shows a stone: a scene, a stone file, a mesh (.obj .off .ply .stl, in mm) or
/// a cut design (.asc .gem .gcs). A stone without size (has_size) gets the usual width, with a
/// note. `overrides` are a scene's keys. Throws InputError: unknown kinds, no material, a width for
/// a scene with its own camera.
Scene read_any_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                     const StoneScene& choices);

/// The same for a stone in memory, whose own material is the default; `overrides` may say another.
Scene scene_around(const Stone& stone, const std::vector<std::string>& overrides,
                   const StoneScene& choices = {});

}  // namespace culet
