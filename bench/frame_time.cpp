#include "bench/frame_time.h"

namespace culet {

Scene drawn_as(Scene scene, Drawing drawing, int threads) {
    scene.settings.engine = drawing == Drawing::preview ? "preview" : "beams";
    if (drawing == Drawing::exact) scene.settings.samples = 1;
    scene.settings.threads = threads;
    return scene;
}

Clocks frame_time(FrameRenderer& frames, const Camera& camera, double seconds) {
    frames.draw();
    Camera moved = camera;
    double to = 1e-9;
    return quickest(
        [&] {
            moved.position.x = camera.position.x * (1 + to);
            to = -to;
            frames.look_from(moved);
            frames.draw();
        },
        5, seconds);
}

}  // namespace culet
