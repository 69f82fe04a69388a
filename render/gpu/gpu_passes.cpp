#include "render/gpu/gpu_passes.h"

#include <algorithm>

#include "render/optics/merged_crystal.h"

namespace culet {

namespace {

constexpr int k_fixed_vectors = 24;  // view, limits, light turn, crystal axes, textures
constexpr int k_most_nodes = 4;      // per path: a vec4

// Uniform vectors per path.
int vectors_of_path(int nodes, const LightCounts& lights) {
    return 12 + nodes + lights.all();
}

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

struct PassMaker {
    const OpticalSetup& setup;
    const WavelengthSet& colours;
    const GpuLayout& layout;
    const ShadedLights& lights;
    const bool environment;

    // Fills an element per path with a number per node; padding is 0.
    template <class Value>
    void per_node(GpuPass& pass, std::size_t first, std::size_t count, const char* name,
                  Value&& value) const {
        Filler filler(pass, name, layout.nodes);
        for (std::size_t i = first; i < first + count; ++i) {
            const GpuPath& path = layout.all[i];
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
            per_node(pass, first, count, "u_absorption", [&](const GpuPath& path, int node) {
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
            const GpuPath& path = layout.all[i];
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
                 [&](const GpuPath&, int) { return 1.0 / static_cast<double>(nodes); });
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
                const GpuPath& path = layout.all[i];
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
            return [this, which](const GpuPath&, int node) {
                return colours.primaries()[which][static_cast<std::size_t>(node)];
            };
        };
        per_node(pass, first, count, "u_red", primary(0));
        per_node(pass, first, count, "u_blue", primary(2));
    }

    GpuPass pass(std::size_t first, std::size_t count) const {
        GpuPass pass;
        pass.first = layout.all[first].first;
        const GpuPath& last = layout.all[first + count - 1];
        pass.count = last.first + last.count - pass.first;
        pass.uniforms.push_back({"u_paths", 1, true, {static_cast<float>(count)}});
        add_optics(pass, first, count);
        if (layout.crystal) add_crystal(pass, first, count);
        add_colours(pass, first, count);
        add_lights(pass, first, count);
        return pass;
    }
};

}  // namespace

GpuLayout gpu_layout(const OpticalSetup& setup, const LightCounts& lights, int pass_wavelengths) {
    GpuLayout layout;
    int most = 1;
    for (const Band& band : setup.bands) {
        most = std::max(most, band.count);
        layout.crystal = layout.crystal || band.two_waves;
        layout.absorbs = layout.absorbs || band.absorbs;
    }
    // Polarised light is carried for one wavelength at a time.
    layout.nodes =
        layout.crystal || setup.stokes ? 1 : std::min({most, k_most_nodes, pass_wavelengths});
    for (std::size_t b = 0; b < setup.bands.size(); ++b) {
        const Band& band = setup.bands[b];
        for (int first = 0; first < band.count; first += layout.nodes)
            layout.all.push_back(
                {b, band.first + first, std::min(layout.nodes, band.count - first)});
    }
    const int room = (k_most_gpu_vectors - k_fixed_vectors - lights.vectors()) /
                     vectors_of_path(layout.nodes, lights);
    layout.paths = std::clamp(std::min(pass_wavelengths / layout.nodes, room), 1,
                              static_cast<int>(layout.all.size()));
    return layout;
}

int gpu_vectors(const LightCounts& lights) {
    return k_fixed_vectors + lights.vectors() + vectors_of_path(k_most_nodes, lights);
}

std::vector<GpuPass> gpu_passes(const OpticalSetup& setup, const WavelengthSet& colours,
                                const GpuLayout& layout, const ShadedLights& lights,
                                bool environment) {
    const PassMaker maker{setup, colours, layout, lights, environment};
    const std::size_t per_pass = static_cast<std::size_t>(layout.paths);
    std::vector<GpuPass> passes;
    for (std::size_t first = 0; first < layout.all.size(); first += per_pass)
        passes.push_back(maker.pass(first, std::min(per_pass, layout.all.size() - first)));
    return passes;
}

}  // namespace culet
