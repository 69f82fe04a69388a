#pragma once
// How a material looks in glTF.

#include <optional>
#include <string>
#include <vector>

#include "stone/export/gltf_write.h"

namespace culet {

struct GltfMaterial {
    GltfLook look;
    std::vector<std::string> notes;  ///< what of the material glTF does not hold, one line each
};

/// Colour: that of the body (`body_colour`) after one way through a stone of that width, brought
/// into 0..1 where it lies outside sRGB; glTF's is multiplied from length to length channel by
/// channel, so that it is exact at this length, and of colourless materials there is none.
GltfMaterial gltf_material(const Material& material, double width_mm);

}  // namespace culet
