#pragma once
// A scene file that shows a stone in its setting.

#include <filesystem>
#include <string>

#include "render/scene/metals.h"
#include "stone/setting/setting.h"

namespace culet {

struct SettingScene {
    std::filesystem::path scene;    ///< where the file will stand: others are named from there
    std::filesystem::path stone;    ///< a stone file, or a mesh or cut
    bool is_stone_file = false;     ///< else a mesh
    std::string material;           ///< catalogue name or file; empty: the stone file has its own
    bool convex = true;             ///< of a mesh
    std::filesystem::path setting;  ///< mesh of the mounting
    Metal metal{};
    std::string made_by;  ///< a line for people: which command made the files
};

/// The text: the stone, a camera that looks at it from above and aside (of a ring, at its
/// upper part), a light by name, the mounting, and a ground that it stands on. Throws InputError
/// for names that TOML cannot hold.
std::string setting_scene(const SettingScene& files, const Setting& setting);

}  // namespace culet
