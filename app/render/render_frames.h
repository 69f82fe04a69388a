#pragma once
// A turntable: `culet render --frames N --turn DEG -o frame-####.png`, or `-o turn.mp4`.

#include <functional>
#include <string>

#include "app/render/picture_output.h"
#include "render/engine/render_result.h"
#include "render/scene/scene.h"

namespace culet {

struct Frames {
    int count = 0;
    double turn_deg = 360;  ///< from the first frame to the one after the last
    std::string out;        ///< with a run of # where the frame's number goes; or .mp4
    std::string exposure, tonemap;
    bool spectral = false;
};

/// Throws InputError: no # in `out`, no ffmpeg for a film, or a place that cannot be written.
void require_frames(const Frames& frames);

/// Of frame 0 and up, from 0001; the picture's name.
std::string frame_name(const std::string& pattern, int frame);

/// Draws all frames, and tells of each. The first is chosen and checked as `first` does; the others
/// are drawn with the same settings and exposure. Returns the first, without its picture.
RenderResult draw_frames(const Frames& frames, const Scene& scene,
                         const std::function<RenderResult(const Scene&)>& first, bool quiet);

}  // namespace culet
