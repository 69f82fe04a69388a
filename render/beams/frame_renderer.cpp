#include "render/beams/frame_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "render/beams/beam_renderer.h"
#include "render/beams/sampled_check.h"
#include "render/reference/prepared_scene.h"
#include "render/setup/a_priori.h"
#include "render/setup/scene_checks.h"
#include "stone/design/design.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// It takes 4e5 beams cut for their share of the picture to lose as much light as those cut for
// their weight.
constexpr double k_cut_share = 1 / 4e5;
// Beams that follow their middle ray alone, in square pixels over the tolerance. They bring a pixel
// about ten times that much light, and err to either side equally often.
constexpr double k_middle_ray_area = 10;
// Border error in pixels over the tolerance: a border off by a pixel brings its contrast to that
// pixel. Bounded to a range where accuracy is cheap (docs/engines.md, "Beams"). Verified rays may
// have larger errors.
constexpr double k_map_error = 10, k_least_map_error = 0.02, k_least_verified = 0.1,
                 k_most_map_error = 0.25;
// Previews have one colour per beam, an error far larger than that of these borders and of weaker
// beams.
constexpr double k_preview_map_error = 1;        // pixels
constexpr double k_preview_middle_ray_area = 4;  // square pixels
// Distance of a crystal's two images up to which they are merged: the error is a tenth of a pixel
// at edges.
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
    settings.limits.middle_ray_area = std::min(k_middle_ray_area * scene.settings.tolerance, 0.5);
    settings.limits.refraction = scene.settings.refraction;
    settings.threads = scene.settings.threads;
    settings.shading = scene.settings.engine == k_preview_engine ? BeamShading::flat
                       : scene.settings.samples == 1 && scene.camera.aperture_radius == 0
                           ? BeamShading::single
                           : BeamShading::averaged;
    settings.limits.map_error =
        std::clamp(k_map_error * scene.settings.tolerance,
                   settings.shading == BeamShading::single ? k_least_verified : k_least_map_error,
                   k_most_map_error);
    // Errors of the borders average out over many views.
    if (scene.camera.aperture_radius > 0) settings.limits.map_error = k_most_map_error;
    if (settings.shading == BeamShading::flat) {
        settings.limits.map_error = k_preview_map_error;
        settings.limits.middle_ray_area = k_preview_middle_ray_area;
    }
    return settings;
}

// Largest distance of a crystal's two images over the wavelengths, in pixels.
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

// Whether a crystal's two waves are merged or split, and why.
struct CrystalChoice {
    CrystalBeams beams = CrystalBeams::merged;
    std::string why;
};

CrystalChoice choose_crystal(const Scene& scene, const OpticalSetup& setup) {
    CrystalChoice choice;
    if (!setup.splits) return choice;
    if (scene.settings.crystal_beams) {
        choice.beams = *scene.settings.crystal_beams;
        choice.why = "as the scene says";
    } else if (setup.on(Effects::coherence)) {
        choice.why = "the two waves interfere";
    } else {
        const double apart = images_apart(scene, setup);
        choice.beams = apart > k_seen_apart ? CrystalBeams::split : CrystalBeams::merged;
        choice.why = fmt::format("their images lie {:.2g} pixels apart", apart);
    }
    choice.why = fmt::format("; beams of the two waves {}: {}",
                             choice.beams == CrystalBeams::merged ? "merged" : "split", choice.why);
    return choice;
}

}  // namespace

struct FrameRenderer::State {
    explicit State(const Scene& whole)
        : scene(whole),
          body(scene.stone.solid, scene.stone.convex),
          notes(notes_on_drawing(scene)),
          prepared(scene),
          renderer(scene.stone.solid) {
        require_beams(scene, prepared.setup);
    }

    Scene scene;
    StoneBody body;
    std::vector<std::string> notes;
    PreparedScene prepared;
    BeamRenderer renderer;
    RenderResult result;
    std::optional<double> checked_bound;  // of an earlier frame with this light and these settings
    double limit_ms = 0, cut = 0;         // cut: a beam's share, for the time limit
    Progress progress;

    void show(Scene changed);
    void draw(bool check);
};

// Changes nothing if beams cannot draw the scene.
void FrameRenderer::State::show(Scene changed) {
    PreparedScene anew(changed);
    require_beams(changed, anew.setup);
    prepared = std::move(anew);
    checked_bound.reset();
    scene = std::move(changed);
}

void FrameRenderer::State::draw(bool with_check) {
    BeamSettings settings = beam_settings(scene, prepared.limits);
    settings.limits.cut_share = std::max(settings.limits.cut_share, cut);
    const CrystalChoice crystal = choose_crystal(scene, prepared.setup);
    settings.crystal = crystal.beams;
    const double started = processor_seconds();
    renderer.draw(scene, prepared.setup, prepared.colours, settings, result.picture, progress);
    const double took_ms = 1e3 * (processor_seconds() - started);
    const BeamReport& report = renderer.report();
    RenderStats& stats = result.stats;
    stats = {};
    stats.engine = scene.settings.engine;
    stats.depth = report.deepest;
    stats.effects.assign(prepared.setup.effects.begin(), prepared.setup.effects.end());
    stats.effects[static_cast<std::size_t>(Effects::birefringence)].why += crystal.why;
    stats.wavelengths_nm = prepared.setup.wavelengths_nm;
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
    if (with_check) {
        const auto start = Clock::now();
        const SampledCheck found = check_against_reference(
            scene, prepared, result.picture, report.filled, stats.mean_radiance, progress);
        stats.checked_pixels = found.pixels;
        stats.engine_error = stats.error_bound = found.error;
        if (stats.mean_radiance > 0)
            stats.error_bound +=
                stats.remainder * prepared.surroundings->max_radiance() / stats.mean_radiance;
        stats.seconds_check = seconds_since(start);
        checked_bound = stats.error_bound;
    } else if (checked_bound) {
        stats.error_bound = *checked_bound;
        stats.notes.emplace_back("the error bound is that of an earlier view");
    }
    if (limit_ms > 0) {
        // The number of beams falls roughly as the root of the cut.
        const double ratio = took_ms / limit_ms;
        const double least = 1e-9;
        if (ratio > 1 || cut > 0) cut = std::max(cut, least) * ratio * ratio;
        if (cut < least) cut = 0;
    }
}

FrameRenderer::FrameRenderer(const Scene& scene) {
    require_renderable(scene);
    state_ = std::make_unique<State>(scene);
}
FrameRenderer::~FrameRenderer() = default;
FrameRenderer::FrameRenderer(FrameRenderer&&) noexcept = default;

void FrameRenderer::look_from(const Camera& camera) {
    require_outside(state_->body, camera);
    Scene& scene = state_->scene;
    const Camera before = std::exchange(scene.camera, camera);
    try {
        OpticalSetup anew = make_optical_setup(scene, state_->prepared.colours.size());
        require_beams(scene, anew);
        state_->prepared.look(scene, std::move(anew));
    } catch (...) {
        scene.camera = before;
        throw;
    }
}

void FrameRenderer::look_from(const Camera& camera, const Lights& lights) {
    State& state = *state_;
    require_outside(state.body, camera);
    Scene changed = state.scene;
    changed.camera = camera;
    changed.lights = lights;
    OpticalSetup anew = make_optical_setup(changed, state.prepared.colours.size());
    require_beams(changed, anew);
    if (anew.wavelengths_nm != state.prepared.setup.wavelengths_nm) return show(changed);
    state.scene = std::move(changed);
    state.prepared.surroundings = surroundings_of(state.scene, state.prepared.colours);
    state.prepared.look(state.scene, std::move(anew));
    state.checked_bound.reset();
}

void FrameRenderer::light_with(const Lights& lights) {
    Scene changed = state_->scene;
    changed.lights = lights;
    state_->show(std::move(changed));
}

void FrameRenderer::show(const Scene& scene) {
    require_outside(state_->body, scene.camera);
    Scene changed = state_->scene;
    changed.camera = scene.camera;
    changed.lights = scene.lights;
    changed.settings = scene.settings;
    state_->show(std::move(changed));
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
    if (scene.has_objects()) return "beams draw one stone alone, without objects around it";
    if (!scene.stone.convex) return "beams are for convex stones only";
    if (const std::string frosted = frosted_tiers(scene.stone.solid); !frosted.empty())
        return fmt::format("beams draw polished facets, and some are frosted (tiers {})", frosted);
    for (const Band& band : setup.bands) {
        if (!(band.n > band.n_outside)) {
            return fmt::format(
                "beams need a stone denser than what surrounds it, found {:.4g} in {:.4g}", band.n,
                band.n_outside);
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

std::string refused_by_beams(const Scene& scene) {
    return refused_by_beams(scene, make_optical_setup(scene));
}

bool drawn_by_beams(const RenderSettings& settings) {
    return settings.engine == k_beam_engine || settings.engine == k_preview_engine;
}

}  // namespace culet
