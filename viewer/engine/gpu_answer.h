#pragma once
// What a page needs to draw a stone on the GPU by itself (render/gpu/gpu_program.h). Private to the
// folder: shows JSON.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "viewer/engine/shown_stone.h"

namespace culet {

struct GpuAnswer {
    nlohmann::ordered_json json;
    std::vector<float> texels;  ///< of all textures, RGBA; the JSON says where each begins
};

/// `samples` per pixel, ordered so that any first few are spread like the whole. If `known` is the
/// program's key, sources and textures are omitted. Throws InputError for what is refused.
GpuAnswer gpu_answer(const ShownStone& stone, const FrameRequest& request, int samples,
                     const std::string& known);

}  // namespace culet
