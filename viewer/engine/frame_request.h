#pragma once
// A page's request for one picture: size, camera and manner of drawing.

#include <nlohmann/json.hpp>

#include "viewer/engine/shown_stone.h"

namespace culet {

/// Reads the arguments of `draw` (docs/viewer.md). `usual` is the camera if they have none. Throws
/// InputError, and JSON's own errors for missing or mistyped values.
FrameRequest frame_request(const nlohmann::ordered_json& arguments, const Camera& usual);

}  // namespace culet
