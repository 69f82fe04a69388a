// Renders a scene at a given tolerance and says how near the picture is: render SCENE.toml
// PICTURE.exr
#include <cstdio>
#include <exception>

#include "render/image/image_io.h"
#include "render/render.h"
#include "render/scene/scene_io.h"

int main(int argc, char** argv) try {
    using namespace culet;
    if (argc != 3) {
        std::fprintf(stderr, "usage: render SCENE.toml PICTURE.exr|.png|.hdr\n");
        return 2;
    }
    Scene scene = read_scene(argv[1]);
    scene.settings.tolerance = 0.05;  // of the mean radiance
    // Long work tells how far it is, from 0 to 1, and stops where this returns false.
    const Progress progress = [](double done) {
        std::fprintf(stderr, "\r%3.0f %%", 100 * done);
        return true;
    };
    const RenderResult result = render(scene, progress);
    write_picture(result.picture, argv[2]);
    std::printf("\n%s, error bound %.3f of the mean radiance\n", result.stats.engine.c_str(),
                result.stats.error_bound);
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
}
