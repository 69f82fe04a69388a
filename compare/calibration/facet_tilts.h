#pragma once
// The facets' tilts, read from the picture itself: how much of what a photograph is off by is what
// tilted facets change.

#include <opencv2/core/mat.hpp>
#include <optional>

#include "compare/calibration/draft_renderer.h"
#include "compare/calibration/simulated_camera.h"
#include "compare/calibration/stone_samples.h"
#include "compare/calibration/tilt_variance.h"
#include "stone/progress/progress.h"

namespace culet {

/// The model's picture is drawn with each facet tilted a little either way about each of two axes.
/// The differences are what a photograph's difference from the model's render is held against
/// (tilt_variance.h), all facets at once, so that how large their tilts are is known about as well
/// as so many tilts can tell: a score that adds up differences hangs on the few facets that change
/// most. Samples count by how straight the changes are there: where the tilts' second differences
/// are large, tilts of other sizes change something else. Shift, scale, turn, exposure and blur are
/// projected out.
///
/// All of it is in the root of luminance, clipped at white, blurred by 0.8 % of the stone's
/// diameter, on a picture of the stone 192 pixels across in the model's frame.
class FacetTilts {
public:
    /// `model`, `renderer` and its picture, `camera`: as for a calibration. Draws four sketches a
    /// facet (`sketches_for`). Throws Interrupted.
    FacetTilts(const Scene& model, const DraftRenderer& renderer, const CameraModel& camera,
               int threads, const Progress& progress = {});
    /// The same without its sketches, which `kept` stands for: the `variance()` of one of the same
    /// model and camera.
    FacetTilts(const Scene& model, const DraftRenderer& renderer, const CameraModel& camera,
               TiltVariance kept);

    /// How many it draws.
    static double sketches_for(const Solid& solid) {
        return 4.0 * static_cast<double>(solid.facets.size());
    }

    /// False: the stone is not convex, is drawn by rays, or shows nothing of its facets.
    bool usable() const { return variance_.usable(); }

    const TiltVariance& variance() const { return variance_; }

    /// Degrees: the facet error (facet_error.h) by which the photograph differs from the model. It
    /// is about right from 0.05 to 0.5 degrees; larger ones are read too small, and what else there
    /// is in the picture counts as facet error, so that it needs a calibration like any score.
    /// `pair`: the photograph and the model's picture; of that only the place is used. `picture`: a
    /// finer one of the model in the renderer's place; null: the renderer's own.
    std::optional<double> facet_error_deg(const AlignedPair& pair,
                                          const Photo* picture = nullptr) const;

private:
    /// The model's picture on its samples; false when there is nothing to be told.
    bool lay_samples(const Scene& model, const DraftRenderer& renderer);

    /// A picture through a lens, as fine as it is drawn.
    cv::Mat seen_finely(const Photo& picture, double psf_px) const;
    cv::Mat at_samples(const Photo& picture) const;

    StoneSamples samples_;
    cv::Mat mask_;  // CV_8U: those that are used
    CameraModel camera_;
    cv::Mat picture_;  // CV_32F: the model's picture at the samples' places, as the camera sees it
    TiltVariance variance_;
};

}  // namespace culet
