#include "compare/scores/compare.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"
#include "compare/scores/aligned_pair.h"
#include "compare/scores/colour_distribution.h"
#include "compare/scores/rotation_null.h"
#include "compare/scores/score_list.h"
#include "page/html.h"
#include "stone/errors.h"
#include "stone/units.h"

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

// Values of a part of the frame, in the frame.
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
        r.warnings.push_back(
            fmt::format("the outlines overlap by {:.3f} only: below 0.99 mend the "
                        "pose before you read the scores",
                        r.iou));
    }
    return r;
}

// `corner`: of the part of the frame in which the reflexes were matched.
ReflexCount counted(const ReflexMatch& match, const cv::Point& corner) {
    ReflexCount count{match.in_photo,
                      match.in_render,
                      match.matched,
                      match.displacement,
                      match.coloured,
                      match.same_hue,
                      {}};
    const auto add = [&](const std::vector<Reflex>& reflexes, bool of_photo) {
        for (const Reflex& reflex : reflexes) {
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

// Bright and dark places, or, where the photograph's brightness is not to be trusted, the facets'
// images.
const Score& deciding(const Comparison& result) {
    const char* key = result.geometry_only ? "cw_ssim" : "zncc";
    return *std::find_if(result.scores.begin(), result.scores.end(),
                         [&](const Score& s) { return s.key == key; });
}

void judge(Comparison& result) {
    const Score& zncc = deciding(result);
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
    const double enough = result.geometry_only ? k_match_cw_ssim : k_match_zncc;
    const std::string what =
        result.geometry_only ? "the facets' images agree" : "bright and dark places agree";
    const double z = *zncc.z;
    const std::string figures = fmt::format(
        "{} {}, chance level {} ± {}", result.geometry_only ? "CW-SSIM" : "correlation",
        decimals(*zncc.value, 2), decimals(zncc.null_mean, 2), decimals(zncc.null_sd, 2));
    if (z >= k_match_z && *zncc.value >= enough) {
        result.verdict = Verdict::match;
        result.reason = fmt::format(
            "{} far better than those of the same "
            "render turned ({})",
            what, figures);
    } else if (z >= k_partial_z && *zncc.p <= 1 / (result.null_draws + 0.99)) {
        result.verdict = Verdict::partial;
        result.reason = fmt::format(
            "{} better than those of the same "
            "render turned, but not by much ({})",
            what, figures);
    } else {
        result.verdict = Verdict::no_evidence;
        result.reason = fmt::format(
            "{} no better than those of the same "
            "render turned ({})",
            what, figures);
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

    const Frame frame = align(photo, options.mask, render,
                              {.largest = options.largest, .ignored = options.ignored});
    if (progress && !progress(0.1)) throw Interrupted();
    result.registration = registration_of(frame);
    if (!frame.photo.colour.empty()) {
        result.pictures.photo = photo_of(frame.photo.colour);
        result.pictures.photo_outline = map_of({}, frame.photo.silhouette.mask);
        const cv::Mat everywhere(frame.photo.colour.size(), CV_8U, cv::Scalar(255));
        result.pictures.white = white_level(frame.photo.colour, everywhere, photo.saturation);
    }
    if (!frame.render.empty()) {
        result.pictures.render = photo_of(frame.render);
        result.pictures.render_outline = map_of({}, frame.render_mask);
    }
    if (!frame.match.usable) {
        result.reason = frame.match.trouble;
        return result;
    }

    const LaidPictures laid = lay_pictures(frame, photo.saturation, render.saturation);
    const MatchedPictures& pictures = laid.pictures;
    result.compared_pixels = laid.compared_pixels;
    if (!laid.enough()) {
        result.reason = fmt::format(
            "only {} pixels of the stone can be compared: at least {} are "
            "needed",
            result.compared_pixels, LaidPictures::k_least_pixels);
        return result;
    }
    result.saturated = laid.saturated;
    result.gain = laid.gain;

    const cv::Rect part = part_to_score(pictures);
    const MatchedPictures close = part_of(pictures, part);
    const WaveletBank wavelets = wavelet_bank(close.mask.size(), close.diameter);
    const Measured measured = measure(close, wavelets);
    result.scores = measured.scores;
    if (measured.reflexes) {
        result.reflexes = counted(*measured.reflexes, part.tl());
    }
    if (!photo.photometric) {
        result.geometry_only = true;
        keep_geometry_only(result.scores, "the photograph cannot serve for photometry");
        result.notes.push_back(fmt::format(
            "the photograph cannot serve for photometry ({}): only scores of geometry "
            "are given",
            photo.not_photometric.empty() ? "its values are not light" : photo.not_photometric));
    }
    const ColourDistributions colours = colour_distributions(close);
    result.photo_light = colours.photo_light;
    result.render_light = colours.render_light;
    if (progress && !progress(0.2)) throw Interrupted();
    add_null(close, wavelets, laid.usable(part).clone(), frame.render_mask(part).clone(), options,
             progress, result);
    judge(result);

    const ShownPictures pair = shown(pictures);
    result.pictures.white = pictures.white;
    result.pictures.render = photo_of(pictures.render);
    result.pictures.mask = map_of({}, pictures.mask);
    result.pictures.luminance_difference =
        map_of(pair.render_luma - pair.photo_luma, pictures.mask);
    result.pictures.colour_difference = map_of(measured.colour_map, part, pictures.mask);
    result.pictures.visible_difference = map_of(measured.flip_map, part, pictures.mask);
    result.pictures.similarity = map_of(measured.ssim_map, part, pictures.mask);
    return result;
}

}  // namespace culet
