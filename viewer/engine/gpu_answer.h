#pragma once
// What a page needs to draw a stone on the GPU by itself (render/gpu/gpu_program.h). Private to the
// room: shows JSON.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "viewer/engine/shown_stone.h"

namespace culet {

struct GpuAnswer {
    nlohmann::ordered_json json;
    std::vector<float> texels;  ///< of all textures, RGBA, which say where theirs begin
};

/// `samples` of each pixel, in an order in which the first few are spread as the whole.
/// `known`: the key of the program that the page has: sources and textures are left out where it
/// is the same. Throws InputError for what is refused.
GpuAnswer gpu_answer(const ShownStone& stone, const FrameRequest& request, int samples,
                     const std::string& known);

}  // namespace culet
