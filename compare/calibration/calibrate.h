#pragma once
// Which scores a photograph would have if its stone, light or pose were another.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "compare/calibration/calibration.h"
#include "compare/calibration/draft_renderer.h"
#include "compare/calibration/facet_tilts.h"
#include "compare/calibration/simulated_camera.h"
#include "compare/registration/frame.h"
#include "compare/scores/score.h"
#include "render/scene/scene.h"
#include "stone/progress/progress.h"

namespace culet {

struct CalibrateOptions {
    CameraModel camera;     ///< of the photograph
    int draws = 8;          ///< at each facet error
    int null_draws = 24;    ///< of each null
    double view_sigma = 0;  ///< as in AlternativeOptions
    std::uint64_t seed = 1;
    int threads = 0;       ///< 0: all processors; the result does not depend on it
    double largest = 256;  ///< as for `aligned`
    /// In the model picture's frame: over 0.5 is left out. Empty: nothing.
    std::vector<float> ignored{};
    std::optional<Solid> start{};  ///< where the fit started: the catalogue's cut
    /// For the same model, renderer and camera; null: no such score. Not owned.
    const FacetTilts* tilts = nullptr;
};

/// Hash of everything that the calibration depends on: the key of a cache.
std::string calibration_hash(const Scene& model, const CalibrateOptions& options);

/// Simulates photographs of the alternatives, registers each with the model's picture by its
/// outline, and scores it as the photograph was.
///
/// `model`: in its pose under its lights, with a camera of the compared size. `model_picture`: the
/// model as `renderer` draws it. A stone that is not convex has no draws of facet errors, which a
/// note says. Throws Interrupted.
Calibration calibrate(const Scene& model, const Photo& model_picture, const DraftRenderer& renderer,
                      const CalibrateOptions& options, const Progress& progress = {});

/// One for each of several cameras (not `options.camera`); each alternative is drawn once.
std::vector<Calibration> calibrate(const Scene& model, const Photo& model_picture,
                                   const DraftRenderer& renderer, const CalibrateOptions& options,
                                   const std::vector<CameraModel>& cameras,
                                   const Progress& progress = {});

/// Aligns a photograph with the picture and scores it: the table's scores without nulls. Without
/// `tilts` their score is missing. The picture must be as soft as the photograph (photo_blur.h),
/// otherwise blur outweighs facet errors under 0.1 degrees.
std::vector<Score> scores_against(const Photo& photo, const Photo& soft_picture, double largest,
                                  const FacetTilts* tilts);

/// One photograph's scores in the calibration's order. `soft_picture`: the model's, softened by the
/// camera's point spread.
std::vector<std::optional<double>> calibration_scores(const Photo& photo, const Photo& soft_picture,
                                                      const CalibrateOptions& options);

}  // namespace culet
