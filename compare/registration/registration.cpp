#include "compare/registration/registration.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "compare/photo/pixels.h"
#include "compare/photo/resampling.h"
#include "stone/numbers/quantile.h"

namespace culet {

namespace {

// Rounder outlines do not determine the turn: 0.0015 of the diameter is half the figure of a
// 16-gon; below two thirds of a pixel the mask's staircase decides.
constexpr double k_round = 0.0015, k_round_px = 0.67;

// Zero crossings of the signed distance between neighbours, by linear interpolation.
std::vector<cv::Point2d> outline_of(const cv::Mat& distance) {
    std::vector<cv::Point2d> points;
    const auto crossing = [](float a, float b) { return static_cast<double>(a) / (a - b); };
    for (int y = 0; y + 1 < distance.rows; ++y) {
        const float* row = distance.ptr<float>(y);
        const float* below = distance.ptr<float>(y + 1);
        for (int x = 0; x + 1 < distance.cols; ++x) {
            if ((row[x] < 0) != (row[x + 1] < 0)) {
                points.emplace_back(x + crossing(row[x], row[x + 1]), y);
            }
            if ((row[x] < 0) != (below[x] < 0)) {
                points.emplace_back(x, y + crossing(row[x], below[x]));
            }
        }
    }
    return points;
}

struct Sample {
    double value = 0;
    cv::Point2d slope;
};

/// Value and gradient of the bilinear surface; outside the picture the distance to it is added.
Sample sample(const cv::Mat& field, const cv::Point2d& p) {
    Sample result;
    result.value = between_pixels(field, p.x, p.y, &result.slope);
    result.value += std::hypot(p.x - std::clamp(p.x, 0.0, field.cols - 1.001),
                               p.y - std::clamp(p.y, 0.0, field.rows - 1.001));
    return result;
}

// Unknowns a, b, x and y, which are linear in q = (a, -b; b, a) (p - about) + about + (x, y).
using Unknowns = std::array<double, 4>;

Similarity similarity_of(const Unknowns& u, const cv::Point2d& about) {
    return {std::hypot(u[0], u[1]), std::atan2(u[1], u[0]), about, {u[2], u[3]}};
}

class OutlineResidual : public ceres::SizedCostFunction<1, 4> {
public:
    OutlineResidual(const cv::Mat& field, const cv::Point2d& point, const cv::Point2d& about)
        : field_(field), arm_(point - about), about_(about) {}
    bool Evaluate(double const* const* blocks, double* residual, double** slopes) const override {
        const double* u = blocks[0];
        const Sample found = sample(field_, {u[0] * arm_.x - u[1] * arm_.y + about_.x + u[2],
                                             u[1] * arm_.x + u[0] * arm_.y + about_.y + u[3]});
        residual[0] = found.value;
        if (slopes == nullptr || slopes[0] == nullptr) return true;
        slopes[0][0] = found.slope.dot(arm_);
        slopes[0][1] = found.slope.y * arm_.x - found.slope.x * arm_.y;
        slopes[0][2] = found.slope.x;
        slopes[0][3] = found.slope.y;
        return true;
    }

private:
    const cv::Mat& field_;
    cv::Point2d arm_, about_;
};

struct Found {
    Unknowns unknowns{1, 0, 0, 0};
    double rms = 0;
};

double rms_residual(const cv::Mat& field, const std::vector<cv::Point2d>& points,
                    const cv::Point2d& about, const Unknowns& u) {
    const Similarity moved = similarity_of(u, about);
    double sum = 0;
    for (const cv::Point2d& p : points) {
        const double r = sample(field, moved(p)).value;
        sum += r * r;
    }
    return std::sqrt(sum / static_cast<double>(points.size()));
}

// `turn_free` false: the outline does not determine the turn, which is fixed.
Found refined(const cv::Mat& field, const std::vector<cv::Point2d>& points,
              const cv::Point2d& about, Unknowns u, double diameter, bool turn_free) {
    // Huber limit: wide first, so that distant points pull, then a pixel, so that outliers do not.
    for (const double huber : {0.05 * diameter, 1.0}) {
        ceres::Problem problem;
        auto* loss = new ceres::HuberLoss(huber);
        for (const cv::Point2d& p : points)
            problem.AddResidualBlock(new OutlineResidual(field, p, about), loss, u.data());
        if (!turn_free) problem.SetManifold(u.data(), new ceres::SubsetManifold(4, {1}));
        ceres::Solver::Options options;
        options.linear_solver_type = ceres::DENSE_QR;
        options.function_tolerance = 1e-8;
        options.num_threads = 1;
        options.logging_type = ceres::SILENT;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem, &summary);
    }
    return {u, rms_residual(field, points, about, u)};
}

double overlap(const cv::Mat& photo_mask, const cv::Mat& render_mask, const Similarity& s) {
    const cv::Mat inside = resampled_mask(render_mask, matrix_of(s), photo_mask.size());
    const int both = cv::countNonZero(inside & photo_mask);
    const int either = cv::countNonZero(inside | photo_mask);
    return either > 0 ? static_cast<double>(both) / either : 0;
}

/// Direction of the long axis, in (-pi/2, pi/2].
double long_axis(const cv::Mat& mask) {
    const cv::Moments m = cv::moments(mask, true);
    return 0.5 * std::atan2(2 * m.mu11, m.mu20 - m.mu02);
}

double wrapped(double angle) {
    return std::remainder(angle, 2 * std::numbers::pi);
}

Found best_from(const cv::Mat& field, const std::vector<cv::Point2d>& points,
                const Silhouette& photo, const Silhouette& render, const std::vector<double>& turns,
                bool turn_free, double most_turn) {
    Found best;
    best.rms = -1;
    const double scale = render.diameter / photo.diameter;
    const cv::Point2d shift = render.centre - photo.centre;
    for (const double turn : turns) {
        const Found found =
            refined(field, points, photo.centre,
                    {scale * std::cos(turn), scale * std::sin(turn), shift.x, shift.y},
                    render.diameter, turn_free);
        if (std::abs(std::atan2(found.unknowns[1], found.unknowns[0])) > most_turn) continue;
        // A later start must be better by more than the noise between equal fits.
        if (best.rms < 0 || found.rms < 0.98 * best.rms) best = found;
    }
    return best;
}

// Whether the outlines would fit with the render turned by quarters or mirrored.
std::string hint(const Silhouette& photo, const Silhouette& render, double iou) {
    std::string best;
    double best_iou = iou + 0.03;
    for (const bool mirrored : {false, true}) {
        Silhouette other = render;
        if (mirrored) {
            cv::flip(render.mask, other.mask, 1);
            other.centre.x = render.mask.cols - 1 - render.centre.x;
        }
        const cv::Mat field = signed_distance(other.mask);
        const auto points = outline_of(signed_distance(photo.mask));
        const double axes = long_axis(other.mask) - long_axis(photo.mask);
        for (const double turn : {axes, axes + std::numbers::pi}) {
            const Found found = best_from(field, points, photo, other, {wrapped(turn)}, true, 4);
            const Similarity s = similarity_of(found.unknowns, photo.centre);
            const double here = overlap(photo.mask, other.mask, s);
            if (here <= best_iou) continue;
            best_iou = here;
            const double turn_deg = s.turn * 180 / std::numbers::pi;
            best = fmt::format("; {}turned {} by {:.0f} degrees the render would overlap by {:.2f}",
                               mirrored ? "mirrored and " : "",
                               turn_deg > 0 ? "counter-clockwise" : "clockwise", std::abs(turn_deg),
                               here);
        }
    }
    return best;
}

}  // namespace

cv::Point2d Similarity::operator()(const cv::Point2d& p) const {
    const cv::Point2d arm = p - about;
    const double c = scale * std::cos(turn), s = scale * std::sin(turn);
    return {c * arm.x - s * arm.y + about.x + shift.x, s * arm.x + c * arm.y + about.y + shift.y};
}

cv::Matx23d matrix_of(const Similarity& similarity) {
    const double c = similarity.scale * std::cos(similarity.turn);
    const double s = similarity.scale * std::sin(similarity.turn);
    const cv::Point2d origin = similarity({0, 0});
    return {c, -s, origin.x, s, c, origin.y};
}

OutlineMatch match_outlines(const Silhouette& photo, const Silhouette& render,
                            const OutlineLimits& limits) {
    OutlineMatch match;
    if (!photo.found() || !render.found()) {
        match.trouble = photo.found() ? "render: " + render.trouble : "photo: " + photo.trouble;
        return match;
    }
    const cv::Mat field = signed_distance(render.mask);
    const std::vector<cv::Point2d> points = outline_of(signed_distance(photo.mask));
    if (points.size() < 16) {
        match.trouble = "photo: the stone has no outline";
        return match;
    }
    const auto is_round = [](const Silhouette& s) {
        return s.out_of_round < std::max(k_round, k_round_px / s.diameter);
    };
    match.turn_known = !is_round(photo) && !is_round(render);
    std::vector<double> turns{0};
    // The long axis is meaningful for ovals from about 1:1.03 (out_of_round 0.005).
    if (match.turn_known && std::min(photo.out_of_round, render.out_of_round) > 0.005) {
        const double axes = long_axis(render.mask) - long_axis(photo.mask);
        for (const double turn : {wrapped(axes), wrapped(axes + std::numbers::pi)}) {
            if (std::abs(turn) <= limits.most_turn) turns.push_back(turn);
        }
    }
    Found found =
        best_from(field, points, photo, render, turns, match.turn_known, limits.most_turn + 0.05);
    const bool far_turned = found.rms < 0;
    if (far_turned) {
        // Aligned by centre and area only, for the picture that shows why it does not fit.
        const cv::Point2d shift = render.centre - photo.centre;
        found.unknowns = {render.diameter / photo.diameter, 0, shift.x, shift.y};
        found.rms = rms_residual(field, points, photo.centre, found.unknowns);
    }
    match.render_from_photo = similarity_of(found.unknowns, photo.centre);
    std::vector<double> distances;
    for (const cv::Point2d& p : points) {
        distances.push_back(std::abs(sample(field, match.render_from_photo(p)).value) /
                            match.render_from_photo.scale);
    }
    match.residual_px = found.rms / match.render_from_photo.scale;
    match.worst_px = quantile(std::move(distances), 0.95);
    match.iou = overlap(photo.mask, render.mask, match.render_from_photo);
    match.usable =
        match.iou >= limits.least_iou && match.residual_px <= limits.most_residual * photo.diameter;
    if (!match.usable) {
        match.trouble = fmt::format(
            "the outlines do not fit: overlap {:.3f} (at least {:.2f} is "
            "needed), {:.1f} pixels apart (at most {:.1f}){}",
            match.iou, limits.least_iou, match.residual_px, limits.most_residual * photo.diameter,
            hint(photo, render, match.iou));
    }
    return match;
}

}  // namespace culet
