#pragma once
// The look of a material in glTF.

#include <optional>
#include <string>
#include <vector>

#include "stone/export/gltf_write.h"

namespace culet {

struct GltfMaterial {
    GltfLook look;
    std::vector<std::string> notes;  ///< what glTF cannot hold, one line each
};

/// The colour is `body_colour` after one path through a stone of that width, clamped to 0..1. glTF
/// raises colours to the power of the length, channel by channel, so they are exact only at this
/// length. Colourless materials have no colour.
GltfMaterial gltf_material(const Material& material, double width_mm);

}  // namespace culet
