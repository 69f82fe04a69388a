#pragma once
// Gemmologists' instruments as views of a stone.
//
// polariscope: polarised light from behind and an analyser before the eye. The stone is bright
//   where it changes the polarisation, and coloured where its birefringence is small.
// conoscope: the same for all directions through one point: isogyres and rings around the optic
//   axes.
// dichroscope: unpolarised light from behind and two windows with crossed analysers, which show the
//   colours of the two waves.

#include <string_view>
#include <vector>

#include "render/scene/scene.h"
#include "stone/text/toml_file.h"

namespace culet {

/// Appends the keys that may stand beside `preset` when it names a view.
std::vector<std::string_view> with_view_keys(std::vector<std::string_view> keys);

bool is_view_preset(std::string_view name);

/// Reads analyser, retarder and cone from [camera] or the table with `preset`, in degrees, either
/// spelling. Throws InputError.
void read_eye_optics(const TomlTable& table, Camera& camera);

/// Places view `name`'s lights behind the stone as the camera sees it, and a default analyser.
/// `table` holds the polariser's angle.
void apply_view_preset(std::string_view name, const TomlTable& table, Scene& scene);

}  // namespace culet
