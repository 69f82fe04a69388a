#pragma once
// Lighting models with the trade's names, made of ordinary lights (lights.h), so that engines,
// fingerprints and exports need not know of presets.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/framing.h"
#include "render/scene/scene.h"

namespace culet {

/// Half angles of the scopes' bands, degrees from the scope's axis: the eye's hole and the
/// reflector's rim; for ASET, where blue and red end. The hole of 15 degrees is for arrows; with
/// it, the hearts of a pavilion of 40.75 degrees would lie in the hole's reflection.
inline constexpr double k_scope_eye_deg = 15, k_hearts_eye_deg = 5, k_scope_rim_deg = 80;
inline constexpr double k_aset_blue_deg = 15, k_aset_red_deg = 45;
/// The dark field's ring of light, degrees from straight down.
inline constexpr double k_darkfield_from_deg = 35, k_darkfield_to_deg = 75;

struct LightPreset {
    const char* name;
    const char* summary;  ///< one line, for help and lists
    /// How a scene without a camera is seen.
    Facing facing;
    /// Its colours have a meaning: its pictures have exposure 1, others are exposed to the stone.
    bool instrument;
    PngLook film = {};
};

/// In the order of help texts.
const std::vector<LightPreset>& light_presets();
/// Null for an unknown name.
const LightPreset* find_light_preset(std::string_view name);

/// The lights of a preset; nothing for an unknown name. docs/gallery.md has pictures. Angles count
/// from straight up (+z) unless noted.
/// jeweller: a ring of light 12-40 degrees round the viewer's head, two windows, a dim room.
/// photograph: how dealers photograph stones: a dark camera (0-20 degrees), a ring of light
///   round it (25-45), dim walls, a window, and a table that the stone shades.
/// daylight: an open sky that is brighter towards a hazy sun, the viewer's head, trees on the
///   horizon, dim ground.
/// lightbox: a white tent: walls and a floor of paper, two lamps behind the walls, a black gap
///   between roof and walls, and the hole for the lens.
/// darkfield: a ring of light from below the girdle, 35-75 degrees from straight down, before a
///   dark ground.
/// aset: the Angular Spectrum Evaluation Tool of AGS: by elevation above the girdle plane, green
///   0-45 degrees, red 45-75, blue 75-90 (the viewer's head); dark below.
/// idealscope: a red reflector 15-80 degrees round the eye's dark hole; white light from below
///   shows leakage.
/// arrows: the reflector of idealscope alone, before the crown.
/// hearts: a reflector before the pavilion, 5-80 degrees from straight down.
std::optional<Lights> light_preset(std::string_view name);

/// Error message for an unknown name, with the nearest preset and all of them.
std::string no_light_preset(std::string_view name);

}  // namespace culet
