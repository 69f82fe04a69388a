#pragma once
// Timed pictures by beams, and their numbers as text.

#include <string>

#include "bench/frame_time.h"
#include "render/engine/render_result.h"

namespace culet {

struct TimedPicture {
    Clocks time;  ///< of a whole picture on one thread, the quickest of several
    RenderResult result;
};
TimedPicture timed_picture(const Scene& scene);

std::string milliseconds_of(double seconds);
std::string percent(double share);
/// The same look with `factor` times the brightness.
PngLook brightened(const PngLook& look, double factor);

}  // namespace culet
