#pragma once
// Timed pictures by beams, and how pages word them.

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
/// The same picture, shown so many times as bright.
PngLook brightened(const PngLook& look, double factor);

}  // namespace culet
