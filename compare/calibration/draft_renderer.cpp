#include "compare/calibration/draft_renderer.h"

#include <algorithm>

#include "render/beams/frame_renderer.h"
#include "stone/errors.h"

namespace culet {

namespace {

constexpr int k_few_rays = 4;
constexpr double k_sketched_nm = 550, k_sketched_weight = 0.03;
constexpr int k_checked_pixels = 200, k_checked_samples = 8;

}  // namespace

DraftRenderer::DraftRenderer(const Scene& model, double tolerance) {
    Scene scene = model;
    scene.settings.tolerance = std::max(scene.settings.tolerance, tolerance);
    scene.settings.samples = 0;
    scene.settings.spectral = false;
    scene.settings.checked_pixels = k_checked_pixels;
    scene.settings.checked_samples = k_checked_samples;
    // Beams wherever they can draw the scene at all: what they are off by is the same in all the
    // pictures, and a hundred of them by the reference would take an hour.
    if (model.settings.engine != k_reference_engine) {
        scene.settings.engine = k_beam_engine;
        try {
            settle(scene);
            return;
        } catch (const InputError&) {
            // Drawn by the reference, which says better what is wrong if it cannot draw it either.
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
    picture_ = photo_of(result.picture);
}

Photo DraftRenderer::draw(const Scene& scene, const Progress& progress) const {
    Scene drawn = scene;
    drawn.settings = settings_;
    if (!drawn_by_beams(settings_)) {
        return photo_of(render(drawn, progress).picture);
    }
    FrameRenderer renderer(drawn);
    if (progress) renderer.report_to(progress);
    return photo_of(renderer.draw().picture);
}

std::optional<Photo> DraftRenderer::sketch(const Scene& scene) const {
    if (!drawn_by_beams(settings_)) return std::nullopt;
    Scene drawn = scene;
    drawn.settings = settings_;
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

}  // namespace culet
