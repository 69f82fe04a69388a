#pragma once
// The gemmologist's instruments as views of a stone.
//
// polariscope: polarised light from behind, an analyser before the eye: bright where the stone
//   turns the polarisation, and coloured where it has little birefringence.
// conoscope: the same in all directions through one point: isogyres and rings around the optic
//   axes.
// dichroscope: unpolarised light from behind, two windows side by side whose analysers are at right
//   angles: the colours of the two waves.

#include <optional>
#include <string_view>

#include "render/scene.h"
#include "stone/toml_file.h"

namespace culet {

/// Keys that may stand beside `preset`, and of them those that [camera] takes by itself.
inline constexpr const char* k_view_keys[] = {"preset",      "polarizer",     "polariser",
                                              "analyzer",    "analyser",      "cone",
                                              "retarder_nm", "retarder_angle"};

bool is_view_preset(std::string_view name);

/// Analyser, retarder and cone of a table ([camera], or where `preset` stands), in degrees there;
/// spelled either way. Throws InputError.
void read_eye_optics(const TomlTable& table, Camera& camera);

/// Sets up the lights of view `name` behind the stone as the camera sees it, and the analyser where
/// none was given. `table` holds the polariser's angle.
void apply_view_preset(std::string_view name, const TomlTable& table, Scene& scene);

/// Square on to the table, the whole stone in the picture: for views that name no camera.
Camera camera_above(const Solid& solid);

}  // namespace culet
