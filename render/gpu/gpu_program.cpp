#include "render/gpu/gpu_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string_view>

#include "render/beams/beam_lights.h"
#include "render/gpu/light_counts.h"
#include "render/optics/merged_crystal.h"
#include "stone/errors.h"

namespace culet {

namespace embedded {
extern const char* const gpu_vertex;
extern const char* const gpu_kernel;
extern const char* const gpu_display;
}  // namespace embedded

namespace {

// WebGL2 promises 224 vectors of uniforms to a fragment shader.
constexpr int k_uniform_vectors = 200;
constexpr int k_fixed_vectors = 24;  // view, limits, turn of the lights, crystal's axes, textures
constexpr int k_most_nodes = 4;      // of one path: a vec4

constexpr const char* k_version = "#version 300 es\n";

// Wavelengths that go one way together.
struct Path {
    std::size_t band = 0;
    int first = 0, count = 1;  // of the setup's wavelengths
};

struct Layout {
    int nodes = 1;  // of a path, absent ones included
    int paths = 1;  // of a pass at most
    bool crystal = false, absorbs = false;
    std::vector<Path> all;
};

// Vectors of uniforms of one path.
int vectors_of_path(int nodes, const LightCounts& lights) {
    return 12 + nodes + lights.all();
}

Layout layout_of(const OpticalSetup& setup, const LightCounts& lights, int pass_wavelengths) {
    Layout layout;
    int most = 1;
    for (const Band& band : setup.bands) {
        most = std::max(most, band.count);
        layout.crystal = layout.crystal || band.two_waves;
        layout.absorbs = layout.absorbs || band.absorbs;
    }
    // What is carried of polarised light is of one wavelength.
    layout.nodes =
        layout.crystal || setup.stokes ? 1 : std::min({most, k_most_nodes, pass_wavelengths});
    for (std::size_t b = 0; b < setup.bands.size(); ++b) {
        const Band& band = setup.bands[b];
        for (int first = 0; first < band.count; first += layout.nodes)
            layout.all.push_back(
                {b, band.first + first, std::min(layout.nodes, band.count - first)});
    }
    const int room = (k_uniform_vectors - k_fixed_vectors - lights.vectors()) /
                     vectors_of_path(layout.nodes, lights);
    layout.paths = std::clamp(std::min(pass_wavelengths / layout.nodes, room), 1,
                              static_cast<int>(layout.all.size()));
    return layout;
}

// A number that reads back as the same float.
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

std::string kernel_source(const Scene& scene, const OpticalSetup& setup, const Layout& layout,
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
    define("PLANE_LIGHTS", lights.planes);
    define("LOBES", lights.lobes);
    define("CAPS", lights.caps);
    define("LIGHTS", lights.all());
    define("ENVIRONMENT", int{scene.lights.environment != nullptr});
    define("POLARISED_LIGHTS", int{polarised(scene.lights)});
    define("BALANCE", int{balance});
    // Line numbers of a driver's errors are those of the file, up to the first plane.
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

// Adds a uniform's elements one after another.
class Filler {
public:
    Filler(GpuPass& pass, const char* name, int components)
        : pass_(pass), uniform_{name, components, false, {}} {}
    void add(double v) { uniform_.values.push_back(static_cast<float>(v)); }
    void done() { pass_.uniforms.push_back(std::move(uniform_)); }

private:
    GpuPass& pass_;
    GpuUniform uniform_;
};

// What the passes of a scene are made of.
struct PassMaker {
    const OpticalSetup& setup;
    const WavelengthSet& colours;
    const Layout& layout;
    const ShadedLights lights;
    const bool environment;

    // Fills an element for each path, `per_node` a number for each node; absent ones are 0.
    template <class Value>
    void per_node(GpuPass& pass, std::size_t first, std::size_t count, const char* name,
                  Value&& value) const {
        Filler filler(pass, name, layout.nodes);
        for (std::size_t i = first; i < first + count; ++i) {
            const Path& path = layout.all[i];
            for (int k = 0; k < layout.nodes; ++k)
                filler.add(k < path.count ? value(path, path.first + k) : 0.0);
        }
        filler.done();
    }

    void add_optics(GpuPass& pass, std::size_t first, std::size_t count) const {
        Filler optics(pass, "u_optics", 3);
        for (std::size_t i = first; i < first + count; ++i) {
            const Band& band = setup.bands[layout.all[i].band];
            const double n = band.n / band.n_outside;
            for (const double v : {n, (n - 1) * (n + 1), n * n}) optics.add(v);
        }
        optics.done();
        if (layout.absorbs && !layout.crystal) {
            per_node(pass, first, count, "u_absorption", [&](const Path& path, int node) {
                const Band& band = setup.bands[path.band];
                return band.absorbs
                           ? band.absorption[0][static_cast<std::size_t>(node - band.first)]
                           : 0.0;
            });
        }
    }

    void add_crystal(GpuPass& pass, std::size_t first, std::size_t count) const {
        Filler axes(pass, "u_optic_axis", 3), waves(pass, "u_waves", 4),
            absorption(pass, "u_principal_absorption", 3);
        for (std::size_t i = first; i < first + count; ++i) {
            const Band& band = setup.bands[layout.all[i].band];
            const std::size_t node = static_cast<std::size_t>(layout.all[i].first - band.first);
            MergedCrystal crystal{};
            if (band.two_waves) {
                crystal = merged_crystal(band, static_cast<int>(node));
            } else {
                // Isotropic at this wavelength: any axes, no retardation.
                crystal.optic_axis[0][2] = crystal.optic_axis[1][2] = 1;
                for (std::size_t k = 0; k < 3; ++k)
                    crystal.absorption[k] =
                        band.absorbs ? static_cast<float>(band.absorption[k][node]) : 0.0f;
            }
            for (const auto& axis : crystal.optic_axis) {
                for (const float v : axis) axes.add(static_cast<double>(v));
            }
            for (const float v : {crystal.inverse_square[0], crystal.inverse_square[1],
                                  crystal.waves_per_length, crystal.coherence_per_length})
                waves.add(static_cast<double>(v));
            for (const float v : crystal.absorption) absorption.add(static_cast<double>(v));
        }
        axes.done();
        waves.done();
        absorption.done();
    }

    void add_colours(GpuPass& pass, std::size_t first, std::size_t count) const {
        Filler colour(pass, "u_colour", 3);
        const std::size_t nodes = setup.wavelengths_nm.size();
        std::vector<double> one(nodes, 0.0);
        for (std::size_t i = first; i < first + count; ++i) {
            const Path& path = layout.all[i];
            for (int k = 0; k < layout.nodes; ++k) {
                Rgb rgb{0, 0, 0};
                if (k < path.count) {
                    double& here = one[static_cast<std::size_t>(path.first + k)];
                    here = 1;
                    rgb = colours.rgb_of(one.data());
                    here = 0;
                }
                for (const double v : rgb) colour.add(v);
            }
        }
        colour.done();
        per_node(pass, first, count, "u_share",
                 [&](const Path&, int) { return 1.0 / static_cast<double>(nodes); });
    }

    void add_lights(GpuPass& pass, std::size_t first, std::size_t count) const {
        std::vector<const std::vector<float>*> radiance;
        const auto add = [&radiance](const auto& of_kind) {
            for (const auto& light : of_kind) radiance.push_back(&light.radiance);
        };
        add(lights.spheres);
        add(lights.planes);
        add(lights.lobes);
        add(lights.caps);
        if (!radiance.empty()) {
            Filler filler(pass, "u_radiance", layout.nodes);
            for (std::size_t i = first; i < first + count; ++i) {
                const Path& path = layout.all[i];
                for (const std::vector<float>* light : radiance) {
                    for (int k = 0; k < layout.nodes; ++k)
                        filler.add(k < path.count
                                       ? static_cast<double>(
                                             (*light)[static_cast<std::size_t>(path.first + k)])
                                       : 0.0);
                }
            }
            filler.done();
        }
        if (!environment) return;
        const auto primary = [&](std::size_t which) {
            return [this, which](const Path&, int node) {
                return colours.primaries()[which][static_cast<std::size_t>(node)];
            };
        };
        per_node(pass, first, count, "u_red", primary(0));
        per_node(pass, first, count, "u_blue", primary(2));
    }

    GpuPass pass(std::size_t first, std::size_t count) const {
        GpuPass pass;
        pass.first = layout.all[first].first;
        const Path& last = layout.all[first + count - 1];
        pass.count = last.first + last.count - pass.first;
        pass.uniforms.push_back({"u_paths", 1, true, {static_cast<float>(count)}});
        add_optics(pass, first, count);
        if (layout.crystal) add_crystal(pass, first, count);
        add_colours(pass, first, count);
        add_lights(pass, first, count);
        return pass;
    }
};

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

}  // namespace

std::string refused_by_gpu(const Scene& scene, const OpticalSetup& setup) {
    if (!scene.has_stone()) return "the GPU kernel draws a stone, and the scene has none";
    if (scene.furnished()) return "the GPU kernel draws one stone alone, without objects around it";
    if (!scene.stone.convex) return "the GPU kernel is for convex stones only";
    if (scene.camera.optics.two_windows)
        return "the GPU kernel draws one window, a dichroscope has two";
    if (scene.camera.cone)
        return "the GPU kernel draws points of the stone, a conoscope shows directions";
    const LightCounts lights = count_lights(scene.lights);
    const int nodes = setup.bands.empty() ? 1 : k_most_nodes;
    const int needed = k_fixed_vectors + lights.vectors() + vectors_of_path(nodes, lights);
    if (needed > k_uniform_vectors) {
        return fmt::format("the GPU kernel has no room for {} lights beside each other",
                           lights.all());
    }
    return {};
}

GpuProgram gpu_program(const Scene& scene, const OpticalSetup& setup, const WavelengthSet& colours,
                       const GpuOptions& options) {
    const std::string why = refused_by_gpu(scene, setup);
    if (!why.empty()) throw InputError(why + ": say engine = \"reference\"");
    const Layout layout =
        layout_of(setup, count_lights(scene.lights), std::max(options.pass_wavelengths, 1));
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
    const PassMaker maker{
        setup, colours, layout,
        ShadedLights(scene.lights, colours, 0, colours.size(), program.middle, nullptr),
        scene.lights.environment != nullptr};
    const std::size_t per_pass = static_cast<std::size_t>(layout.paths);
    for (std::size_t first = 0; first < layout.all.size(); first += per_pass)
        program.passes.push_back(maker.pass(first, std::min(per_pass, layout.all.size() - first)));
    if (scene.lights.environment)
        program.textures.push_back(environment_texture(*scene.lights.environment));
    return program;
}

}  // namespace culet
