#pragma once
// From a stone or a scene to an item of a page.

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

/// The command that draws it. The file may be one that `choices.held` has.
std::string render_command(const ViewSource& source);

/// The item without its picture and the fit's facts. `scene` becomes what it shows, `notes`
/// receives the notes from reading. Throws InputError.
ViewItem item_of(const ViewSource& source, std::vector<std::string>& notes, Scene& scene);

}  // namespace culet
