#pragma once
// What a page asks of one picture: its size, its camera, how it is drawn.

#include <nlohmann/json.hpp>

#include "viewer/engine/shown_stone.h"

namespace culet {

/// The arguments of `draw` (docs/viewer.md); what they leave out is `usual`. Throws InputError, and
/// JSON's own errors for what is missing or of another type.
FrameRequest frame_request(const nlohmann::ordered_json& arguments, const Camera& usual);

}  // namespace culet
