#pragma once
// A stone as a file of any format: meshes, designs, and files for CAD, printers and the web.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/stone.h"

namespace culet {

struct ExportedStone {
    std::string bytes;
    std::vector<std::string> notes;  ///< what the format could not keep, one line each
};

/// The format is that of the name `file`: .obj .off .ply .stl, .asc .gem .gcs, .step .stp, .3mf,
/// .glb .gltf; nothing is written there. For .step, .3mf and glTF the stone is to be in the frame
/// of `in_export_frame`. Designs are the solid's own, or what its drawing shows, with the
/// material's index. Throws InputError where the format cannot hold the stone.
ExportedStone exported(const Stone& stone, bool has_material, const std::filesystem::path& file);

}  // namespace culet
