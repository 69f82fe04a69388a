#pragma once
// Draws many pictures of slightly different scenes, quickly and with the same settings.

#include <memory>
#include <optional>

#include "compare/photo/rendered_photo.h"
#include "render/work/work_meter.h"

namespace culet {

/// Plans the settings once, for the first scene. Later pictures use them without checks against the
/// reference.
class DraftRenderer {
public:
    /// `allowed_ns`: counted work (render/work/price.h) for the first picture, which is as fine as
    /// that allows; 0: no limit. Throws InputError as `render` does.
    DraftRenderer(const Scene& model, double tolerance, double allowed_ns = 0);
    /// A coarser renderer for pictures that are compared only with each other: omits paths that
    /// carry less than `cut_weight` and draws beam borders coarsely. Ray-traced pictures stay as
    /// they are.
    DraftRenderer coarser(const Scene& model, double cut_weight) const;

    /// With coverage; deterministic. Throws InputError for a stone that cannot be drawn.
    Photo draw(const Scene& scene, const Progress& progress = {}) const;
    /// A picture at one wavelength with only the stronger paths, to see how the picture changes;
    /// for a crystal in a thirtieth of the time. Nothing for a ray-traced scene, because noise
    /// would dominate differences.
    std::optional<Photo> sketch(const Scene& scene) const;
    /// An independent picture by the reference renderer, `samples` rays a pixel.
    Photo draw_exactly(const Scene& scene, int samples, const Progress& progress = {}) const;

    /// The first scene's picture.
    const Photo& picture() const { return picture_; }
    const RenderSettings& settings() const { return settings_; }
    const RenderStats& stats() const { return stats_; }
    /// Counted work of all pictures; for ray-traced ones estimated from the first.
    double worked_ns() const;

private:
    DraftRenderer() = default;
    void settle(const Scene& scene);
    RenderSettings settings_;
    RenderStats stats_;
    Photo picture_;
    std::shared_ptr<WorkMeter> meter_ = std::make_shared<WorkMeter>();
};

/// Reduces the environment map to at most 256 directions round: averaging it for beams takes as
/// long as a picture, and is repeated for every turned light.
Scene with_coarse_environment(const Scene& scene);

}  // namespace culet
