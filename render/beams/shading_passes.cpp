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

// Luminance of each node, times `factor`.
std::vector<double> luminances(const WavelengthSet& colours, int first, int count, double factor) {
    std::vector<double> one(static_cast<std::size_t>(colours.size()), 0.0), found;
    for (int i = first; i < first + count; ++i) {
        one[static_cast<std::size_t>(i)] = 1;
        found.push_back(luminance(colours.rgb_of(one.data())) * factor);
        one[static_cast<std::size_t>(i)] = 0;
    }
    return found;
}

// A part of a band, with its two waves apart.
ShadingPass::SplitWaves waves_of(const Band& band, int first, int count, const Scene& scene) {
    ShadingPass::SplitWaves waves;
    waves.band = band;
    waves.band.first = first;
    waves.band.count = count;
    for (auto& absorption : waves.band.absorption)
        std::copy_n(absorption.begin() + (first - band.first), count, absorption.begin());
    waves.polarised_lights = polarised(scene.lights);
    return waves;
}

}  // namespace

std::vector<ShadingPass> shading_passes(const Scene& scene, const OpticalSetup& setup,
                                        const WavelengthSet& colours, const Vec3& middle,
                                        std::shared_ptr<const EnvironmentPyramid> environment,
                                        int stokes, bool split) {
    const std::size_t nodes = setup.wavelengths_nm.size();
    const bool responds = setup.stokes;
    std::vector<ShadingPass> passes;
    const auto add = [&](std::size_t b, int first, int count, std::size_t k) {
        const Band& band = setup.bands[b];
        const Stokes seen =
            response(scene.camera.optics, setup.wavelengths_nm[static_cast<std::size_t>(first)]);
        Stokes row = seen;
        for (std::size_t j = 0; stokes == 4 && j < 4; ++j) row[j] = j == k ? 1 : 0;
        ShadingPass pass;
        pass.beams = b;
        pass.n = band.n / band.n_outside;
        pass.plane = k * nodes + static_cast<std::size_t>(first);
        pass.counts_area = passes.empty();
        // Remainders are relative to the eye's unit of light, which only the pass of S0 carries
        // completely.
        const double unit = stokes == 4 || !responds ? 1 : seen[0];
        pass.weight = k == 0 ? 1 / (unit * static_cast<double>(nodes)) : 0;
        pass.luminance = luminances(colours, first, count, stokes == 4 ? seen[k] : 1);
        pass.optics.n = number(pass.n);
        pass.optics.polarised = setup.polarised;
        const int node = first - band.first;
        if (band.two_waves && split) {
            ShadingPass::SplitWaves waves = waves_of(band, first, count, scene);
            if (responds) waves.response = row;
            pass.split = std::make_shared<ShadingPass::SplitWaves>(std::move(waves));
        } else if (band.two_waves) {
            pass.optics.crystal = merged_crystal(band, node);
        } else if (band.absorbs) {
            for (int i = node; i < node + count; ++i)
                pass.optics.absorption.push_back(
                    number(band.absorption[0][static_cast<std::size_t>(i)]));
        }
        if (responds)
            pass.optics.response = {number(row[0]), number(row[1]), number(row[2]), number(row[3])};
        pass.lights = ShadedLights(scene.lights, colours, first, count, middle, environment);
        passes.push_back(std::move(pass));
    };
    for (std::size_t b = 0; b < setup.bands.size(); ++b) {
        const Band& band = setup.bands[b];
        if (!responds && (!band.two_waves || split)) {
            add(b, band.first, band.count, 0);
            continue;
        }
        for (std::size_t k = 0; k < static_cast<std::size_t>(stokes); ++k) {
            for (int i = 0; i < band.count; ++i) add(b, band.first + i, 1, k);
        }
    }
    return passes;
}

// By Snell's law the borders of two wavelengths' beams differ by an angle of at most
// |dn| / (n sqrt(n^2 - 1)), over the path through the stone. Bands share beams while that is below
// the allowed map error.
std::vector<std::size_t> shared_beams(const OpticalSetup& setup, const ScreenView& view,
                                      const Vec3& middle, double size, const BeamLimits& limits) {
    // Segments measure about 2/3 of the stone; few longer paths carry light.
    constexpr double k_segment = 2.0 / 3;
    constexpr int k_longest = 16;
    const ScreenImage here = view.of_point(middle),
                      beside = view.of_point(middle + size * view.right);
    const double pixels =
        std::hypot(beside.x / beside.z - here.x / here.z, beside.y / beside.z - here.y / here.z);
    const double way = k_segment * std::min(limits.depth, k_longest) * pixels;
    std::vector<std::size_t> leader(setup.bands.size());
    for (std::size_t first = 0; first < leader.size();) {
        const auto index = [&](std::size_t b) {
            return setup.bands[b].n / setup.bands[b].n_outside;
        };
        const auto apart = [&](std::size_t a, std::size_t b) {
            const double n = std::min(index(a), index(b));
            return way * std::abs(index(a) - index(b)) / (n * std::sqrt((n - 1) * (n + 1)));
        };
        std::size_t middle_band = first, end = first + 1;
        // Extend from both ends to the middle band.
        while (end < leader.size() && apart(first, end) <= 2 * limits.map_error) {
            ++end;
            while (middle_band + 1 < end && apart(first, middle_band + 1) <= limits.map_error)
                ++middle_band;
        }
        while (end > first + 1 && apart(middle_band, end - 1) > limits.map_error) --end;
        for (; first < end; ++first) leader[first] = std::min(middle_band, end - 1);
    }
    return leader;
}

}  // namespace culet
