#include "viewer/engine/gpu_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "render/gpu/gpu_program.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

// Deeper paths bring little, and every face costs a GPU as much as the first.
constexpr int k_deepest_on_gpu = 24;

Json uniforms_json(const std::vector<GpuUniform>& uniforms) {
    Json list = Json::array();
    for (const GpuUniform& uniform : uniforms) {
        list.push_back({{"name", uniform.name},
                        {"components", uniform.components},
                        {"whole", uniform.whole},
                        {"values", uniform.values}});
    }
    return list;
}

// FNV-1a.
std::string key_of(const std::string& source) {
    std::uint64_t hash = 14695981039346656037u;
    for (const char c : source) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    return fmt::format("{:016x}", hash);
}

// Golden-ratio steps through the pattern, so that any first few are spread over the pixel.
std::size_t spread(std::size_t i, std::size_t count) {
    std::size_t step = std::max<std::size_t>(1, count * 618 / 1000);
    while (std::gcd(step, count) != 1) ++step;
    return i * step % count;
}

}  // namespace

GpuAnswer gpu_answer(const ShownStone& stone, const FrameRequest& request, int samples,
                     const std::string& known) {
    Scene scene = stone.scene();
    scene.camera = request.camera;
    const GpuSetup& setup = stone.on_gpu();
    GpuOptions options;
    options.depth = std::min(setup.depth, k_deepest_on_gpu);
    options.cut_weight = setup.cut_weight;
    GpuProgram program = gpu_program(scene, setup.optics, setup.colours, options);
    // The inverse turn leads from the stone to the lights: its columns are the turn's rows.
    for (GpuUniform& uniform : program.uniforms) {
        if (uniform.name == "u_light_turn")
            uniform.values.assign(request.turn.begin(), request.turn.end());
    }
    const std::vector<GpuUniform> lights = gpu_lights(scene.lights, program.middle);
    program.uniforms.insert(program.uniforms.end(), lights.begin(), lights.end());

    GpuAnswer answer;
    Json& json = answer.json;
    json["key"] = key_of(program.vertex + program.kernel + program.display);
    json["uniforms"] = uniforms_json(program.uniforms);
    json["passes"] = Json::array();
    for (GpuPass& pass : program.passes) {
        const std::vector<GpuUniform> eye = gpu_eye(scene.camera.optics, setup.optics, pass);
        pass.uniforms.insert(pass.uniforms.end(), eye.begin(), eye.end());
        json["passes"].push_back({{"uniforms", uniforms_json(pass.uniforms)}});
    }
    const std::size_t count = static_cast<std::size_t>(std::max(1, samples));
    const std::vector<SamplePoint> pattern =
        sample_pattern(static_cast<int>(count), setup.optics.on(Effects::aperture),
                       scene.settings.filter, scene.settings.filter_radius);
    json["samples"] = Json::array();
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        json["samples"].push_back(uniforms_json(
            gpu_view(request.camera, pattern[spread(i, pattern.size())], program.middle)));
    }
    if (json["key"] == known) return answer;
    json["vertex"] = program.vertex;
    json["kernel"] = program.kernel;
    json["display"] = program.display;
    json["textures"] = Json::array();
    for (const GpuTexture& texture : program.textures) {
        json["textures"].push_back({{"name", texture.name},
                                    {"unit", texture.unit},
                                    {"width", texture.width},
                                    {"height", texture.height},
                                    {"first", answer.texels.size()}});
        answer.texels.insert(answer.texels.end(), texture.rgba.begin(), texture.rgba.end());
    }
    return answer;
}

}  // namespace culet
