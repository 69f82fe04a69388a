#include "compare/calibration/calibrate.h"

#include <fmt/format.h>

#include <algorithm>

#include "compare/calibration/alternatives.h"
#include "compare/calibration/photo_blur.h"
#include "compare/photo/in_batches.h"
#include "compare/scores/chance.h"
#include "compare/scores/scored_pair.h"

namespace culet {

namespace {

class Draws {
public:
    Draws(const Alternatives& alternatives, const Photo& model_picture,
          const DraftRenderer& renderer, const CalibrateOptions& options,
          const std::vector<CameraModel>& cameras)
        : alternatives_(alternatives),
          model_picture_(model_picture),
          renderer_(renderer),
          options_(options),
          cameras_(cameras) {
        for (const CameraModel& camera : cameras)
            soft_pictures_.push_back(softened(model_picture, camera.psf_px));
    }

    /// One for each camera.
    std::vector<CalibrationDraw> draw(const AlternativeDraw& job) const;

private:
    CalibrationDraw photograph(const AlternativeDraw& job, const Photo& stone,
                               std::size_t camera) const;

    const Alternatives& alternatives_;
    const Photo& model_picture_;
    std::vector<Photo> soft_pictures_;  // as each camera's lens shows it
    const DraftRenderer& renderer_;
    const CalibrateOptions& options_;
    const std::vector<CameraModel>& cameras_;
};

CalibrationDraw Draws::photograph(const AlternativeDraw& job, const Photo& stone,
                                  std::size_t which) const {
    CalibrationDraw result{job.alternative, job.name, job.facet_error_deg, {}};
    CameraModel camera = cameras_[which];
    if (job.alternative == Alternative::light || job.alternative == Alternative::both ||
        job.alternative == Alternative::pose) {
        // A photographer would meter again under another light.
        const double exposure = exposure_like(stone, model_picture_);
        for (double& gain : camera.gain) gain *= exposure;
    }
    const Photo& soft_picture = soft_pictures_[which];
    const auto seed = seed_of(job.seed, 11, static_cast<std::uint64_t>(1e4 * job.facet_error_deg));
    const auto taken = [&] {
        Photo photo = photographed(stone, camera, seed);
        photo.ignored = options_.ignored;
        return calibration_scores(photo, soft_picture, options_);
    };
    result.scores = taken();
    const bool none = std::none_of(result.scores.begin(), result.scores.end(),
                                   [](const auto& s) { return s.has_value(); });
    if (none && camera.outline_from_background) {
        // The stone is too dark at its border for that: use the coverage instead.
        camera.outline_from_background = false;
        result.scores = taken();
    }
    return result;
}

std::vector<CalibrationDraw> Draws::draw(const AlternativeDraw& job) const {
    const Photo stone = renderer_.draw(alternatives_.scene_of(job));
    std::vector<CalibrationDraw> result;
    for (std::size_t k = 0; k < cameras_.size(); ++k) result.push_back(photograph(job, stone, k));
    return result;
}

}  // namespace

std::vector<Score> scores_against(const Photo& photo, const Photo& soft_picture, double largest,
                                  const FacetTilts* tilts) {
    const AlignedPair pair = aligned(photo, soft_picture, largest);
    if (!pair.enough()) return {};
    CalibratedScoring calibrated;
    if (tilts != nullptr) calibrated.facet_error_deg = tilts->facet_error_deg(pair);
    return scores_of(MeasuredPair(pair, &calibrated).measures);
}

std::vector<std::optional<double>> calibration_scores(const Photo& photo, const Photo& soft_picture,
                                                      const CalibrateOptions& options) {
    std::vector<std::optional<double>> values;
    for (const Score& score : scores_against(photo, soft_picture, options.largest, options.tilts)) {
        values.push_back(score.value);
    }
    if (values.empty()) values.resize(score_kinds().size());
    return values;
}

std::vector<Calibration> calibrate(const Scene& model, const Photo& model_picture,
                                   const DraftRenderer& renderer, const CalibrateOptions& options,
                                   const std::vector<CameraModel>& cameras,
                                   const Progress& progress) {
    Calibration common;
    common.seed = options.seed;
    for (const ScoreKind& kind : score_kinds()) common.keys.push_back(kind.key);
    const Alternatives alternatives(
        model, {options.draws, options.null_draws, options.seed, options.start, options.view_sigma},
        common.notes);
    const Draws draws(alternatives, model_picture, renderer, options, cameras);
    const std::vector<AlternativeDraw>& jobs = alternatives.draws();
    std::vector<std::vector<CalibrationDraw>> made(jobs.size());
    in_batches(jobs.size(), options.threads, progress,
               [&](std::size_t i) { made[i] = draws.draw(jobs[i]); });
    std::vector<Calibration> result(cameras.size(), common);
    for (std::size_t k = 0; k < cameras.size(); ++k) {
        CalibrateOptions own = options;
        own.camera = cameras[k];
        result[k].hash = calibration_hash(model, own);
        for (auto& of_alternative : made) result[k].draws.push_back(std::move(of_alternative[k]));
    }
    return result;
}

Calibration calibrate(const Scene& model, const Photo& model_picture, const DraftRenderer& renderer,
                      const CalibrateOptions& options, const Progress& progress) {
    return std::move(
        calibrate(model, model_picture, renderer, options, {options.camera}, progress).front());
}

}  // namespace culet
