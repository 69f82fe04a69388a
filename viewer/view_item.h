#pragma once
// From stones and scenes in files to what a page carries of them.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/scene/stone_scene.h"
#include "viewer/engine/viewer_document.h"

namespace culet {

struct ViewSource {
    std::filesystem::path file;          ///< as `read_any_scene` takes it
    std::vector<std::string> overrides;  ///< keys of a scene
    StoneScene choices;
    std::string fit_json;              ///< report of `culet fit`; empty: none
    std::filesystem::path before;      ///< the stone that the fit began with; empty: none
    std::optional<CutChoice> cut;      ///< instead of a file: a standard cut
    const Stone* stone = nullptr;      ///< instead of that of `file`, a scene; null: its own
    const Solid* catalogue = nullptr;  ///< what `before` would hold; null: look there
};

/// Longer side of the small picture, pixels.
constexpr int k_still_size = 320;

/// `notes`: what reading had to say. Throws InputError.
ViewItem view_item(const ViewSource& source, std::vector<std::string>& notes);

}  // namespace culet
