#include "render/reference/prepared_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/reference/pixel_shader.h"

namespace culet {

namespace {

// Crystals: a path that carries more than this splits in two at every hit.
constexpr double k_split_weight = 0.02;
constexpr double k_roulette_weight = 1e-3;
constexpr double k_cut_with_objects = 0.1, k_roulette_with_objects = 0.01;
constexpr int k_pilot_pixels = 16;  // along the picture's longer side
constexpr int k_spectral_pixels = 10, k_spectral_samples = 16;
constexpr int k_spectral_depth = 12, k_spectral_crystal_depth = 6;  // of trees that double

// Calls visit(x, y, size) for an even choice of pixels.
template <class Visit>
void each_pilot_pixel(const Camera& camera, int along, Visit&& visit) {
    const double step =
        std::max(1.0, static_cast<double>(std::max(camera.width, camera.height)) / along);
    for (double y = 0; y < camera.height; y += step) {
        for (double x = 0; x < camera.width; x += step) visit(x, y, step);
    }
}

// Mean luminance of the stone's pixels in a small, shallow picture; 0 if no ray hits it.
double pilot_mean(const Scene& scene, PreparedScene& prepared) {
    const PathLimits before = prepared.limits;
    prepared.limits.depth = 16;
    prepared.limits.cut_weight = 1e-3;
    prepared.limits.split_weight = 1;
    prepared.limits.roulette = false;
    const PixelShader shader(scene, prepared, 1);
    prepared.limits = before;
    std::vector<double> stokes(prepared.setup.wavelengths_nm.size() *
                               static_cast<std::size_t>(shader.planes()));
    PixelMemory memory;
    double sum = 0, hits = 0;
    each_pilot_pixel(scene.camera, k_pilot_pixels, [&](double x, double y, double size) {
        const PixelSums pixel = shader.shade(x, y, size, 0, stokes.data(), memory);
        hits += pixel.counted;
        sum += pixel.luminance;
    });
    return hits > 0 ? sum / hits : 0;
}

// The scene's depth and seed, without cutting.
PathLimits uncut_limits(const RenderSettings& settings, const OpticalSetup& setup) {
    PathLimits limits;
    limits.seed = settings.seed;
    limits.polarised = setup.polarised;
    limits.depth = settings.depth > 0 ? settings.depth : k_deepest;
    return limits;
}

// Sets the limits by the scene, or else by its tolerance.
void set_limits(const Scene& scene, PreparedScene& prepared) {
    const RenderSettings& settings = scene.settings;
    PathLimits& limits = prepared.limits;
    if (scene.has_objects()) {
        limits = limits_with_objects(scene, prepared.setup);
        return;
    }
    limits = uncut_limits(settings, prepared.setup);
    if (!(settings.tolerance > 0)) return;
    const bool branch = paths_branch(scene, prepared.setup);
    if (settings.cut_weight) {
        limits.cut_weight = *settings.cut_weight;
        limits.roulette = branch;
        limits.split_weight = settings.split_weight.value_or(k_split_weight);
        return;
    }
    const double mean = pilot_mean(scene, prepared);
    const double brightest = prepared.surroundings->max_radiance();
    // A cut path would see at most the brightest light. Half of that bound is used, because the
    // pilot's mean is off by a few per cent.
    limits.cut_weight = brightest > 0 && mean > 0 ? 0.5 * settings.tolerance * mean / brightest
                                                  : settings.tolerance;
    limits.cut_weight = std::min(limits.cut_weight, settings.tolerance);
    limits.split_weight = std::max(k_split_weight, limits.cut_weight);
    // Trees that branch play Russian roulette instead: noise, but no bias. The limit keeps very
    // bright lights from making this as expensive as cutting.
    limits.roulette = branch;
    if (branch) limits.cut_weight = std::max(limits.cut_weight, k_roulette_weight);
}

// Fewest wavelengths whose colours differ from the finest set's by less than the tolerance (root
// mean square over some pixels, relative to their mean). Paths of a few faces suffice: they carry
// most of the light.
OpticalSetup setup_for_tolerance(const Scene& scene) {
    OpticalSetup setup = make_optical_setup(scene);
    if (!(scene.settings.tolerance > 0) || !chose_spectrum(scene, setup)) return setup;
    PathLimits limits;
    limits.depth = setup.splits ? k_spectral_crystal_depth : k_spectral_depth;
    limits.cut_weight = 1e-4;
    limits.split_weight = 0;
    const PreparedScene finest(scene, k_node_counts.back(), limits);
    const PixelShader shader(scene, finest, k_spectral_samples);
    const std::size_t nodes = finest.setup.wavelengths_nm.size();
    std::vector<double> stokes(nodes * static_cast<std::size_t>(shader.planes()));
    PixelMemory memory;
    std::vector<std::vector<double>> spectra;
    each_pilot_pixel(scene.camera, k_spectral_pixels, [&](double x, double y, double) {
        if (shader.shade(x, y, 1, 0, stokes.data(), memory).counted > 0)
            spectra.emplace_back(stokes.begin(), stokes.begin() + static_cast<long>(nodes));
    });
    for (int count : k_node_counts) {
        const OpticalSetup coarse = make_optical_setup(scene, count);
        const std::size_t every = (nodes - 1) / (coarse.wavelengths_nm.size() - 1);
        const WavelengthSet few(coarse.wavelengths_nm);
        double squares = 0, mean = 0;
        std::vector<double> chosen(coarse.wavelengths_nm.size());
        for (const std::vector<double>& spectrum : spectra) {
            for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = spectrum[i * every];
            const Rgb fine = finest.colours.rgb_of(spectrum.data()),
                      rough = few.rgb_of(chosen.data());
            for (int c = 0; c < 3; ++c) {
                squares += (fine[c] - rough[c]) * (fine[c] - rough[c]);
                mean += fine[c];
            }
        }
        const double values = 3 * static_cast<double>(spectra.size());
        if (std::sqrt(squares * values) <= scene.settings.tolerance * mean) return coarse;
    }
    return finest.setup;
}

}  // namespace

PathLimits limits_with_objects(const Scene& scene, const OpticalSetup& setup) {
    const RenderSettings& settings = scene.settings;
    PathLimits limits = uncut_limits(settings, setup);
    if (!(settings.tolerance > 0)) return limits;
    const bool branch = paths_branch(scene, setup);
    limits.roulette = branch;
    limits.split_weight = settings.split_weight.value_or(k_split_weight);
    const double usual = k_cut_with_objects * settings.tolerance;
    limits.cut_weight =
        settings.cut_weight.value_or(branch ? std::max(usual, k_roulette_with_objects) : usual);
    return limits;
}

PreparedScene::PreparedScene(const Scene& scene)
    : setup(setup_for_tolerance(scene)),
      colours(setup.colours()),
      surroundings(surroundings_of(scene, colours)) {
    set_limits(scene, *this);
}

PreparedScene::PreparedScene(const Scene& scene, int nodes, const PathLimits& as_given)
    : setup(make_optical_setup(scene, nodes)),
      colours(setup.colours()),
      surroundings(surroundings_of(scene, colours)),
      limits(as_given) {
    limits.polarised = setup.polarised;
    limits.roulette = limits.roulette && paths_branch(scene, setup);
}

void PreparedScene::look(const Scene& scene, OpticalSetup anew) {
    setup = std::move(anew);
    set_limits(scene, *this);
}

}  // namespace culet
