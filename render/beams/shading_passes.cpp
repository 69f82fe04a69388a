#include "render/beams/shading_passes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "render/optics/eye_optics.h"

namespace culet {

namespace {

float number(double v) {
    return static_cast<float>(v);
}

}  // namespace

std::vector<ShadingPass> shading_passes(const Scene& scene, const OpticalSetup& setup,
                                        const WavelengthSet& colours, const Vec3& middle,
                                        std::shared_ptr<const EnvironmentPyramid> environment,
                                        int stokes, bool split) {
    const std::size_t nodes = setup.wavelengths_nm.size();
    const bool responds = setup.stokes;
    std::vector<ShadingPass> passes;
    const auto add = [&](std::size_t b, int first, int count, int k) {
        const Band& band = setup.bands[b];
        const double nm = setup.wavelengths_nm[static_cast<std::size_t>(first)];
        const Stokes seen = response(scene.camera.optics, nm);
        ShadingPass pass;
        pass.beams = b;
        pass.n = band.n / band.n_outside;
        pass.plane = static_cast<std::size_t>(k) * nodes + static_cast<std::size_t>(first);
        pass.counts_area = passes.empty();
        // Remainders are relative to the eye's unit of light, which only the pass of S0 carries
        // completely.
        const double unit = stokes == 4 || !responds ? 1 : seen[0];
        pass.weight = k == 0 ? 1 / (unit * static_cast<double>(nodes)) : 0;
        std::vector<double> one(nodes, 0.0);
        for (int i = first; i < first + count; ++i) {
            one[static_cast<std::size_t>(i)] = 1;
            const double of_node = luminance(colours.rgb_of(one.data()));
            one[static_cast<std::size_t>(i)] = 0;
            pass.luminance.push_back(stokes == 4 ? of_node * seen[static_cast<std::size_t>(k)]
                                                 : of_node);
        }
        pass.optics.n = number(pass.n);
        pass.optics.polarised = setup.polarised;
        const int node = first - band.first;
        if (band.two_waves && split) {
            auto waves = std::make_shared<ShadingPass::SplitWaves>();
            waves->band = band;
            waves->band.first = first;
            waves->band.count = count;
            for (auto& absorption : waves->band.absorption)
                std::copy_n(absorption.begin() + node, count, absorption.begin());
            if (responds) {
                for (std::size_t j = 0; j < 4; ++j)
                    waves->response[j] =
                        stokes == 4 ? static_cast<double>(static_cast<int>(j) == k) : seen[j];
            }
            waves->polarised_lights = polarised(scene.lights);
            pass.split = std::move(waves);
        } else if (band.two_waves) {
            pass.optics.crystal = merged_crystal(band, node);
        } else if (band.absorbs) {
            for (int i = node; i < node + count; ++i)
                pass.optics.absorption.push_back(
                    number(band.absorption[0][static_cast<std::size_t>(i)]));
        }
        if (responds) {
            std::array<float, 4> row{};
            for (std::size_t j = 0; j < 4; ++j)
                row[j] =
                    stokes == 4 ? static_cast<float>(static_cast<int>(j) == k) : number(seen[j]);
            pass.optics.response = row;
        }
        pass.lights = ShadedLights(scene.lights, colours, first, count, middle, environment);
        passes.push_back(std::move(pass));
    };
    for (std::size_t b = 0; b < setup.bands.size(); ++b) {
        const Band& band = setup.bands[b];
        if (!responds && (!band.two_waves || split)) {
            add(b, band.first, band.count, 0);
            continue;
        }
        for (int k = 0; k < stokes; ++k) {
            for (int i = 0; i < band.count; ++i) add(b, band.first + i, 1, k);
        }
    }
    return passes;
}

}  // namespace culet
