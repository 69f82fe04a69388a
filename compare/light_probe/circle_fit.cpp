#include "compare/light_probe/circle_fit.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "compare/photo/pixels.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/numbers/upper_median.h"
#include "stone/progress/check_stop.h"

namespace culet {

namespace {

constexpr int k_rays = 360;

struct EdgePoint {
    double x, y, strength;
    int ray;
    double share = 1;  // relative to the strongest edge along its ray
};

// Edges along rays from the middle of `circle`, within `reach` of its radius; at most four per ray.
std::vector<EdgePoint> edges_along_rays(const cv::Mat& plane, const BallCircle& circle,
                                        double reach) {
    std::vector<EdgePoint> points;
    const double step = std::clamp(circle.radius * reach / 40, 0.25, 1.0);
    const double half = std::max(reach * circle.radius, 3.0);
    const int count = 2 * static_cast<int>(std::ceil(half / step)) + 1;
    std::vector<double> profile(count), slope(count);
    const int spread = std::max(1, static_cast<int>(std::lround(1.0 / step)));
    for (int ray = 0; ray < k_rays; ++ray) {
        const double angle = 2 * std::numbers::pi * ray / k_rays, c = std::cos(angle),
                     s = std::sin(angle);
        bool inside = true;
        for (int i = 0; i < count; ++i) {
            const double r = circle.radius + (i - count / 2) * step;
            const double x = circle.x + r * c, y = circle.y + r * s;
            if (x < 1 || y < 1 || x > plane.cols - 3 || y > plane.rows - 3) {
                inside = false;
                break;
            }
            profile[i] = between_pixels(plane, x, y);
        }
        if (!inside) continue;
        double most = 0;
        for (int i = 0; i < count; ++i) {
            // Mean of `spread` samples outside minus that of as many inside.
            double difference = 0;
            for (int k = 1; k <= spread; ++k)
                difference += profile[std::min(i + k, count - 1)] - profile[std::max(i - k, 0)];
            slope[i] = std::abs(difference) / spread;
            most = std::max(most, slope[i]);
        }
        std::vector<EdgePoint> here;
        for (int i = 1; i + 1 < count; ++i) {
            if (slope[i] < 0.25 * most || slope[i] < 0.008) continue;
            if (slope[i] < slope[i - 1] || slope[i] <= slope[i + 1]) continue;
            // The vertex of a parabola through three samples.
            const double curve = slope[i - 1] - 2 * slope[i] + slope[i + 1];
            const double shift =
                curve < 0 ? std::clamp(0.5 * (slope[i - 1] - slope[i + 1]) / curve, -0.5, 0.5) : 0;
            const double r = circle.radius + (i - count / 2 + shift) * step;
            here.push_back({circle.x + r * c, circle.y + r * s, slope[i], ray});
        }
        std::sort(here.begin(), here.end(),
                  [](const EdgePoint& a, const EdgePoint& b) { return a.strength > b.strength; });
        if (here.size() > 4) here.resize(4);
        for (EdgePoint& p : here) p.share = p.strength / here.front().strength;
        points.insert(points.end(), here.begin(), here.end());
    }
    return points;
}

std::optional<BallCircle> through(const EdgePoint& a, const EdgePoint& b, const EdgePoint& c) {
    const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y;
    const double d = 2 * (bx * cy - by * cx);
    if (std::abs(d) < 1e-9) return std::nullopt;
    const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    const double x = (cy * b2 - by * c2) / d, y = (bx * c2 - cx * b2) / d;
    return BallCircle{a.x + x, a.y + y, std::hypot(x, y)};
}

double off(const BallCircle& circle, const EdgePoint& p) {
    return std::hypot(p.x - circle.x, p.y - circle.y) - circle.radius;
}

// Mean over all rays of the edge within `tolerance` of the circle, relative to the ray's strongest
// one. Noise seldom is the strongest there.
double support_of(const std::vector<EdgePoint>& points, const BallCircle& circle,
                  double tolerance) {
    std::array<double, k_rays> met{};
    for (const EdgePoint& p : points) {
        double& most = met[static_cast<std::size_t>(p.ray)];
        if (std::abs(off(circle, p)) < tolerance) most = std::max(most, p.share);
    }
    double sum = 0;
    for (const double share : met) sum += share;
    return sum / k_rays;
}

// Geometric distance, Tukey's weights at 4.685 times the spread (at least 0.1 pixels).
std::optional<FoundBall> polished(const std::vector<EdgePoint>& points, BallCircle circle,
                                  double tolerance) {
    FoundBall found;
    for (int iteration = 0; iteration < 30; ++iteration) {
        std::vector<double> sizes;
        for (const EdgePoint& p : points) {
            const double r = std::abs(off(circle, p));
            if (r < tolerance) sizes.push_back(r);
        }
        if (sizes.size() < 12) return std::nullopt;
        const double spread = std::max(1.4826 * upper_median(std::move(sizes)), 0.1);
        const double cut = std::min(4.685 * spread, tolerance);
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
        Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
        for (const EdgePoint& p : points) {
            const double r = off(circle, p);
            if (std::abs(r) >= cut) continue;
            const double t = 1 - (r / cut) * (r / cut), w = t * t;
            const double length = r + circle.radius;
            const Eigen::Vector3d row((circle.x - p.x) / length, (circle.y - p.y) / length, -1);
            normal += w * row * row.transpose();
            gradient += w * r * row;
        }
        const Eigen::Vector3d step = -PivotedCholesky(normal).solve_one(gradient);
        if (!step.allFinite()) return std::nullopt;
        circle.x += step[0];
        circle.y += step[1];
        circle.radius += step[2];
        if (!(circle.radius > 1)) return std::nullopt;
        const Eigen::Matrix3d covariance = inverse3(normal) * spread * spread;
        // Neighbouring rays see the same clutter: one in four counts as independent.
        found.sigma_px = 2 * std::sqrt(std::max(covariance.diagonal().maxCoeff(), 0.0));
        if (step.norm() < 1e-5) break;
    }
    found.circle = circle;
    return found;
}

std::optional<FoundBall> fitted(const cv::Mat& plane, const BallCircle& rough, double reach) {
    const std::vector<EdgePoint> points = edges_along_rays(plane, rough, reach);
    if (points.size() < 30) return std::nullopt;
    std::mt19937 random(7);
    const double tolerance = std::max(0.006 * rough.radius, 1.0);
    BallCircle best = rough;
    double best_support = support_of(points, rough, tolerance);
    for (int attempt = 0; attempt < 400; ++attempt) {
        const auto pick = [&] { return points[random() % points.size()]; };
        const EdgePoint a = pick(), b = pick(), c = pick();
        const int apart =
            std::min({std::abs(a.ray - b.ray), std::abs(b.ray - c.ray), std::abs(a.ray - c.ray)});
        if (apart < k_rays / 8) continue;
        const auto circle = through(a, b, c);
        if (!circle || std::abs(circle->radius - rough.radius) > 1.5 * reach * rough.radius ||
            std::hypot(circle->x - rough.x, circle->y - rough.y) > 1.5 * reach * rough.radius)
            continue;
        const double support = support_of(points, *circle, tolerance);
        if (support > best_support) {
            best_support = support;
            best = *circle;
        }
    }
    auto found = polished(points, best, 2 * tolerance);
    if (found) found->support = support_of(points, found->circle, tolerance);
    return found;
}

// Points half way between the light inside and outside, along rays near the outline, in linear
// light, of which edge pixels are means. Rays without a clear step give none.
std::vector<EdgePoint> half_way_points(const cv::Mat& linear, const BallCircle& circle) {
    constexpr double k_step = 0.25, k_reach = 3, k_near = 1.25;
    constexpr int k_half = static_cast<int>(k_reach / k_step);
    std::vector<EdgePoint> points;
    for (int ray = 0; ray < 2 * k_rays; ++ray) {
        const double angle = std::numbers::pi * ray / k_rays, c = std::cos(angle),
                     s = std::sin(angle);
        std::array<double, 2 * k_half + 1> light{};
        bool whole = true;
        for (int i = -k_half; i <= k_half && whole; ++i) {
            const double r = circle.radius + i * k_step;
            const double x = circle.x + r * c, y = circle.y + r * s;
            whole = x >= 1 && y >= 1 && x <= linear.cols - 3 && y <= linear.rows - 3;
            if (whole) light[static_cast<std::size_t>(i + k_half)] = between_pixels(linear, x, y);
        }
        if (!whole) continue;
        // Extrapolate both sides linearly to the edge, because light changes fast at the compressed
        // rim.
        const auto level_at_edge = [&](int side) {
            double n = 0, st = 0, sv = 0, stt = 0, stv = 0;
            for (int i = -k_half; i <= k_half; ++i) {
                const double t = side * i * k_step, v = light[static_cast<std::size_t>(i + k_half)];
                if (t <= k_near) continue;
                ++n;
                st += t;
                sv += v;
                stt += t * t;
                stv += t * v;
            }
            const double slope = (n * stv - st * sv) / (n * stt - st * st);
            return (sv - slope * st) / n;
        };
        const double inside = level_at_edge(-1), outside = level_at_edge(1);
        const double step = outside - inside, middle = (inside + outside) / 2;
        if (std::abs(step) < 0.2 * std::max(inside, outside)) continue;
        int crossings = 0;
        double at = 0;
        for (std::size_t i = 0; i + 1 < light.size(); ++i) {
            const double a = light[i] - middle, b = light[i + 1] - middle;
            if ((a < 0) == (b < 0)) continue;
            ++crossings;
            at = (static_cast<double>(i) + a / (a - b) - k_half) * k_step;
        }
        if (crossings != 1 || std::abs(at) > k_near) continue;
        const double r = circle.radius + at;
        points.push_back({circle.x + r * c, circle.y + r * s, std::abs(step), ray / 2});
    }
    return points;
}

}  // namespace

FoundBall to_a_fraction_of_a_pixel(const cv::Mat& linear, FoundBall ball) {
    for (int round = 0; round < 2; ++round) {
        const std::vector<EdgePoint> points = half_way_points(linear, ball.circle);
        if (points.size() < k_rays / 4) return ball;
        const auto next = polished(points, ball.circle, 1.0);
        if (!next) return ball;
        ball.circle = next->circle;
        ball.sigma_px = next->sigma_px;
    }
    return ball;
}

std::optional<FoundBall> fitted_in_steps(const cv::Mat& plane, const BallCircle& rough,
                                         double reach) {
    check_stop();
    auto found = fitted(plane, rough, reach);
    for (const double narrower : {reach / 3, reach / 8}) {
        check_stop();
        if (!found) return found;
        const auto next = fitted(plane, found->circle, narrower);
        if (!next) break;
        found = next;
    }
    return found;
}

}  // namespace culet
