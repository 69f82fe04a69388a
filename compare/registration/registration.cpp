#include "compare/registration/registration.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "compare/photo/resampling.h"
#include "stone/quantile.h"

namespace culet {

namespace {

// Outlines this round hold no turn: 0.0015 of the diameter is half the figure of a 16-gon, and
// below two thirds of a pixel the stairs of the mask decide.
constexpr double k_round = 0.0015, k_round_px = 0.67;

// Where the signed distance changes sign between neighbours, by linear interpolation.
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

/// Value and slope of the bilinear surface; outside the picture the distance to it is added.
Sample sample(const cv::Mat& field, const cv::Point2d& p) {
    const double x = std::clamp(p.x, 0.0, field.cols - 1.001);
    const double y = std::clamp(p.y, 0.0, field.rows - 1.001);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const double u = x - x0, v = y - y0;
    const double a = field.at<float>(y0, x0), b = field.at<float>(y0, x0 + 1);
    const double c = field.at<float>(y0 + 1, x0), d = field.at<float>(y0 + 1, x0 + 1);
    Sample result;
    result.value = (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
    result.value += std::hypot(p.x - x, p.y - y);
    result.slope = {(1 - v) * (b - a) + v * (d - c), (1 - u) * (c - a) + u * (d - b)};
    return result;
}

// In the form q = (a, -b; b, a) (p - about) + about + t the unknowns enter linearly.
struct Unknowns {
    double a = 1, b = 0;
    cv::Point2d t;
};

Similarity similarity_of(const Unknowns& u, const cv::Point2d& about) {
    return {std::hypot(u.a, u.b), std::atan2(u.b, u.a), about, u.t};
}

cv::Point2d apply(const Unknowns& u, const cv::Point2d& arm, const cv::Point2d& about) {
    return {u.a * arm.x - u.b * arm.y + about.x + u.t.x,
            u.b * arm.x + u.a * arm.y + about.y + u.t.y};
}

double rms_residual(const cv::Mat& field, const std::vector<cv::Point2d>& points,
                    const cv::Point2d& about, const Unknowns& u) {
    double sum = 0;
    for (const cv::Point2d& p : points) {
        const double r = sample(field, apply(u, p - about, about)).value;
        sum += r * r;
    }
    return std::sqrt(sum / static_cast<double>(points.size()));
}

// One Gauss-Newton step; the turn is held when it is not in the outline.
Unknowns step(const cv::Mat& field, const std::vector<cv::Point2d>& points,
              const cv::Point2d& about, const Unknowns& u, double huber, bool turn_free) {
    cv::Matx44d normal = cv::Matx44d::zeros();
    cv::Vec4d right(0, 0, 0, 0);
    const double arm_scale =
        std::max(1.0, std::hypot(points[0].x - about.x, points[0].y - about.y));
    for (const cv::Point2d& p : points) {
        const cv::Point2d arm = p - about;
        const Sample s = sample(field, apply(u, arm, about));
        const double weight = std::abs(s.value) <= huber ? 1 : huber / std::abs(s.value);
        cv::Vec4d row(s.slope.dot(arm) / arm_scale,
                      (s.slope.y * arm.x - s.slope.x * arm.y) / arm_scale, s.slope.x, s.slope.y);
        if (!turn_free) row[1] = 0;
        normal += weight * (row * row.t());
        right -= weight * s.value * row;
    }
    if (!turn_free) normal(1, 1) = 1;
    cv::Vec4d change;
    if (!cv::solve(normal, right, change, cv::DECOMP_SVD)) return u;
    return {u.a + change[0] / arm_scale,
            u.b + change[1] / arm_scale,
            {u.t.x + change[2], u.t.y + change[3]}};
}

Unknowns refine(const cv::Mat& field, const std::vector<cv::Point2d>& points,
                const cv::Point2d& about, Unknowns u, double diameter, bool turn_free) {
    // Wide at first, then down to a pixel: far points must be able to come in, and then not pull.
    double huber = 0.05 * diameter;
    for (int round = 0; round < 60; ++round) {
        const Unknowns next = step(field, points, about, u, huber, turn_free);
        const double moved = std::hypot(next.a - u.a, next.b - u.b) * diameter / 2 +
                             std::hypot(next.t.x - u.t.x, next.t.y - u.t.y);
        u = next;
        huber = std::max(1.0, 0.7 * huber);
        if (moved < 1e-6 && huber <= 1.0) break;
    }
    return u;
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

struct Found {
    Unknowns unknowns;
    double rms = 0;
};

Found best_from(const cv::Mat& field, const std::vector<cv::Point2d>& points,
                const Silhouette& photo, const Silhouette& render, const std::vector<double>& turns,
                bool turn_free, double most_turn) {
    Found best;
    best.rms = -1;
    const double scale = render.diameter / photo.diameter;
    for (const double turn : turns) {
        Unknowns u{scale * std::cos(turn), scale * std::sin(turn), render.centre - photo.centre};
        u = refine(field, points, photo.centre, u, render.diameter, turn_free);
        if (std::abs(std::atan2(u.b, u.a)) > most_turn) continue;
        const double rms = rms_residual(field, points, photo.centre, u);
        // A later start must be better by more than the noise of a fit that is the same.
        if (best.rms < 0 || rms < 0.98 * best.rms) best = {u, rms};
    }
    return best;
}

// Would the outlines fit if the render were turned by quarters or mirrored?
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
    // The long axis means something from an oval of about 1:1.03 on (out_of_round 0.005).
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
        // Laid over by centre and area only, for the picture that shows why it does not fit.
        found.unknowns = {render.diameter / photo.diameter, 0, render.centre - photo.centre};
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
