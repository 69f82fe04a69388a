#include "bench/studies/sampling_noise.h"

#include <cmath>

#include "render/render.h"
#include "render/scene/scene_io.h"
#include "tests/cpu_time.h"

namespace culet {

std::vector<SamplingNoise> sampling_noise(const std::filesystem::path& file, int width,
                                          const std::vector<int>& samples,
                                          const std::vector<std::string>& overrides) {
    std::vector<SamplingNoise> all;
    for (const int count : samples) {
        Scene scene = read_scene(file, overrides);
        scene.camera.height = scene.camera.height * width / scene.camera.width;
        scene.camera.width = width;
        scene.settings.engine = k_reference_engine;
        scene.settings.check = Check::none;
        scene.settings.samples = count;
        SamplingNoise one;
        one.samples = count;
        const Clocks start = clocks();
        one.picture = render(scene).picture;
        one.seconds = clocks().cpu - start.cpu;
        scene.settings.seed += 1;
        const Picture other = render(scene).picture;
        double squares = 0;
        for (std::size_t i = 0; i < other.rgb.size(); ++i)
            squares += std::pow(static_cast<double>(other.rgb[i] - one.picture.rgb[i]), 2);
        one.rms = std::sqrt(0.5 * squares / static_cast<double>(other.rgb.size()));
        all.push_back(std::move(one));
    }
    return all;
}

}  // namespace culet
