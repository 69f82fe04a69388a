#include "render/gpu/gpu_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string_view>

#include "render/beams/beam_lights.h"
#include "render/gpu/gpu_passes.h"
#include "stone/design/design.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace embedded {
extern const char* const gpu_vertex;
extern const char* const gpu_kernel;
extern const char* const gpu_display;
}  // namespace embedded

namespace {

constexpr const char* k_version = "#version 300 es\n";

// Formats a number that reads back as the same float.
std::string literal(double v) {
    return fmt::format("{:#.9g}", static_cast<float>(v));
}

std::string planes_of(const Solid& solid, const Vec3& middle) {
    std::string text;
    for (const Facet& facet : solid.facets) {
        const Vec3& n = facet.plane.normal;
        text += fmt::format("    PLANE(vec3({}, {}, {}), {})\n", literal(n.x), literal(n.y),
                            literal(n.z), literal(facet.plane.offset - glm::dot(n, middle)));
    }
    return text;
}

std::string kernel_source(const Scene& scene, const OpticalSetup& setup, const GpuLayout& layout,
                          const Vec3& middle, bool balance) {
    constexpr const char* k_weights[] = {"float", "vec2", "vec3", "vec4"};
    const LightCounts lights = count_lights(scene.lights);
    std::string text = k_version;
    const auto define = [&text](const char* name, auto value) {
        text += fmt::format("#define {} {}\n", name, value);
    };
    define("NODES", layout.nodes);
    define("Weights", k_weights[layout.nodes - 1]);
    define("PATHS", layout.paths);
    define("POLARISED", int{setup.polarised});
    define("RESPONSE", int{setup.stokes});
    define("CRYSTAL", int{layout.crystal});
    define("ABSORBS", int{layout.absorbs && !layout.crystal});
    define("SPHERES", lights.spheres);
    define("LAMPS", lights.lamps);
    define("PLANE_LIGHTS", lights.planes);
    define("LOBES", lights.lobes);
    define("CAPS", lights.caps);
    define("LIGHTS", lights.all());
    define("ENVIRONMENT", int{scene.lights.environment != nullptr});
    define("POLARISED_LIGHTS", int{polarised(scene.lights)});
    define("BALANCE", int{balance});
    // Makes line numbers in a driver's errors match the file, up to the first plane.
    text += "#line 1\n";
    constexpr std::string_view k_mark = "    //! planes\n";
    const std::string planes = planes_of(scene.stone.solid, middle);
    std::string_view rest = embedded::gpu_kernel;
    for (std::size_t at; (at = rest.find(k_mark)) != std::string_view::npos;) {
        text += rest.substr(0, at);
        text += planes;
        rest.remove_prefix(at + k_mark.size());
    }
    return text += rest;
}

Vec3 middle_of(const Solid& solid) {
    Vec3 low(1e300), high(-1e300);
    for (const Vec3& corner : solid.vertices) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    return 0.5 * (low + high);
}

GpuTexture environment_texture(const EnvironmentMap& map) {
    GpuTexture texture{"u_environment", k_gpu_length_unit + 1, map.width, map.height, {}};
    for (std::size_t i = 0; i < map.rgb.size(); i += 3)
        texture.rgba.insert(texture.rgba.end(), {map.rgb[i], map.rgb[i + 1], map.rgb[i + 2], 1.0f});
    return texture;
}

// The lamps' radiance over their greatest, one below the other: half degrees from the zero angle
// downwards, and of azimuth from `zero` to the right. Linear between; exact for files whose angles
// are multiples of half a degree, as those of type C are.
GpuTexture lamp_texture(const Lights& lights) {
    constexpr int k_columns = 721, k_rows = 361;
    GpuTexture texture{"u_lamp_shares", k_gpu_length_unit + 2, k_columns, 0, {}};
    for (const LampLight& lamp : lights_of_type<LampLight>(lights)) {
        const Vec3 y = glm::cross(lamp.zero, lamp.axis);
        for (int row = 0; row < k_rows; ++row) {
            const double v = radians(0.5 * row);
            for (int column = 0; column < k_columns; ++column) {
                const double h = radians(0.5 * column);
                const Vec3 out = std::sin(v) * (std::cos(h) * lamp.zero + std::sin(h) * y) +
                                 std::cos(v) * lamp.axis;
                const auto share = static_cast<float>(share_of(lamp, -out));
                texture.rgba.insert(texture.rgba.end(), {share, share, share, 1.0f});
            }
        }
        texture.height += k_rows;
    }
    return texture;
}

}  // namespace

std::string refused_by_gpu(const Scene& scene) {
    if (!scene.has_stone()) return "the GPU kernel draws a stone, and the scene has none";
    if (scene.has_objects())
        return "the GPU kernel draws one stone alone, without objects around it";
    if (!scene.stone.convex) return "the GPU kernel is for convex stones only";
    if (const std::string frosted = frosted_tiers(scene.stone.solid); !frosted.empty())
        return fmt::format("the GPU kernel draws polished facets, and some are frosted (tiers {})",
                           frosted);
    if (scene.camera.optics.two_windows)
        return "the GPU kernel draws one window, a dichroscope has two";
    if (scene.camera.cone)
        return "the GPU kernel draws points of the stone, a conoscope shows directions";
    const LightCounts lights = count_lights(scene.lights);
    if (gpu_vectors(lights) > k_most_gpu_vectors) {
        return fmt::format("the GPU kernel has no room for {} lights beside each other",
                           lights.all());
    }
    return {};
}

void require_drawn_by_gpu(const Scene& scene) {
    const std::string why = refused_by_gpu(scene);
    if (!why.empty()) throw InputError(why + ": say engine = \"reference\"");
}

GpuProgram gpu_program(const Scene& scene, const OpticalSetup& setup, const WavelengthSet& colours,
                       const GpuOptions& options) {
    require_drawn_by_gpu(scene);
    const GpuLayout layout =
        gpu_layout(setup, count_lights(scene.lights), std::max(options.pass_wavelengths, 1));
    GpuProgram program;
    program.middle = middle_of(scene.stone.solid);
    program.vertex = std::string(k_version) + embedded::gpu_vertex;
    program.display = std::string(k_version) + embedded::gpu_display;
    program.kernel = kernel_source(scene, setup, layout, program.middle, options.balance);
    program.uniforms = {
        {"u_depth", 1, true, {static_cast<float>(options.depth)}},
        {"u_cut", 1, false, {static_cast<float>(options.cut_weight)}},
        {"u_light_turn", 9, false, {1, 0, 0, 0, 1, 0, 0, 0, 1}},
    };
    if (options.balance) {
        GpuUniform weights{"u_luminance", 3, false, {}};
        for (const Rgb& primary : {Rgb{1, 0, 0}, Rgb{0, 1, 0}, Rgb{0, 0, 1}})
            weights.values.push_back(static_cast<float>(luminance(primary)));
        program.uniforms.push_back(std::move(weights));
    }
    if (layout.crystal) {
        GpuUniform principal{"u_principal", 3, false, {}};
        for (const Vec3& axis : setup.bands.front().crystal.axes()) {
            for (int k = 0; k < 3; ++k) principal.values.push_back(static_cast<float>(axis[k]));
        }
        program.uniforms.push_back(std::move(principal));
    }
    const ShadedLights lights(scene.lights, colours, 0, colours.size(), program.middle, nullptr);
    program.passes =
        gpu_passes(setup, colours, layout, lights, scene.lights.environment != nullptr);
    if (scene.lights.environment)
        program.textures.push_back(environment_texture(*scene.lights.environment));
    if (count_lights<LampLight>(scene.lights) > 0)
        program.textures.push_back(lamp_texture(scene.lights));
    return program;
}

}  // namespace culet
