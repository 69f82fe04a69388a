#pragma once
// The time of one picture by beams in a series.

#include "render/beams/frame_renderer.h"
#include "tests/cpu_time.h"

namespace culet {

enum class Drawing {
    preview,  ///< one colour per beam
    exact,    ///< at each pixel's centre
    averaged  ///< mean over the pixel
};
Scene drawn_as(Scene scene, Drawing drawing, int threads);

/// The quickest of as many as fit in `seconds`, with a camera that moves by too little to see, so
/// that each is drawn anew.
Clocks frame_time(FrameRenderer& frames, const Camera& camera, double seconds = 0.25);

}  // namespace culet
