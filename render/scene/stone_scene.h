#pragma once
// Scenes that no file describes: a stone, a mesh or a cut design, seen face up in a light by name.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/colour/material_colour.h"
#include "render/scene/scene.h"

namespace culet {

/// Where nothing else is said.
constexpr const char* k_usual_light = "jeweller";
/// Of a stone's outline the narrower of its extents along x and y.
double outline_width(const Solid& solid);

/// False for what is no wider than 2: GemCad's designs, unit spheres.
bool has_size(const Solid& solid);

struct StoneScene {
    std::string material;            ///< catalogue name or material file; empty: the file's own
    std::string light;               ///< preset or view; empty: the file's, else the usual one
    std::optional<double> width_mm;  ///< of the narrower side of the outline
};

/// Any file that shows a stone: a scene, a stone file, a mesh (.obj .off .ply .stl) or a cut design
/// (.asc .gem). Meshes are in mm; what is no wider than 2 (GemCad's designs, unit spheres) has no
/// size, and is drawn at the usual width: `Scene::notes` say so. `overrides` are a scene's keys.
/// Throws InputError: unknown kinds, no material, a width for a scene with a camera of its own.
Scene read_any_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                     const StoneScene& choices);

/// The same of a stone at hand, with its own material where `choices` name none.
Scene scene_around(const Stone& stone, const std::vector<std::string>& overrides,
                   const StoneScene& choices = {});

}  // namespace culet
