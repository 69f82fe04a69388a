#pragma once
// How much of a photograph's error is what tilted facets would change.

#include <opencv2/core/mat.hpp>
#include <optional>

#include "compare/calibration/draft_renderer.h"
#include "compare/calibration/simulated_camera.h"
#include "compare/calibration/stone_samples.h"
#include "compare/calibration/tilt_variance.h"
#include "stone/progress/progress.h"

namespace culet {

/// Draws the model with each facet tilted slightly both ways about each of two axes, and fits the
/// photograph's difference from the render with these changes, all facets at once
/// (tilt_variance.h). So all tilts count about equally, whereas scores that add up differences
/// depend on the few facets that change most. Samples with large second differences (non-linear
/// changes) get less weight. Shift, scale, turn, exposure and blur are projected out.
///
/// Pictures here are the root of luminance, clipped at white and blurred by 0.8 % of the stone's
/// diameter, with the stone 192 pixels across.
class FacetTilts {
public:
    /// Arguments as for a calibration. Draws four sketches for each facet (`sketches_for`). Throws
    /// Interrupted.
    FacetTilts(const Scene& model, const DraftRenderer& renderer, const CameraModel& camera,
               int threads, const Progress& progress = {});
    /// Without drawing: `kept` is the `variance()` of an earlier object with the same model and
    /// camera.
    FacetTilts(const Scene& model, const DraftRenderer& renderer, const CameraModel& camera,
               TiltVariance kept);

    static double sketches_for(const Solid& solid) {
        return 4.0 * static_cast<double>(solid.facets.size());
    }

    /// False: not convex, ray-traced, or without visible facets.
    bool usable() const { return variance_.usable(); }

    const TiltVariance& variance() const { return variance_; }

    /// The facet error (facet_error.h) by which the photograph differs from the model, degrees:
    /// about right from 0.05 to 0.5, underestimated above. Other differences count too, so it needs
    /// a calibration like any score. `pair`: photograph and model; only the registration is used of
    /// the latter. `picture`: a finer picture of the model in the renderer's frame; null: the
    /// renderer's own.
    std::optional<double> facet_error_deg(const AlignedPair& pair,
                                          const Photo* picture = nullptr) const;

private:
    /// False when the picture shows nothing.
    bool lay_samples(const Scene& model, const DraftRenderer& renderer);

    /// The picture through a lens, at its full resolution.
    cv::Mat seen_finely(const Photo& picture, double psf_px) const;
    cv::Mat at_samples(const Photo& picture) const;

    StoneSamples samples_;
    cv::Mat mask_;  // CV_8U: the samples used
    CameraModel camera_;
    cv::Mat picture_;  // CV_32F: the model's picture at the samples, as the camera sees it
    TiltVariance variance_;
};

}  // namespace culet
