#pragma once
// What one picture by beams takes, of many.

#include "render/beams/frame_renderer.h"
#include "tests/cpu_time.h"

namespace culet {

enum class Drawing {
    preview,  ///< one colour a beam
    exact,    ///< each pixel's middle
    averaged  ///< over the pixel
};
Scene drawn_as(Scene scene, Drawing drawing, int threads);

/// Of a frame whose camera moved by too little to see, so that all of it is drawn anew; the
/// quickest of as many as `seconds` hold.
Clocks frame_time(FrameRenderer& frames, const Camera& camera, double seconds = 0.25);

}  // namespace culet
