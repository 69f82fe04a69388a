#include "compare/meaning/draft_renderer.h"

#include <algorithm>

#include "stone/errors.h"

namespace culet {

Photo photo_of(const Picture& picture) {
    Photo photo;
    photo.width = picture.width;
    photo.height = picture.height;
    photo.rgb = picture.rgb;
    photo.coverage = picture.coverage;
    photo.encoding = "render";
    return photo;
}

DraftRenderer::DraftRenderer(const Scene& model, double tolerance) {
    Scene scene = model;
    scene.settings.tolerance = std::max(scene.settings.tolerance, tolerance);
    scene.settings.samples = 0;
    scene.settings.spectral = false;
    if (scene.settings.engine != "reference") scene.settings.engine = "auto";
    stats_ = render(scene).stats;
    settings_ = stats_.plan ? stats_.plan->settings : scene.settings;
}

Photo DraftRenderer::draw(const Scene& scene, const Progress& progress) const {
    Scene drawn = scene;
    drawn.settings = settings_;
    if (settings_.engine != "beams" && settings_.engine != "preview") {
        return photo_of(render(drawn, progress).picture);
    }
    FrameRenderer renderer(drawn);
    if (progress) renderer.report_to(progress);
    return photo_of(renderer.draw().picture);
}

Photo DraftRenderer::draw_exactly(const Scene& scene, int samples, const Progress& progress) const {
    Scene drawn = scene;
    drawn.settings = settings_;
    drawn.settings.engine = "reference";
    drawn.settings.samples = samples;
    return photo_of(render(drawn, progress).picture);
}

}  // namespace culet
