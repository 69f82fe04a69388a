#pragma once
// Many pictures of scenes that differ a little from one, quickly and all in one manner.

#include <optional>

#include "compare/photo/rendered_photo.h"

namespace culet {

/// What the first scene calls for is planned once; the others are drawn with the same settings and
/// are not held against the reference one by one.
class DraftRenderer {
public:
    /// Throws InputError as `render` does.
    DraftRenderer(const Scene& model, double tolerance);

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

private:
    void settle(const Scene& scene);
    RenderSettings settings_;
    RenderStats stats_;
    Photo picture_;
};

}  // namespace culet
