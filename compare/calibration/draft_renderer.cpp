#include "compare/calibration/draft_renderer.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "render/beams/frame_renderer.h"
#include "render/work/price.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr int k_few_rays = 4;
constexpr double k_sketched_nm = 550, k_sketched_weight = 0.03;
constexpr int k_checked_pixels = 200, k_checked_samples = 8;
constexpr double k_coarse_tolerance = 0.03;
// Faces that a ray of the reference meets in a stone: 10 to 45 (bench_plan --prices).
constexpr double k_events = 30;
constexpr int k_coarse_environment = 256;

}  // namespace

DraftRenderer::DraftRenderer(const Scene& model, double tolerance, double allowed_ns) {
    Scene scene = model;
    scene.settings.allowed_ns = allowed_ns;
    scene.settings.tolerance = std::max(scene.settings.tolerance, tolerance);
    scene.settings.samples = 0;
    scene.settings.spectral = false;
    scene.settings.checked_pixels = k_checked_pixels;
    scene.settings.checked_samples = k_checked_samples;
    // Prefer beams: their error is the same in all pictures, and a hundred by the reference would
    // take an hour.
    if (model.settings.engine != k_reference_engine) {
        scene.settings.engine = k_beam_engine;
        try {
            settle(scene);
            return;
        } catch (const InputError&) {
            // The reference draws it instead; if it cannot either, its message is better.
        }
    }
    scene.settings.engine = k_reference_engine;
    scene.settings.samples = k_few_rays;
    settle(scene);
}

void DraftRenderer::settle(const Scene& scene) {
    RenderResult result = render(scene);
    stats_ = std::move(result.stats);
    settings_ = stats_.plan ? stats_.plan->settings : scene.settings;
    settings_.allowed_ns = 0;
    settings_.meter = nullptr;
    picture_ = photo_of(result.picture);
}

DraftRenderer DraftRenderer::coarser(const Scene& model, double cut_weight) const {
    DraftRenderer result;
    result.settings_ = settings_;
    result.stats_ = stats_;
    if (drawn_by_beams(settings_)) {
        RenderSettings& settings = result.settings_;
        settings.tolerance = std::max(settings.tolerance, k_coarse_tolerance);
        settings.cut_weight = std::max(cut_weight, settings.cut_weight.value_or(0));
    }
    result.picture_ = result.draw(model);
    return result;
}

Photo DraftRenderer::draw(const Scene& scene, const Progress& progress) const {
    Scene drawn = scene;
    drawn.settings = settings_;
    if (!drawn_by_beams(settings_)) {
        RenderResult result = render(drawn, progress);
        meter_->spend(price_ns(PathWork{.rays = static_cast<double>(result.stats.rays),
                                        .events = k_events * static_cast<double>(result.stats.rays),
                                        .general = true}));
        return photo_of(result.picture);
    }
    drawn.settings.meter = meter_;
    FrameRenderer renderer(drawn);
    if (progress) renderer.report_to(progress);
    return photo_of(renderer.draw().picture);
}

std::optional<Photo> DraftRenderer::sketch(const Scene& scene) const {
    if (!drawn_by_beams(settings_)) return std::nullopt;
    Scene drawn = scene;
    drawn.settings = settings_;
    drawn.settings.meter = meter_;
    drawn.settings.wavelengths_nm = {k_sketched_nm};
    drawn.settings.cut_weight = std::max(k_sketched_weight, settings_.cut_weight.value_or(0));
    return photo_of(FrameRenderer(drawn).draw().picture);
}

Photo DraftRenderer::draw_exactly(const Scene& scene, int samples, const Progress& progress) const {
    Scene drawn = scene;
    drawn.settings = settings_;
    drawn.settings.engine = k_reference_engine;
    drawn.settings.samples = samples;
    return photo_of(render(drawn, progress).picture);
}

double DraftRenderer::worked_ns() const {
    return static_cast<double>(meter_->spent());
}

Scene with_coarse_environment(const Scene& scene) {
    Scene result = scene;
    const auto& map = scene.lights.environment;
    if (!map || map->width <= k_coarse_environment) return result;
    EnvironmentMap coarse{k_coarse_environment, k_coarse_environment / 2, {}};
    coarse.rgb.resize(static_cast<std::size_t>(3 * coarse.width * coarse.height));
    const cv::Mat fine(map->height, map->width, CV_32FC3, const_cast<float*>(map->rgb.data()));
    cv::Mat small(coarse.height, coarse.width, CV_32FC3, coarse.rgb.data());
    cv::resize(fine, small, small.size(), 0, 0, cv::INTER_AREA);
    result.lights.environment = std::make_shared<const EnvironmentMap>(std::move(coarse));
    return result;
}

}  // namespace culet
