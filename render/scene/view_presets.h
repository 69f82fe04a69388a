#pragma once
// The gemmologist's instruments as views of a stone.
//
// polariscope: polarised light from behind, an analyser before the eye: bright where the stone
//   turns the polarisation, and coloured where it has little birefringence.
// conoscope: the same in all directions through one point: isogyres and rings around the optic
//   axes.
// dichroscope: unpolarised light from behind, two windows side by side whose analysers are at right
//   angles: the colours of the two waves.

#include <string_view>
#include <vector>

#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// `keys` and those that may stand beside `preset` where it names a view.
std::vector<std::string_view> with_view_keys(std::vector<std::string_view> keys);

bool is_view_preset(std::string_view name);

/// Analyser, retarder and cone of a table ([camera], or where `preset` stands), in degrees there;
/// spelled either way. Throws InputError.
void read_eye_optics(const TomlTable& table, Camera& camera);

/// Sets up the lights of view `name` behind the stone as the camera sees it, and the analyser where
/// none was given. `table` holds the polariser's angle.
void apply_view_preset(std::string_view name, const TomlTable& table, Scene& scene);

}  // namespace culet
