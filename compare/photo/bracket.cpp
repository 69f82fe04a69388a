#include "compare/photo/bracket.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "compare/photo/pixels.h"
#include "compare/photo/response.h"
#include "render/colour/colour.h"
#include "stone/errors.h"
#include "stone/upper_median.h"

namespace culet {

namespace {

constexpr double k_full_well = 20000;  // electrons at saturation, of a small camera
constexpr double k_read_noise = 4;     // electrons
constexpr std::size_t k_shots_for_response = 5;
constexpr double k_least_shift = 0.1;  // pixels; smaller ones are not worth the blur
constexpr double k_fade_from = 0.85, k_fade_to = 0.97;  // of saturation

float brightest(const Photo& photo, std::size_t pixel) {
    return std::max({photo.rgb[3 * pixel], photo.rgb[3 * pixel + 1], photo.rgb[3 * pixel + 2]});
}

// 1 well below the clipping level, 0 at it.
double unclipped(const Photo& photo, std::size_t pixel) {
    if (!photo.saturated.empty() && photo.saturated[pixel] > 0) return 0;
    if (photo.saturation <= 0) return 1;
    const double t =
        (k_fade_to - brightest(photo, pixel) / photo.saturation) / (k_fade_to - k_fade_from);
    const double u = std::clamp(t, 0.0, 1.0);
    return u * u * (3 - 2 * u);
}

// Variance of a value of one shot that was read as about `value`, in units of its saturation.
double variance_of(const Photo& photo, double value, bool eight_bits) {
    const double full = photo.saturation > 0 ? photo.saturation : 1.0;
    const double electrons = std::max(value / full, 0.0) * k_full_well;
    double variance = (electrons + k_read_noise * k_read_noise) / (k_full_well * k_full_well);
    if (eight_bits) {
        // Rounding to a step of the file, evenly distributed: step^2 / 12.
        const double code = srgb_encoded(std::clamp(value / full, 0.0, 1.0));
        const double step = srgb_decoded(std::min(code + 0.5 / 255, 1.0)) -
                            srgb_decoded(std::max(code - 0.5 / 255, 0.0));
        variance += step * step / 12;
    }
    return variance * full * full;
}

cv::Mat log_of(const Photo& photo, double exposure) {
    cv::Mat plane = luminance(colour_of(photo)) / exposure;
    cv::Mat result;
    cv::log(cv::max(plane, 1e-12), result);
    return result;
}

// The part of both shots that is neither clipped nor dark.
cv::Mat well_exposed(const Photo& a, const Photo& b) {
    cv::Mat mask(a.height, a.width, CV_8U, cv::Scalar(0));
    const auto level = [](const Photo& p) { return p.saturation > 0 ? p.saturation : 1e30; };
    const cv::Mat ya = luminance(colour_of(a)), yb = luminance(colour_of(b));
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * mask.cols + x;
            const bool dark = ya.at<float>(y, x) < 0.004 * std::min(level(a), 1.0) ||
                              yb.at<float>(y, x) < 0.004 * std::min(level(b), 1.0);
            if (!dark && unclipped(a, i) > 0.5 && unclipped(b, i) > 0.5)
                mask.at<unsigned char>(y, x) = 255;
        }
    }
    return mask;
}

// Shift of `b` against `a`; ECC (Evangelidis & Psarakis 2008) on log-luminance over what both
// expose well, from coarse to fine.
FrameShift shift_between(const BracketShot& a, const BracketShot& b) {
    const cv::Mat mask = well_exposed(a.photo, b.photo);
    if (cv::countNonZero(mask) < 400) return {};
    const cv::Mat first = log_of(a.photo, a.exposure), second = log_of(b.photo, b.exposure);
    cv::Mat warp = cv::Mat::eye(2, 3, CV_32F);
    for (int factor = 16; factor >= 1; factor /= 2) {
        if (std::min(first.cols, first.rows) / factor < 24) continue;
        cv::Mat small_a, small_b, small_mask;
        cv::resize(first, small_a, {}, 1.0 / factor, 1.0 / factor, cv::INTER_AREA);
        cv::resize(second, small_b, small_a.size(), 0, 0, cv::INTER_AREA);
        cv::resize(mask, small_mask, small_a.size(), 0, 0, cv::INTER_AREA);
        small_mask = small_mask > 200;
        // The filter of ECC reaches over two pixels: clipped ones must not leak in.
        cv::erode(small_mask, small_mask, cv::Mat(), {-1, -1}, 3, cv::BORDER_CONSTANT, {0});
        if (cv::countNonZero(small_mask) < 100) continue;
        cv::Mat tried = warp.clone();
        tried.at<float>(0, 2) /= static_cast<float>(factor);
        tried.at<float>(1, 2) /= static_cast<float>(factor);
        try {
            const double fit = cv::findTransformECC(
                small_a, small_b, tried, cv::MOTION_TRANSLATION,
                cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 1e-5),
                small_mask, 5);
            if (fit < 0.3) continue;
        } catch (const cv::Exception&) {
            continue;  // no structure at this size
        }
        warp.at<float>(0, 2) = tried.at<float>(0, 2) * static_cast<float>(factor);
        warp.at<float>(1, 2) = tried.at<float>(1, 2) * static_cast<float>(factor);
    }
    return {warp.at<float>(0, 2), warp.at<float>(1, 2)};
}

// The shot's content moved back by `shift`; over-exposure spreads with it.
void move_back(Photo& photo, const FrameShift& shift) {
    const cv::Matx23d matrix(1, 0, shift.x, 0, 1, shift.y);
    const auto warp = [&](std::vector<float>& values, int channels, int how) {
        cv::Mat from(photo.height, photo.width, CV_32FC(channels), values.data()), to;
        cv::warpAffine(from, to, matrix, from.size(), how | cv::WARP_INVERSE_MAP,
                       cv::BORDER_REPLICATE);
        const auto* first = to.ptr<float>();
        values.assign(first, first + to.total() * static_cast<std::size_t>(channels));
    };
    // Marked before the pixels are mixed: a mean of a clipped one and its neighbour looks sound.
    if (photo.saturated.empty()) {
        photo.saturated.resize(photo.rgb.size() / 3);
        for (std::size_t i = 0; i < photo.saturated.size(); ++i)
            photo.saturated[i] = unclipped(photo, i) <= 0 ? 1.0f : 0.0f;
    }
    warp(photo.rgb, 3, cv::INTER_LINEAR);
    warp(photo.saturated, 1, cv::INTER_LINEAR);
}

// Measured over stated ratio of exposures: median over what both expose well.
double measured_ratio(const BracketShot& a, const BracketShot& b) {
    const cv::Mat mask = well_exposed(a.photo, b.photo);
    const cv::Mat ya = luminance(colour_of(a.photo)), yb = luminance(colour_of(b.photo));
    std::vector<double> ratios;
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            const float u = ya.at<float>(y, x), v = yb.at<float>(y, x);
            if (mask.at<unsigned char>(y, x) != 0 && v > 0.02 && u > 0.02) ratios.push_back(u / v);
        }
    }
    if (ratios.size() < 100) return 1;
    return upper_median(std::move(ratios)) / (a.exposure / b.exposure);
}

void check_shots(const std::vector<BracketShot>& shots) {
    if (shots.empty()) throw InputError("no photograph was given");
    for (std::size_t i = 0; i < shots.size(); ++i) {
        const BracketShot& shot = shots[i];
        const std::filesystem::path file(shot.name);
        if (shot.photo.not_finite > 0) {
            throw InputError(file, fmt::format("{} samples are no numbers (NaN or infinite): "
                                               "export it again",
                                               shot.photo.not_finite));
        }
        if (shot.photo.width != shots[0].photo.width ||
            shot.photo.height != shots[0].photo.height) {
            throw InputError(file, fmt::format("is {} x {} pixels, {} is {} x {}: the shots of a "
                                               "series are of one size",
                                               shot.photo.width, shot.photo.height, shots[0].name,
                                               shots[0].photo.width, shots[0].photo.height));
        }
        const bool black = std::all_of(shot.photo.rgb.begin(), shot.photo.rgb.end(),
                                       [](float v) { return v <= 0; });
        if (black) throw InputError(file, "is black all over: nothing was exposed");
        for (std::size_t k = 0; k < i; ++k) {
            if (std::abs(std::log2(shot.exposure / shots[k].exposure)) < 0.02) {
                throw InputError(
                    file, fmt::format("has the same exposure as {}: leave one of them out, or say "
                                      "the exposures with --exposure",
                                      shots[k].name));
            }
        }
    }
}

}  // namespace

Bracket merge_bracket(std::vector<BracketShot> shots, const BracketOptions& options,
                      const Progress& progress) {
    check_shots(shots);
    const auto report = [&](double done) {
        if (progress && !progress(done)) throw Interrupted();
    };
    Bracket result;
    const double first_exposure = shots[0].exposure;
    const bool jpegs = std::all_of(shots.begin(), shots.end(), [](const BracketShot& s) {
        return s.photo.encoding == "8-bit sRGB JPEG";
    });
    const bool eight_bits = std::all_of(shots.begin(), shots.end(), [](const BracketShot& s) {
        return s.photo.encoding.starts_with("8-bit");
    });
    result.response = options.response.value_or(
        jpegs && shots.size() >= k_shots_for_response ? Response::calibrated : Response::as_read);
    if (result.response == Response::calibrated) {
        if (!eight_bits || shots.size() < 3) {
            throw InputError(
                "a camera's response is found from at least three (better five) 8-bit "
                "files of different exposure");
        }
    }
    result.shifts.resize(shots.size());
    if (options.align && shots.size() > 1) {
        // From neighbour to neighbour in exposure, which share the most; then added up.
        std::vector<std::size_t> order(shots.size());
        std::iota(order.begin(), order.end(), 0);
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return shots[a].exposure > shots[b].exposure;
        });
        for (std::size_t k = 1; k < order.size(); ++k) {
            report(0.6 * static_cast<double>(k) / static_cast<double>(order.size()));
            const FrameShift step = shift_between(shots[order[k - 1]], shots[order[k]]);
            const FrameShift& before = result.shifts[order[k - 1]];
            result.shifts[order[k]] = {before.x + step.x, before.y + step.y};
        }
        const FrameShift zero = result.shifts[0];
        double most = 0;
        for (std::size_t i = 0; i < shots.size(); ++i) {
            FrameShift& shift = result.shifts[i];
            shift = {shift.x - zero.x, shift.y - zero.y};
            most = std::max(most, std::hypot(shift.x, shift.y));
        }
        if (most > k_least_shift) {
            result.notes.push_back(fmt::format(
                "the camera or the scene moved by up to {:.1f} pixels between shots; put right",
                most));
        }
    }
    if (result.response == Response::calibrated) {
        const ResponseCurve curve = find_response(shots);
        for (BracketShot& shot : shots) apply_response(curve, shot.photo);
        result.curve = curve;
        result.notes.push_back(
            fmt::format("the camera's response was found from the {} shots", shots.size()));
    } else if (jpegs) {
        result.notes.push_back(
            "the camera's tone curve is taken as sRGB: five or more exposures would tell it");
    }
    for (std::size_t i = 0; i < shots.size(); ++i) {
        const FrameShift& shift = result.shifts[i];
        if (std::hypot(shift.x, shift.y) > k_least_shift) move_back(shots[i].photo, shift);
    }
    std::vector<std::size_t> order(shots.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return shots[a].exposure > shots[b].exposure; });
    for (std::size_t k = 1; k < order.size(); ++k) {
        const double ratio = measured_ratio(shots[order[k - 1]], shots[order[k]]);
        result.exposure_ratios.push_back(ratio);
        if (std::abs(std::log2(ratio)) > 0.15) {
            result.notes.push_back(fmt::format(
                "{} to {}: the pictures say {:.2f} times the ratio of exposures that was stated",
                shots[order[k - 1]].name, shots[order[k]].name, ratio));
        }
    }
    report(0.7);

    Photo& merged = result.photo;
    merged.width = shots[0].photo.width;
    merged.height = shots[0].photo.height;
    merged.shot = shots[0].photo.shot;
    const std::size_t pixels = shots[0].photo.rgb.size() / 3;
    merged.rgb.resize(3 * pixels);
    merged.variance.resize(3 * pixels);
    merged.saturated.assign(pixels, 0);
    const std::size_t darkest = order.back();
    std::size_t over = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        double total = 0;
        for (const BracketShot& shot : shots) total += unclipped(shot.photo, i);
        const bool clipped = total <= 1e-6;
        if (clipped) {
            merged.saturated[i] = 1;
            ++over;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            // Light over exposure first, with the weights of pure shot noise; that value then sets
            // every shot's variance, so that noise does not choose its own weight.
            double light = 0, time = 0;
            for (const BracketShot& shot : shots) {
                const double use =
                    clipped ? (&shot == &shots[darkest] ? 1.0 : 0.0) : unclipped(shot.photo, i);
                light += use * shot.photo.rgb[3 * i + c];
                time += use * shot.exposure;
            }
            const double guess = light / time;
            double sum = 0, weight = 0;
            for (const BracketShot& shot : shots) {
                const double use =
                    clipped ? (&shot == &shots[darkest] ? 1.0 : 0.0) : unclipped(shot.photo, i);
                if (use <= 0) continue;
                const double e = shot.exposure;
                const double w = use * e * e / variance_of(shot.photo, guess * e, eight_bits);
                sum += w * shot.photo.rgb[3 * i + c] / e;
                weight += w;
            }
            merged.rgb[3 * i + c] = static_cast<float>(sum / weight * first_exposure);
            merged.variance[3 * i + c] =
                static_cast<float>(first_exposure * first_exposure / weight);
        }
    }
    if (over > 0) {
        result.notes.push_back(fmt::format(
            "{:.2f} % of the pixels are over-exposed even in {}",
            100.0 * static_cast<double>(over) / static_cast<double>(pixels), shots[darkest].name));
    }
    // A tone-mapped single JPEG stays what it is; a response found makes it light.
    merged.photometric = result.response == Response::calibrated ||
                         std::all_of(shots.begin(), shots.end(),
                                     [](const BracketShot& s) { return s.photo.photometric; });
    for (const BracketShot& shot : shots) {
        if (!shot.photo.shot.processed.empty()) merged.photometric = false;
        if (!merged.photometric && merged.not_photometric.empty())
            merged.not_photometric = shot.photo.not_photometric;
    }
    merged.encoding = shots.size() == 1 ? shots[0].photo.encoding
                                        : fmt::format("{} exposures merged", shots.size());
    report(1);
    return result;
}

}  // namespace culet
