#include "render/beams/beam_picture.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "render/beams/beam_renderer.h"
#include "render/optics/eye_optics.h"
#include "render/reference/light_field.h"
#include "render/reference/pilot.h"
#include "render/reference/pixel_shader.h"
#include "render/setup/a_priori.h"
#include "render/setup/scene_checks.h"
#include "render/work/threads.h"
#include "stone/errors.h"

namespace culet {

namespace {

// Pixels that are compared with the reference, and its rays in each: their own noise counts as the
// beams' error, which can only make the bound larger.
constexpr int k_checked_across = 64, k_check_samples = 16;
constexpr double k_standard_errors = 3;
// Beams that are cut for their share of the picture may be this many before they bring as much as
// those cut for their weight.
constexpr double k_cut_share = 1 / 4e5;
// Beams alone in their pixel, as a multiple of the tolerance: what they bring to it is some ten
// times as much, and as often too bright as too dark.
constexpr double k_alone = 10;
// A border that is off by a pixel brings its contrast to that pixel: borders may be off by this
// multiple of the tolerance, in pixels, within bounds between which accuracy is cheap (docs: "How
// fast, and how right"). Rays that are looked at again need less.
constexpr double k_map_error = 10, k_least_map_error = 0.02, k_least_verified = 0.1,
                 k_most_map_error = 0.25;
// Previews have one colour a beam, which is off by far more than a beam's borders, and by more than
// beams that bring less than that much to a pixel.
constexpr double k_preview_map_error = 1;  // pixels
constexpr double k_preview_alone = 4;      // square pixels
// Merged images that lie this far apart are off by as much: a tenth of a pixel at edges.
constexpr double k_seen_apart = 0.1;  // pixels

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}
double processor_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void require_beams(const Scene& scene, const OpticalSetup& setup) {
    const std::string why = refused_by_beams(scene, setup);
    if (!why.empty()) throw InputError(why + ": say engine = \"reference\"");
}

BeamSettings beam_settings(const Scene& scene, const PathLimits& limits) {
    BeamSettings settings;
    settings.limits.depth = limits.depth;
    settings.limits.cut_weight = limits.cut_weight;
    settings.limits.cut_share = k_cut_share * limits.cut_weight;
    settings.limits.most_beams = scene.settings.most_beams;
    settings.limits.alone = std::min(k_alone * scene.settings.tolerance, 0.5);
    settings.limits.refraction = scene.settings.refraction;
    settings.threads = scene.settings.threads;
    settings.shading = scene.settings.engine == "preview" ? BeamShading::flat
                       : scene.settings.samples == 1 && scene.camera.aperture_radius == 0
                           ? BeamShading::single
                           : BeamShading::averaged;
    settings.limits.map_error =
        std::clamp(k_map_error * scene.settings.tolerance,
                   settings.shading == BeamShading::single ? k_least_verified : k_least_map_error,
                   k_most_map_error);
    // Borders of many views are off this way and that.
    if (scene.camera.aperture_radius > 0) settings.limits.map_error = k_most_map_error;
    if (settings.shading == BeamShading::flat) {
        settings.limits.map_error = k_preview_map_error;
        settings.limits.alone = k_preview_alone;
    }
    return settings;
}

// Of the wavelength at which they lie farthest apart; pixels.
double images_apart(const Scene& scene, const OpticalSetup& setup) {
    double widest = 0;
    for (const Band& band : setup.bands) {
        const auto [low, high] =
            std::minmax_element(band.crystal.n().begin(), band.crystal.n().end());
        widest = std::max(
            widest, images_apart(scene, band.n / band.n_outside, (*high - *low) / band.n_outside));
    }
    return widest;
}

// What the scene calls for, with all that is made of it.
struct Called {
    OpticalSetup setup;
    WavelengthSet colours;
    LightField lights;
    PathLimits limits;
    CrystalBeams crystal = CrystalBeams::merged;
    std::string why;  // of that, where it matters

    /// Another camera, with the wavelengths that were chosen.
    void look(const Scene& scene) {
        OpticalSetup anew = make_optical_setup(scene, colours.size());
        require_beams(scene, anew);
        setup = std::move(anew);
        limits = limits_for(scene, setup, lights, colours);
        choose_crystal(scene);
    }

    explicit Called(const Scene& scene)
        : setup(setup_for_tolerance(scene)),
          colours(setup.wavelengths_nm),
          lights(scene.lights, colours),
          limits(limits_for(scene, setup, lights, colours)) {
        require_beams(scene, setup);
        choose_crystal(scene);
    }

private:
    void choose_crystal(const Scene& scene) {
        why.clear();
        crystal = CrystalBeams::merged;
        if (!setup.splits) return;
        const double apart = images_apart(scene, setup);
        if (scene.settings.crystal_beams) {
            crystal = *scene.settings.crystal_beams;
            why = "as the scene says";
        } else if (setup.on(Effects::coherence)) {
            why = "the two waves interfere";
        } else {
            crystal = apart > k_seen_apart ? CrystalBeams::parted : CrystalBeams::merged;
            why = fmt::format("their images lie {:.2g} pixels apart", apart);
        }
        why = fmt::format("; beams of the two waves {}: {}",
                          crystal == CrystalBeams::merged ? "merged" : "parted", why);
    }
};

}  // namespace

struct FrameRenderer::State {
    explicit State(const Scene& whole)
        : scene(whole),
          body(scene.stone.solid, scene.stone.convex),
          notes(notes_on_drawing(scene)),
          called(std::make_unique<Called>(scene)),
          renderer(scene.stone.solid) {}

    Scene scene;
    StoneBody body;
    std::vector<std::string> notes;
    std::unique_ptr<Called> called;
    BeamRenderer renderer;
    RenderResult result;
    double limit_ms = 0, cut = 0;  // of a beam's share, to keep within the limit
    Progress progress;

    void draw(bool check);
    void check(double filled);
};

void FrameRenderer::State::draw(bool with_check) {
    BeamSettings settings = beam_settings(scene, called->limits);
    settings.limits.cut_share = std::max(settings.limits.cut_share, cut);
    settings.crystal = called->crystal;
    const double started = processor_seconds();
    renderer.draw(scene, called->setup, called->colours, settings, result.picture, progress);
    const double took_ms = 1e3 * (processor_seconds() - started);
    const BeamReport& report = renderer.report();
    RenderStats& stats = result.stats;
    stats = {};
    stats.engine = scene.settings.engine;
    stats.depth = report.deepest;
    stats.effects.assign(called->setup.effects.begin(), called->setup.effects.end());
    stats.effects[static_cast<std::size_t>(Effects::birefringence)].why += called->why;
    stats.wavelengths_nm = called->setup.wavelengths_nm;
    stats.mean_radiance = report.luminance;
    stats.remainder = report.remainder;
    stats.absorbed = report.absorbed;
    stats.beams = report.beams;
    stats.rays = report.fragments;
    stats.retraced = report.retraced;
    stats.lost_area = report.lost_area;
    stats.seconds_build = report.seconds_build;
    stats.seconds_shade = report.seconds_shade;
    stats.notes = notes;
    stats.error_bound = std::numeric_limits<double>::quiet_NaN();
    if (with_check) check(report.filled);
    if (limit_ms > 0) {
        // The number of beams falls about with the root of the cut: steps towards the limit.
        const double ratio = took_ms / limit_ms;
        const double least = 1e-9;
        if (ratio > 1 || cut > 0) cut = std::max(cut, least) * ratio * ratio;
        if (cut < least) cut = 0;
    }
}

// Pixels on a grid, jittered by the golden ratio, as the reference sees them at the same depth.
void FrameRenderer::State::check(double filled) {
    const auto start = Clock::now();
    RenderStats& stats = result.stats;
    const Picture& picture = result.picture;
    const bool single = scene.settings.samples == 1;
    const int wanted = scene.settings.checked_pixels > 0 ? scene.settings.checked_pixels
                                                         : k_checked_across * k_checked_across;
    const int samples =
        scene.settings.checked_samples > 0 ? scene.settings.checked_samples : k_check_samples;
    const PixelShader shader(scene, called->setup, called->lights, called->colours, called->limits,
                             single && scene.camera.aperture_radius == 0 ? 1 : samples);
    std::vector<std::size_t> pixels;
    // A grid over the picture, or of so many pixels on the stone.
    const double area =
        scene.settings.checked_pixels > 0
            ? filled
            : std::pow(static_cast<double>(std::max(picture.width, picture.height)), 2);
    const double step = std::max(1.0, std::sqrt(area / wanted));
    int number = 0;
    for (double y = 0; y < picture.height; y += step) {
        for (double x = 0; x < picture.width; x += step, ++number) {
            const int px = static_cast<int>(x + step * std::fmod(number * 0.6180339887498949, 1.0)),
                      py = static_cast<int>(y + step * std::fmod(number * 0.7548776662466927, 1.0));
            if (px >= picture.width || py >= picture.height) continue;
            const std::size_t pixel =
                static_cast<std::size_t>(py) * static_cast<std::size_t>(picture.width) +
                static_cast<std::size_t>(px);
            if (picture.coverage[pixel] > 0) pixels.push_back(pixel);
        }
    }
    const int nodes = called->colours.size();
    std::vector<double> errors(pixels.size());
    on_threads(scene.settings.threads, [&] {
        tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t i) {
            PixelMemory memory;
            std::vector<double> stokes(static_cast<std::size_t>(nodes * shader.planes()));
            const int x = static_cast<int>(pixels[i] % static_cast<std::size_t>(picture.width)),
                      y = static_cast<int>(pixels[i] / static_cast<std::size_t>(picture.width));
            shader.shade(x, y, 1, pixels[i], stokes.data(), memory);
            // Behind the eye's optics.
            for (int k = 1; k < shader.planes(); ++k) {
                for (int node = 0; node < nodes; ++node) {
                    const Stokes row =
                        response(scene.camera.optics,
                                 called->setup.wavelengths_nm[static_cast<std::size_t>(node)]);
                    double& seen_there = stokes[static_cast<std::size_t>(node)];
                    if (k == 1) seen_there *= row[0];
                    seen_there += row[static_cast<std::size_t>(k)] *
                                  stokes[static_cast<std::size_t>(k * nodes + node)];
                }
            }
            const Rgb exact = called->colours.rgb_of(stokes.data());
            const float* seen = picture.rgb.data() + 3 * pixels[i];
            errors[i] = std::abs(luminance(exact) - luminance({static_cast<double>(seen[0]),
                                                               static_cast<double>(seen[1]),
                                                               static_cast<double>(seen[2])}));
        });
    });
    double sum = 0, squares = 0;
    for (double error : errors) {
        // A pixel of no number is as wrong as can be.
        if (!std::isfinite(error)) error = called->lights.max_radiance();
        sum += error;
        squares += error * error;
    }
    stats.checked_pixels = static_cast<int>(errors.size());
    if (!errors.empty() && stats.mean_radiance > 0) {
        const double count = static_cast<double>(errors.size()), mean = sum / count;
        const double spread = std::sqrt(std::max(0.0, squares / count - mean * mean) / count);
        stats.engine_error = (mean + k_standard_errors * spread) / stats.mean_radiance;
    }
    stats.error_bound = stats.engine_error;
    if (stats.mean_radiance > 0)
        stats.error_bound += stats.remainder * called->lights.max_radiance() / stats.mean_radiance;
    stats.seconds_check = seconds_since(start);
}

FrameRenderer::FrameRenderer(const Scene& scene) {
    require_renderable(scene);
    state_ = std::make_unique<State>(scene);
}
FrameRenderer::~FrameRenderer() = default;
FrameRenderer::FrameRenderer(FrameRenderer&&) noexcept = default;

void FrameRenderer::look_from(const Camera& camera) {
    require_outside(state_->body, camera);
    const Camera before = std::exchange(state_->scene.camera, camera);
    try {
        state_->called->look(state_->scene);
    } catch (...) {
        state_->scene.camera = before;
        throw;
    }
}

void FrameRenderer::light_with(const Lights& lights) {
    Scene changed = state_->scene;
    changed.lights = lights;
    state_->called = std::make_unique<Called>(changed);
    state_->scene = std::move(changed);
}

void FrameRenderer::show(const Scene& scene) {
    require_outside(state_->body, scene.camera);
    Scene changed = state_->scene;
    changed.camera = scene.camera;
    changed.lights = scene.lights;
    changed.settings = scene.settings;
    state_->called = std::make_unique<Called>(changed);
    state_->scene = std::move(changed);
}

void FrameRenderer::keep_within(double milliseconds) {
    state_->limit_ms = milliseconds;
    if (!(milliseconds > 0)) state_->cut = 0;
}

void FrameRenderer::report_to(const Progress& progress) {
    state_->progress = progress;
}

const RenderResult& FrameRenderer::draw(bool check) {
    state_->draw(check);
    return state_->result;
}

RenderResult FrameRenderer::take() {
    return std::move(state_->result);
}

std::string refused_by_beams(const Scene& scene, const OpticalSetup& setup) {
    if (!scene.stone.convex) return "beams are for convex stones only";
    for (const Band& band : setup.bands) {
        if (!(band.n > band.n_outside)) {
            return fmt::format("beams need a stone denser than what surrounds it, found {} in {}",
                               band.n, band.n_outside);
        }
    }
    if (scene.camera.optics.two_windows) return "beams draw one window, a dichroscope has two";
    if (scene.camera.cone) return "beams draw points of the stone, a conoscope shows directions";
    if (scene.settings.filter != PixelFilter::box || scene.settings.filter_radius != 0.5)
        return "beams average over the pixel's square: say filter = \"box\"";
    if (std::count_if(scene.lights.sources.begin(), scene.lights.sources.end(), is_near) >
        k_most_near_lights)
        return fmt::format("beams take at most {} near lights", k_most_near_lights);
    return {};
}

bool drawn_by_beams(const RenderSettings& settings) {
    return settings.engine == "beams" || settings.engine == "preview";
}

RenderResult render_with_beams(const Scene& scene, const Progress& progress) {
    const auto start = Clock::now();
    FrameRenderer frames(scene);
    frames.state_->progress = progress;
    frames.state_->draw(true);
    RenderResult& result = frames.state_->result;
    RenderStats& stats = result.stats;
    stats.seconds_setup =
        seconds_since(start) - stats.seconds_build - stats.seconds_shade - stats.seconds_check;
    return std::move(result);
}

}  // namespace culet
