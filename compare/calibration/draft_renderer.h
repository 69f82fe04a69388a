#pragma once
// Many pictures of scenes that differ a little from one, quickly and all in one manner.

#include <memory>
#include <optional>

#include "compare/photo/rendered_photo.h"
#include "render/work/work_meter.h"

namespace culet {

/// What the first scene calls for is planned once; the others are drawn with the same settings and
/// are not held against the reference one by one.
class DraftRenderer {
public:
    /// `allowed_ns`: of counted work (render/work/price.h) for the first picture, which is then as
    /// fine as that allows; 0: as long as it takes. Throws InputError as `render` does.
    DraftRenderer(const Scene& model, double tolerance, double allowed_ns = 0);
    /// For pictures of the same scene that need only be alike among themselves: paths that carry
    /// less than `cut_weight` are left out, and borders of beams are coarser. What is drawn by rays
    /// stays as it is.
    DraftRenderer coarser(const Scene& model, double cut_weight) const;

    /// With coverage. Same scene, same bytes. Throws InputError for a stone that cannot be drawn.
    Photo draw(const Scene& scene, const Progress& progress = {}) const;
    /// At one wavelength and with only the paths of some weight: for how a picture changes, not for
    /// the picture. A crystal's takes a thirtieth of the time. Nothing when the scene is drawn by
    /// rays, whose noise would be all that there is between two pictures.
    std::optional<Photo> sketch(const Scene& scene) const;
    /// By the reference renderer with `samples` rays a pixel: an independent picture of the same.
    Photo draw_exactly(const Scene& scene, int samples, const Progress& progress = {}) const;

    /// Of the first scene.
    const Photo& picture() const { return picture_; }
    const RenderSettings& settings() const { return settings_; }
    const RenderStats& stats() const { return stats_; }
    /// Work of all pictures so far, counted; of rays, by what the first picture's took.
    double worked_ns() const;

private:
    DraftRenderer() = default;
    void settle(const Scene& scene);
    RenderSettings settings_;
    RenderStats stats_;
    Photo picture_;
    std::shared_ptr<WorkMeter> meter_ = std::make_shared<WorkMeter>();
};

/// The scene with its environment map no finer than 256 directions round: averaging it for beams
/// takes as long as a picture, and every turned light has to be averaged anew.
Scene with_coarse_environment(const Scene& scene);

}  // namespace culet
