#pragma once
// What the scores of a photograph would be if its stone, light or pose were this or that.

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
    double view_sigma = 0;  ///< as in WorldsAsked
    std::uint64_t seed = 1;
    int threads = 0;       ///< 0: all processors; the result does not depend on it
    double largest = 256;  ///< as for `aligned`
    /// In the frame of the model's picture; over a half is left out. Empty: nothing is.
    std::vector<float> ignored{};
    std::optional<Solid> start{};  ///< the mesh that the fit started from: the catalogue's cut
    /// Of the same model, renderer and camera; null: its score is missing. Not owned.
    const FacetTilts* tilts = nullptr;
};

/// Everything that the calibration of this scene depends on, as a hash: a key for a cache.
std::string calibration_hash(const Scene& model, const CalibrateOptions& options);

/// `model`: the stone in its pose under its lights, its camera at the size at which photographs
/// are compared; `model_picture`: as `renderer` draws it. Each draw is a picture of another world,
/// photographed by the camera, registered by its outline with the model's picture and scored
/// against it, as the photograph was. A stone that is not convex has no draws of facet errors, and
/// a note says so. Throws Interrupted.
Calibration calibrate(const Scene& model, const Photo& model_picture, const DraftRenderer& renderer,
                      const CalibrateOptions& options, const Progress& progress = {});

/// One for each of several cameras, instead of `options.camera`; each world is drawn once for all.
std::vector<Calibration> calibrate(const Scene& model, const Photo& model_picture,
                                   const DraftRenderer& renderer, const CalibrateOptions& options,
                                   const std::vector<CameraModel>& cameras,
                                   const Progress& progress = {});

/// A photograph aligned with the picture and scored: one a row of the table of scores, without
/// nulls; without `tilts` theirs is missing. The picture must be as soft as the photograph
/// (photo_blur.h): against a sharp one the blur alone outweighs facet errors under a tenth of a
/// degree.
std::vector<Score> scores_against(const Photo& photo, const Photo& soft_picture, double largest,
                                  const FacetTilts* tilts);

/// The scores of one photograph against the model's picture, softened by the camera's point spread,
/// as the calibration has them.
std::vector<std::optional<double>> calibration_scores(const Photo& photo, const Photo& soft_picture,
                                                      const CalibrateOptions& options);

}  // namespace culet
