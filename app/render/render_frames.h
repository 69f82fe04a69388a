#pragma once
// Turntables: `culet render --frames N --turn DEG -o frame-####.png`, or `-o turn.mp4`.

#include <functional>
#include <string>

#include "app/render/picture_output.h"
#include "render/engine/render_result.h"
#include "render/scene/scene.h"

namespace culet {

struct Frames {
    int count = 0;
    double turn_deg = 360;  ///< from the first frame to the one after the last
    std::string out;        ///< with a run of # for the frame's number; or .mp4
    std::string exposure, tonemap;
    bool spectral = false;
};

/// Throws InputError if `out` has no #, a film has no ffmpeg, or the place cannot be written.
void require_frames(const Frames& frames);

/// The picture's name for frame 0, 1, ...; the numbers in names begin at 0001.
std::string frame_name(const std::string& pattern, int frame);

/// Prints a line for each frame. `first` draws the first and chooses and checks its settings, which
/// the others share with its exposure. Returns the first result, without its picture.
RenderResult draw_frames(const Frames& frames, const Scene& scene,
                         const std::function<RenderResult(const Scene&)>& first, bool quiet);

}  // namespace culet
