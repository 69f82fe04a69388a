// Draws a stone frame after frame from a camera that moves, as a viewer does: frames SCENE.toml
// PREFIX
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>

#include "render/beams/frame_renderer.h"
#include "render/image/image_io.h"
#include "render/scene/scene_io.h"

int main(int argc, char** argv) try {
    using namespace culet;
    if (argc != 3) {
        std::fprintf(stderr, "usage: frames SCENE.toml PREFIX\n");
        return 2;
    }
    Scene scene = read_scene(argv[1], {"render.engine=\"beams\""});
    FrameRenderer frames(scene);  // throws where beams cannot draw the scene
    const Vec3 start = scene.camera.position;
    for (int i = 0; i < 5; ++i) {
        scene.camera.position.x = start.x + 0.05 * i * start.z;
        frames.look_from(scene.camera);
        const auto before = std::chrono::steady_clock::now();
        const RenderResult& frame = frames.draw();
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - before;
        write_picture(frame.picture, argv[2] + std::to_string(i) + ".png");
        std::printf("frame %d: %lld beams, %.0f ms\n", i, frame.stats.beams, took.count());
    }
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
