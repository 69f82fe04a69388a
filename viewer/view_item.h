#pragma once
// Makes a page's items from stones and scenes in files.

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
    std::filesystem::path before;      ///< the stone that the fit started from; empty: none
    std::optional<CutChoice> cut;      ///< a standard cut, instead of a file
    const Stone* stone = nullptr;      ///< replaces the stone of `file`, a scene; null: its own
    const Solid* catalogue = nullptr;  ///< the contents of `before`; null: read the file
};

/// Longer side of the small picture, pixels.
constexpr int k_still_size = 320;

/// `notes` receives the notes from reading. Throws InputError.
ViewItem view_item(const ViewSource& source, std::vector<std::string>& notes);

}  // namespace culet
