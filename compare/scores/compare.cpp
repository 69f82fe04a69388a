#include "compare/scores/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/in_batches.h"
#include "compare/photo/pixels.h"
#include "compare/scores/aligned_pair.h"
#include "compare/scores/colour_distribution.h"
#include "compare/scores/rotation_null.h"
#include "compare/scores/rotation_verdict.h"
#include "compare/scores/score_list.h"
#include "compare/scores/scored_pair.h"
#include "stone/numbers/units.h"
#include "stone/progress/part_of_progress.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

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

// Inserts a part's values into the frame.
PixelMap map_of(const cv::Mat& values, const cv::Rect& part, const cv::Mat& mask) {
    cv::Mat whole = cv::Mat::zeros(mask.size(), CV_32F);
    values.copyTo(whole(part));
    return map_of(whole, mask);
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
        r.warnings.push_back(fmt::format(
            "the outlines overlap by {:.3f} only: below 0.99, correct the pose before using scores",
            r.iou));
    }
    return r;
}

// `corner`: of the frame's part in which the reflexes were matched.
ReflexCount counted(const ReflexMatch& match, const cv::Point& corner) {
    ReflexCount count{match.in_photo,
                      match.in_render,
                      match.matched,
                      match.displacement,
                      match.coloured,
                      match.same_hue,
                      {}};
    const auto add = [&](const std::vector<MatchedReflex>& reflexes, bool of_photo) {
        for (const MatchedReflex& reflex : reflexes) {
            count.marks.push_back({{reflex.middle.x + corner.x, reflex.middle.y + corner.y},
                                   std::sqrt(reflex.area / std::numbers::pi),
                                   of_photo,
                                   reflex.partner});
        }
    };
    add(match.photo, true);
    add(match.render, false);
    return count;
}

// Adds one row of scores for each draw. The gain is solved anew, as it was for the render itself.
void add_null(const MeasuredPair& close, const cv::Mat& usable, const cv::Mat& outline,
              const CompareOptions& options, const Progress& progress, Comparison& result) {
    const std::vector<Rotation> draws =
        draw_rotations(close.pictures, outline, std::max(20, options.null_draws), options.seed);
    std::vector<std::vector<std::optional<double>>> rows(draws.size());
    const auto measure_draw = [&](std::size_t k) {
        MatchedPictures other = rotated(close.pictures, draws[k]);
        const cv::Mat other_usable = other.mask & usable;
        multiply_channels(other.render, solve_gain(other.photo, other.render, other_usable));
        Measures measures = measures_of(other, close.wavelets);
        measures.calibrating = close.measures.calibrating;
        for (const Score& s : scores_of(measures)) rows[k].push_back(s.value);
    };
    in_batches(draws.size(), options.threads, part_of(progress, 0.2, 1), measure_draw);
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

void show_frame(const Frame& frame, double saturation, Comparison& result) {
    result.registration = registration_of(frame);
    if (!frame.photo.colour.empty()) {
        result.pictures.photo = photo_of(frame.photo.colour);
        result.pictures.photo_outline = map_of({}, frame.photo.silhouette.mask);
        result.pictures.white = white_level(frame.photo.colour, {}, saturation);
    }
    if (!frame.render.empty()) {
        result.pictures.render = photo_of(frame.render);
        result.pictures.render_outline = map_of({}, frame.render_mask);
    }
}

void show_maps(const MeasuredPair& close, const MatchedPictures& pictures,
               ComparedPictures& shown) {
    shown.white = pictures.white;
    shown.render = photo_of(pictures.render);
    shown.mask = map_of({}, pictures.mask);
    shown.luminance_difference =
        map_of(close.measures.shown.render_luma - close.measures.shown.photo_luma, close.part,
               pictures.mask);
    shown.colour_difference = map_of(close.measures.colour.map, close.part, pictures.mask);
    shown.visible_difference = map_of(close.measures.visible.map, close.part, pictures.mask);
    shown.similarity = map_of(close.measures.structure.map, close.part, pictures.mask);
}

}  // namespace

std::string sentence_of(const ReflexCount& reflexes) {
    if (reflexes.in_photo == 0) return "the photograph has no bright reflex";
    std::string text = fmt::format("{} of {} reflexes found", reflexes.matched, reflexes.in_photo);
    if (reflexes.displacement) {
        text += fmt::format(", {:.1f} % of the diameter apart", 100 * *reflexes.displacement);
    }
    if (reflexes.coloured > 0) {
        text += fmt::format("; {} of {} coloured ones of one hue", reflexes.same_hue,
                            reflexes.coloured);
    }
    return text;
}

MeasuredPair::MeasuredPair(const AlignedPair& pair, const CalibratedScoring* calibrated)
    : part(part_to_score(pair.pictures)),
      pictures(part_of(pair.pictures, part)),
      wavelets(wavelet_bank(pictures.mask.size(), pictures.diameter)),
      measures(measures_of(pictures, wavelets)) {
    if (calibrated == nullptr) return;
    measures.calibrating = true;
    measures.facet_error_deg = calibrated->facet_error_deg;
}

Comparison scored(const AlignedPair& pair, const Photo& photo, const Photo& render,
                  const CompareOptions& options, const Progress& progress,
                  const CalibratedScoring* calibrated) {
    Comparison result;
    result.simulated = options.simulated;
    result.seed = options.seed;
    for (const std::string& note : photo.notes) result.notes.push_back("photo: " + note);
    for (const std::string& note : render.notes) result.notes.push_back("render: " + note);

    const Frame& frame = pair.frame;
    show_frame(frame, photo.saturation, result);
    if (!frame.match.usable) {
        result.reason = frame.match.trouble;
        return result;
    }
    const MatchedPictures& pictures = pair.pictures;
    result.compared_pixels = pair.compared_pixels;
    if (!pair.enough()) {
        result.reason = fmt::format(
            "only {} pixels of the stone can be compared: at least {} are "
            "needed",
            result.compared_pixels, AlignedPair::k_least_pixels);
        return result;
    }
    result.saturated = pair.saturated;
    result.gain = pair.gain;

    const MeasuredPair close(pair, calibrated);
    const cv::Rect& part = close.part;
    const Measures& measures = close.measures;
    if (calibrated != nullptr) result.render_blur_px = calibrated->render_blur_px;
    result.scores = scores_of(measures);
    if (measures.reflexes) result.reflexes = counted(*measures.reflexes, part.tl());
    if (!photo.photometric) {
        result.geometry_only = true;
        keep_geometry_only(result.scores, "the photograph cannot serve for photometry");
        result.notes.push_back(fmt::format(
            "the photograph cannot serve for photometry ({}): only scores of geometry "
            "are given",
            photo.not_photometric.empty() ? "its values are not light" : photo.not_photometric));
    }
    result.photo_light = measures.colours.photo_light;
    result.render_light = measures.colours.render_light;
    if (progress && !progress(0.2)) throw Interrupted();
    add_null(close, pair.usable(part).clone(), frame.render_mask(part).clone(), options, progress,
             result);
    judge_by_rotations(result);
    show_maps(close, pictures, result.pictures);
    return result;
}

}  // namespace culet
