#include "compare/compare.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/flip.h"
#include "compare/frame.h"
#include "page/html.h"
#include "compare/metrics.h"
#include "compare/pixels.h"
#include "compare/reflexes.h"
#include "compare/turned_null.h"
#include "compare/wavelet_similarity.h"
#include "stone/errors.h"
#include "stone/units.h"

namespace culet {

namespace {

// Fewer pixels than this hold no pattern: a stone of 32 pixels has some 700.
constexpr int k_least_pixels = 400;
// A sample within 1 % of the clipping level counts as clipped: JPEGs round there.
constexpr double k_clipped = 0.99;

PixelMap map_of(const cv::Mat& values, const cv::Mat& mask) {
    PixelMap map{mask.cols, mask.rows, {}};
    map.values.reserve(mask.total());
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            const bool inside = mask.at<unsigned char>(y, x) != 0;
            map.values.push_back(inside ? (values.empty() ? 1.0f : values.at<float>(y, x))
                                        : std::numeric_limits<float>::quiet_NaN());
        }
    }
    return map;
}

Photo photo_of(const cv::Mat& colour) {
    Photo photo;
    photo.width = colour.cols;
    photo.height = colour.rows;
    for (int y = 0; y < colour.rows; ++y) {
        const float* row = colour.ptr<float>(y);
        photo.rgb.insert(photo.rgb.end(), row, row + 3 * colour.cols);
    }
    return photo;
}

cv::Mat eroded(const cv::Mat& mask, double by_px) {
    cv::Mat distance;
    cv::distanceTransform(mask, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
    return distance > by_px;
}

cv::Mat brightest_channel(const cv::Mat& colour) {
    cv::Mat channels[3];
    cv::split(colour, channels);
    return cv::max(cv::max(channels[0], channels[1]), channels[2]);
}

/// 255 where neither picture is clipped.
cv::Mat not_clipped(const cv::Mat& colour, double saturation, const cv::Mat& mask) {
    if (saturation <= 0) return mask.clone();
    const cv::Mat below = brightest_channel(colour) < k_clipped * saturation;
    return below & mask;
}

void multiply_channels(cv::Mat& colour, const std::array<double, 3>& gain) {
    cv::multiply(colour, cv::Scalar(gain[0], gain[1], gain[2]), colour);
}

Registration registration_of(const Frame& frame) {
    Registration r;
    r.residual_px = frame.match.residual_px;
    r.worst_px = frame.match.worst_px;
    r.iou = frame.match.iou;
    r.scale = frame.render_from_photo.scale;
    r.turn_deg = degrees(frame.render_from_photo.turn);
    r.turn_known = frame.match.turn_known;
    r.shift_px = {frame.render_from_photo.shift.x, frame.render_from_photo.shift.y};
    r.centre_px = {frame.render_from_photo.about.x, frame.render_from_photo.about.y};
    r.photo_diameter_px = frame.photo_diameter_px;
    r.render_diameter_px = frame.render_diameter_px;
    r.photo_outline = frame.photo.silhouette.source;
    r.render_outline = frame.render_outline;
    if (!frame.photo.silhouette.warning.empty()) {
        r.warnings.push_back("photo: " + frame.photo.silhouette.warning);
    }
    if (!frame.render_warning.empty()) r.warnings.push_back("render: " + frame.render_warning);
    if (!r.turn_known) {
        r.warnings.push_back(
            "the outline is round: a turn of the stone in the picture's plane is "
            "not seen in it, and was taken as 0");
    }
    if (frame.match.usable && r.iou < 0.99) {
        r.warnings.push_back(
            fmt::format("the outlines overlap by {:.3f} only: below 0.99 mend the "
                        "pose before you read the scores",
                        r.iou));
    }
    return r;
}

struct Measured {
    std::vector<Score> scores;
    std::optional<ReflexMatch> reflexes;
    cv::Mat ssim_map, colour_map, flip_map;
};

Score score(std::string key, std::optional<double> value, bool higher_is_better = true,
            std::string note = {}) {
    Score s;
    s.key = std::move(key);
    s.value = value;
    s.higher_is_better = higher_is_better;
    if (!value) s.note = std::move(note);
    return s;
}

// The order here is the order in the table of the report.
Measured measure(const MatchedPictures& pictures, const WaveletBank& wavelets) {
    const std::string flat = "one of the pictures has one brightness everywhere";
    Measured result;
    auto& scores = result.scores;
    scores.push_back(score("zncc", zncc(pictures, 0.02), true, flat));
    scores.push_back(score("zncc_1pct", zncc(pictures, 0.01), true, flat));
    scores.push_back(score("zncc_4pct", zncc(pictures, 0.04), true, flat));
    result.reflexes = match_reflexes(pictures);
    const std::string none = "the photo has no reflex that stands out";
    const auto& reflexes = result.reflexes;
    scores.push_back(
        score("reflex_f1", reflexes ? std::optional(reflexes->f1) : std::nullopt, true, none));
    scores.push_back(score("reflex_area_f1",
                           reflexes ? std::optional(reflexes->area_f1) : std::nullopt, true, none));
    const ShownPictures pair = shown(pictures);
    scores.push_back(score("cw_ssim", cw_ssim(pair, pictures.mask, wavelets)));
    const ScoreMap structure = ssim(pair, pictures.mask);
    scores.push_back(score("ssim", structure.mean));
    scores.push_back(score("psnr", psnr(pair, pictures.mask), true,
                           "the pictures are equal: there is no noise to measure"));
    const ColourScore colour = deltaE00(pictures);
    scores.push_back(score("deltaE00_mean", colour.mean, false));
    scores.push_back(score("deltaE00_p95", colour.percentile_95, false));
    for (Score& s : scores) s.is_correlation = s.key.starts_with("zncc");
    const ScoreMap visible = flip(pictures);
    scores.push_back(score("flip_mean", visible.mean, false));
    result.flip_map = visible.map;
    result.ssim_map = structure.map;
    result.colour_map = colour.map;
    return result;
}

void fill_null(Score& score) {
    if (score.null.empty()) return;
    const auto n = static_cast<double>(score.null.size());
    double sum = 0, squares = 0;
    for (const double v : score.null) sum += v;
    score.null_mean = sum / n;
    for (const double v : score.null) squares += (v - score.null_mean) * (v - score.null_mean);
    score.null_sd = n > 1 ? std::sqrt(squares / (n - 1)) : 0;
    if (!score.value) return;
    const double sign = score.higher_is_better ? 1 : -1;
    if (score.is_correlation) {
        // Fisher (1915): atanh of a correlation has a spread that does not depend on its value, so
        // that a perfect match is not held back by the end of the scale.
        Score stretched = score;
        stretched.is_correlation = false;
        stretched.value = std::atanh(std::clamp(*score.value, -0.9999, 0.9999));
        for (double& v : stretched.null) v = std::atanh(std::clamp(v, -0.9999, 0.9999));
        fill_null(stretched);
        score.z = stretched.z;
    } else if (score.null_sd > 0) {
        score.z = sign * (*score.value - score.null_mean) / score.null_sd;
    }
    double as_good = 0;
    for (const double v : score.null) as_good += sign * v >= sign * *score.value ? 1 : 0;
    score.p = (as_good + 1) / (n + 1);
}

// One row of scores a draw; the gain is solved anew, as it was for the render itself.
void add_null(const MatchedPictures& pictures, const WaveletBank& wavelets, const cv::Mat& usable,
              const cv::Mat& outline, const CompareOptions& options, const Progress& progress,
              Comparison& result) {
    const std::vector<TurnedDraw> draws =
        draw_turns(pictures, outline, std::max(20, options.null_draws), options.seed);
    std::vector<std::vector<std::optional<double>>> rows(draws.size());
    const auto measure_draw = [&](std::size_t k) {
        MatchedPictures other = turned(pictures, draws[k]);
        const cv::Mat other_usable = other.mask & usable;
        multiply_channels(other.render, solve_gain(other.photo, other.render, other_usable));
        for (const Score& s : measure(other, wavelets).scores) rows[k].push_back(s.value);
    };
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    // Some at a time, so that progress is told from this thread.
    const std::size_t batch = 8;
    for (std::size_t first = 0; first < draws.size(); first += batch) {
        const std::size_t last = std::min(draws.size(), first + batch);
        arena.execute([&] { tbb::parallel_for(first, last, measure_draw); });
        const double done = static_cast<double>(last) / static_cast<double>(draws.size());
        if (progress && !progress(0.2 + 0.8 * done)) throw Interrupted();
    }
    for (std::size_t s = 0; s < result.scores.size(); ++s) {
        for (const auto& row : rows) {
            if (row[s]) result.scores[s].null.push_back(*row[s]);
        }
        fill_null(result.scores[s]);
    }
    result.null_draws = static_cast<int>(draws.size());
    result.null_note =
        "the same render turned by a random angle in the picture's plane, every second draw "
        "mirrored, gain solved anew; draws under which the render stays much the same are left out";
}

void judge(Comparison& result) {
    const Score& zncc = result.scores.front();
    if (!zncc.value) {
        result.verdict = Verdict::no_evidence;
        result.reason = "there is no pattern to compare: " + zncc.note;
        return;
    }
    if (result.null_draws < 20 || !zncc.z) {
        result.verdict = Verdict::no_evidence;
        result.reason =
            "the render is much the same however it is turned, so that this test "
            "cannot tell a match from chance";
        return;
    }
    const double z = *zncc.z;
    const std::string figures =
        fmt::format("correlation {}, chance level {} ± {}", decimals(*zncc.value, 2),
                    decimals(zncc.null_mean, 2), decimals(zncc.null_sd, 2));
    if (z >= k_match_z && *zncc.value >= k_match_zncc) {
        result.verdict = Verdict::match;
        result.reason = fmt::format(
            "bright and dark places agree far better than those of the same "
            "render turned ({})",
            figures);
    } else if (z >= k_partial_z && *zncc.p <= 1 / (result.null_draws + 0.99)) {
        result.verdict = Verdict::partial;
        result.reason = fmt::format(
            "bright and dark places agree better than those of the same "
            "render turned, but not by much ({})",
            figures);
    } else {
        result.verdict = Verdict::no_evidence;
        result.reason = fmt::format(
            "bright and dark places agree no better than those of the same "
            "render turned ({})",
            figures);
    }
}

}  // namespace

const char* name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::match:
            return "match";
        case Verdict::partial:
            return "partial";
        case Verdict::no_evidence:
            return "no_evidence";
        case Verdict::refused:
            return "refused";
    }
    return "refused";
}

Comparison compare(const Photo& photo, const Photo& render, const CompareOptions& options,
                   const Progress& progress) {
    Comparison result;
    result.simulated = options.simulated;
    result.seed = options.seed;
    for (const std::string& note : photo.notes) result.notes.push_back("photo: " + note);
    for (const std::string& note : render.notes) result.notes.push_back("render: " + note);

    const Frame frame = align(photo, options.mask, render);
    if (progress && !progress(0.1)) throw Interrupted();
    result.registration = registration_of(frame);
    if (!frame.photo.colour.empty()) {
        result.pictures.photo = photo_of(frame.photo.colour);
        result.pictures.photo_outline = map_of({}, frame.photo.silhouette.mask);
        const cv::Mat everywhere(frame.photo.colour.size(), CV_8U, cv::Scalar(255));
        result.pictures.white =
            photo.saturation > 0 ? photo.saturation
                                 : std::max(1e-30, quantile(brightest_channel(frame.photo.colour),
                                                            everywhere, 0.995));
    }
    if (!frame.render.empty()) {
        result.pictures.render = photo_of(frame.render);
        result.pictures.render_outline = map_of({}, frame.render_mask);
    }
    if (!frame.match.usable) {
        result.reason = frame.match.trouble;
        return result;
    }

    MatchedPictures pictures;
    pictures.photo = frame.photo.colour;
    pictures.render = frame.render;
    pictures.diameter = frame.photo.silhouette.diameter;
    // Two pixels, or half a per cent of a large stone: there the outlines' error lives.
    pictures.mask = eroded(frame.photo.silhouette.mask & frame.render_mask,
                           std::max(2.0, 0.005 * pictures.diameter));
    result.compared_pixels = cv::countNonZero(pictures.mask);
    if (result.compared_pixels < k_least_pixels) {
        result.reason = fmt::format(
            "only {} pixels of the stone can be compared: at least {} are "
            "needed",
            result.compared_pixels, k_least_pixels);
        return result;
    }
    pictures.white =
        photo.saturation > 0
            ? photo.saturation
            : std::max(1e-30, quantile(brightest_channel(pictures.photo), pictures.mask, 0.995));
    const cv::Mat photo_usable = not_clipped(pictures.photo, photo.saturation, pictures.mask);
    const cv::Mat usable = not_clipped(pictures.render, render.saturation, photo_usable);
    result.saturated =
        1 - static_cast<double>(cv::countNonZero(photo_usable)) / result.compared_pixels;
    result.gain = solve_gain(pictures.photo, pictures.render, usable);
    multiply_channels(pictures.render, result.gain);

    const WaveletBank wavelets = wavelet_bank(pictures.mask.size(), pictures.diameter);
    const Measured measured = measure(pictures, wavelets);
    result.scores = measured.scores;
    if (measured.reflexes) {
        result.reflexes = {measured.reflexes->in_photo, measured.reflexes->in_render,
                           measured.reflexes->matched, measured.reflexes->displacement};
    }
    if (progress && !progress(0.2)) throw Interrupted();
    add_null(pictures, wavelets, usable, frame.render_mask, options, progress, result);
    judge(result);

    const ShownPictures pair = shown(pictures);
    result.pictures.white = pictures.white;
    result.pictures.render = photo_of(pictures.render);
    result.pictures.mask = map_of({}, pictures.mask);
    result.pictures.luminance_difference =
        map_of(pair.render_luma - pair.photo_luma, pictures.mask);
    result.pictures.colour_difference = map_of(measured.colour_map, pictures.mask);
    result.pictures.visible_difference = map_of(measured.flip_map, pictures.mask);
    result.pictures.similarity = map_of(measured.ssim_map, pictures.mask);
    return result;
}

}  // namespace culet
