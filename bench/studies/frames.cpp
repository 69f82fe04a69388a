#include "bench/studies/frames.h"

#include <fmt/format.h>

#include "page/html.h"

namespace culet {

TimedPicture timed_picture(const Scene& scene) {
    Scene alone = scene;
    alone.settings.threads = 1;
    FrameRenderer frames(alone);
    TimedPicture timed;
    timed.time = frame_time(frames, alone.camera);
    frames.look_from(alone.camera);
    frames.draw();
    timed.result = frames.take();
    return timed;
}

std::string milliseconds_of(double seconds) {
    return significant(1e3 * seconds, 3);
}

std::string percent(double share) {
    return fmt::format("{:.2f} %", 100 * share);
}

PngLook brightened(const PngLook& look, double factor) {
    PngLook brighter = look;
    brighter.exposure *= factor;
    return brighter;
}

}  // namespace culet
