#pragma once
// Writes a scene file that shows a stone in its setting.

#include <filesystem>
#include <string>

#include "render/scene/metals.h"
#include "stone/setting/setting.h"

namespace culet {

struct SettingScene {
    std::filesystem::path scene;    ///< where the file will be written; other paths are relative to
                                    ///< it
    std::filesystem::path stone;    ///< a stone file, mesh or cut design
    bool is_stone_file = false;     ///< else a mesh
    std::string material;           ///< catalogue name or file; empty: from the stone file
    bool convex = true;             ///< of a mesh
    std::filesystem::path setting;  ///< mesh of the mounting
    Metal metal{};
    std::string made_by;  ///< comment for readers: the command that made the files
};

/// The file's text: stone, mounting, ground, a preset light, and a camera above and to the side
/// (for a ring, aimed at its upper part). Throws InputError for names that TOML cannot hold.
std::string setting_scene(const SettingScene& files, const Setting& setting);

}  // namespace culet
