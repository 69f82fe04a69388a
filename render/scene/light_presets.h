#pragma once
// Lighting models with the trade's names: the one home of presets. A preset is nothing but ordinary
// lights (scene.h), so every engine, fingerprint and export sees what it sees of any scene.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

/// Half angles of the scopes' bands, degrees from the scope's axis: the eye's hole and the rim of
/// the reflector; of ASET, where blue ends and red ends. With a hole of 15 degrees, which shows
/// arrows, the hearts of a pavilion of 40.75 degrees lie in the hole's reflection.
inline constexpr double k_scope_eye_deg = 15, k_hearts_eye_deg = 5, k_scope_rim_deg = 80;
inline constexpr double k_aset_blue_deg = 15, k_aset_red_deg = 45;
/// The ring of light of the dark field, from straight down.
inline constexpr double k_darkfield_from_deg = 35, k_darkfield_to_deg = 75;

struct LightPreset {
    const char* name;
    const char* summary;  ///< one line, for help and lists
    /// The trade looks at this from the pavilion: a scene without a camera is seen from below.
    bool from_below;
    /// Its colours mean something by themselves: pictures are shown at exposure 1, where the others
    /// are exposed to the stone.
    bool instrument;
};

/// In the order in which people are told of them.
const std::vector<LightPreset>& light_presets();
/// Nothing for an unknown name.
const LightPreset* find_light_preset(std::string_view name);

/// Angles are from the axis straight up (+z), unless said otherwise; docs/gallery.md shows them.
/// jeweller: a ring of light 12-40 degrees round the viewer's head, two windows, a dim room.
/// daylight: an open sky that is brighter towards a hazy sun, the viewer's head, trees on the
///   horizon, dim ground.
/// lightbox: a white tent: walls and a floor of paper, two lamps behind the walls, a black gap
///   between roof and walls, and the hole for the lens.
/// darkfield: a ring of light from below the girdle, 35-75 degrees from straight down, before a
///   dark ground.
/// aset: the Angular Spectrum Evaluation Tool of AGS: by elevation above the girdle plane, green
///   0-45 degrees, red 45-75, blue 75-90 (the viewer's head); dark below.
/// idealscope: a red reflector 15-80 degrees round the eye's dark hole, white light from below,
///   which shows what leaks.
/// arrows: that reflector alone, before the crown.
/// hearts: the same before the pavilion, 5-80 degrees from straight down.
/// Nothing for an unknown name.
std::optional<Lights> light_preset(std::string_view name);

/// What to say of a word that is no preset: the nearest one, and all of them.
std::string no_light_preset(std::string_view name);

}  // namespace culet
