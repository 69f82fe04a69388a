#include "compare/light_probe/ball_finder.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "compare/light_probe/rim_compression.h"
#include "compare/photo/pixels.h"
#include "stone/upper_median.h"

namespace culet {

namespace {

constexpr int k_hough_side = 640;  // pixels of the longer side that Hough's transform sees
constexpr int k_rays = 360;
constexpr double k_size_step = 1.6;
constexpr std::size_t k_circles_of_a_size = 6;
constexpr double k_one_ball = 0.25;  // of the radius: circles so near are about one ball

struct EdgePoint {
    double x, y, strength;
    int ray;
    double share = 1;  // of the strongest edge along its ray
};

// Luminance as an eye sees steps in it: cube root above the dark, 0..1 at the 99.5 % quantile.
cv::Mat seen_luminance(const Photo& photo) {
    cv::Mat plane = luminance(colour_of(photo));
    const cv::Mat all(plane.size(), CV_8U, cv::Scalar(255));
    const auto white = static_cast<float>(std::max(quantile(plane, all, 0.995), 1e-30));
    for (int y = 0; y < plane.rows; ++y) {
        float* row = plane.ptr<float>(y);
        for (int x = 0; x < plane.cols; ++x)
            row[x] = std::cbrt(std::clamp(row[x] / white, 0.0f, 1.5f));
    }
    return plane;
}

// Each value's rank among all, 0..255.
cv::Mat equalised(const cv::Mat& plane) {
    std::vector<float> sorted(plane.begin<float>(), plane.end<float>());
    std::sort(sorted.begin(), sorted.end());
    cv::Mat result(plane.size(), CV_8U);
    for (int y = 0; y < plane.rows; ++y) {
        for (int x = 0; x < plane.cols; ++x) {
            const auto at = std::lower_bound(sorted.begin(), sorted.end(), plane.at<float>(y, x));
            result.at<unsigned char>(y, x) =
                static_cast<unsigned char>(255.0 * static_cast<double>(at - sorted.begin()) /
                                           static_cast<double>(sorted.size()));
        }
    }
    return result;
}

// Edges along rays from the middle of `circle`, within `reach` of its radius. At most four a ray.
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
            // The mean of `spread` samples outside less that of as many inside.
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
            // The top of a parabola through three samples.
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

// How much of the outline is an edge: over all rays, the edge within `tolerance` of the circle
// against the strongest one along that ray. Where there is no circle, noise has an edge there by
// chance only, and seldom the strongest.
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

// Geometric distance, Tukey's weights at 4.685 times the spread (not below a tenth of a pixel).
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
        const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
        const Eigen::Vector3d step = -solver.solve(gradient);
        if (!step.allFinite()) return std::nullopt;
        circle.x += step[0];
        circle.y += step[1];
        circle.radius += step[2];
        if (!(circle.radius > 1)) return std::nullopt;
        const Eigen::Matrix3d covariance = normal.inverse() * spread * spread;
        // Neighbouring rays see the same clutter: one in four counts as a reading of its own.
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

// Where the light crosses the middle between inside and outside, along rays close to the outline:
// linear light, for the pixels of an edge are means of linear light. Rays without a clear step say
// nothing.
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
        // Both sides run on to the edge as straight lines: the rim's picture is pressed flat and
        // changes fast.
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

// Wide, then narrower about what was found.
std::optional<FoundBall> fitted_in_steps(const cv::Mat& plane, const BallCircle& rough,
                                         double reach) {
    auto found = fitted(plane, rough, reach);
    for (const double narrower : {reach / 3, reach / 8}) {
        if (!found) return found;
        const auto next = fitted(plane, found->circle, narrower);
        if (!next) break;
        found = next;
    }
    return found;
}

std::vector<BallCircle> hough_circles(const cv::Mat& picture, double edge, double threshold) {
    const int shorter = std::min(picture.cols, picture.rows);
    std::vector<BallCircle> result;
    // Large circles meet more edges by chance: each size has places of its own.
    const double largest = 0.6 * shorter;
    for (double least = std::max(6.0, shorter / 20.0); least < largest; least *= k_size_step) {
        std::vector<cv::Vec3f> circles;
        cv::HoughCircles(picture, circles, cv::HOUGH_GRADIENT, 2, shorter / 20.0, edge, threshold,
                         static_cast<int>(least),
                         static_cast<int>(std::min(least * k_size_step, largest)));
        for (std::size_t i = 0; i < std::min(circles.size(), k_circles_of_a_size); ++i)
            result.push_back({circles[i][0], circles[i][1], circles[i][2]});
    }
    return result;
}

bool nearly_same(const BallCircle& a, const BallCircle& b, double share) {
    return std::hypot(a.x - b.x, a.y - b.y) < share * a.radius &&
           std::abs(a.radius - b.radius) < share * a.radius;
}

// Pixel centres, when a picture is shrunk by `factor` as cv::resize does it.
BallCircle enlarged(const BallCircle& c, double factor) {
    return {(c.x + 0.5) * factor - 0.5, (c.y + 0.5) * factor - 0.5, c.radius * factor};
}

// Edges alone may be those of a can or a table. Where nothing is pressed together at any rim the
// support counts; of equals the larger, for a ball's own reflections are circles too.
void sort_by_evidence(const cv::Mat& whole, const cv::Mat& linear, std::vector<FoundBall>& found) {
    cv::Mat soft;
    cv::GaussianBlur(whole, soft, {}, 1.0);
    const auto weigh = [&](FoundBall& ball) {
        const RimLook rim = rim_look(soft, ball.circle);
        ball.evidence = ball.support * std::max(0.0, rim.compression - 1) * (1 - rim.alike);
        return ball.support * std::max(0.0, rim.compression - 1);
    };
    const auto sort = [&] {
        std::stable_sort(found.begin(), found.end(), [](const FoundBall& a, const FoundBall& b) {
            const double sa = a.support * std::pow(a.circle.radius, 0.15);
            const double sb = b.support * std::pow(b.circle.radius, 0.15);
            return std::pair(a.evidence, sa) > std::pair(b.evidence, sb);
        });
    };
    for (FoundBall& ball : found) weigh(ball);
    sort();
    if (found.empty() || !(found.front().evidence > 0)) return;
    // Circles that Hough's transform put beside a ball met edges of what it reflects.
    const double worth = 0.5 * found.front().evidence;
    for (FoundBall& ball : found) {
        if (ball.evidence < worth) continue;
        const BallCircle rough = ball.circle;
        double pressed = weigh(ball);
        for (const double size : {1.0, 0.94, 1.06}) {
            for (const double reach : {0.05, 0.1, 0.25}) {
                auto other = fitted_in_steps(whole, {rough.x, rough.y, size * rough.radius}, reach);
                if (!other) continue;
                *other = to_a_fraction_of_a_pixel(linear, *other);
                const double other_pressed = weigh(*other);
                if (other_pressed <= pressed) continue;
                pressed = other_pressed;
                ball = *other;
            }
        }
    }
    sort();
    std::vector<FoundBall> distinct;
    for (const FoundBall& ball : found) {
        if (std::none_of(distinct.begin(), distinct.end(), [&](const FoundBall& k) {
                return nearly_same(k.circle, ball.circle, 0.02);
            }))
            distinct.push_back(ball);
    }
    found = std::move(distinct);
    FoundBall& best = found.front();
    for (const FoundBall& other : found) {
        if (nearly_same(other.circle, best.circle, k_one_ball)) continue;
        if (other.evidence < k_rival_evidence * best.evidence) break;
        best.rival = other.circle;
        break;
    }
}

}  // namespace

std::optional<FoundBall> refined_ball(const Photo& photo, const BallCircle& rough, double reach) {
    const auto ball = fitted_in_steps(seen_luminance(photo), rough, reach);
    if (!ball) return ball;
    return to_a_fraction_of_a_pixel(luminance(colour_of(photo)), *ball);
}

std::vector<FoundBall> find_balls(const Photo& photo, double least_support) {
    if (photo.width < 16 || photo.height < 16) return {};
    const cv::Mat whole = seen_luminance(photo);
    const double factor =
        std::max(1.0, static_cast<double>(std::max(whole.cols, whole.rows)) / k_hough_side);
    cv::Mat small;
    cv::resize(whole, small, {}, 1 / factor, 1 / factor, cv::INTER_AREA);
    const double fx = static_cast<double>(whole.cols) / small.cols;
    // As it is; and with every brightness given as much room as it has pixels, for a ball in a dim
    // room whose lamps take all the range.
    struct Look {
        cv::Mat picture;
        double edge;
    };
    std::vector<Look> looks;
    for (const double blur : {1.0, 2.5}) {
        cv::Mat soft, plain;
        cv::GaussianBlur(small, soft, {}, blur);
        soft.convertTo(plain, CV_8U, 200);
        looks.push_back({plain, blur > 1 ? 60.0 : 100.0});
        if (blur > 1) looks.push_back({equalised(soft), 100.0});
    }

    // Edges of a few pixels' width stand out of noise that single pixels drown in.
    cv::GaussianBlur(small, small, {}, 1.0);
    std::vector<BallCircle> tried;
    std::vector<FoundBall> found;
    for (const Look& look : looks) {
        for (const double threshold : {120.0, 80.0, 50.0}) {
            for (const BallCircle& c : hough_circles(look.picture, look.edge, threshold)) {
                const bool known =
                    std::any_of(tried.begin(), tried.end(),
                                [&](const BallCircle& k) { return nearly_same(k, c, 0.05); });
                if (known) continue;
                tried.push_back(c);
                const auto ball = fitted_in_steps(small, c, 0.12);
                if (!ball || ball->support < least_support) continue;
                const bool found_before = std::any_of(
                    found.begin(), found.end(),
                    [&](const FoundBall& k) { return nearly_same(k.circle, ball->circle, 0.02); });
                if (!found_before) found.push_back(*ball);
            }
        }
    }
    const cv::Mat linear = luminance(colour_of(photo));
    for (FoundBall& ball : found) {
        ball.circle = enlarged(ball.circle, fx);
        if (fx > 1) {
            if (const auto fine = fitted_in_steps(whole, ball.circle, 0.02)) {
                ball = *fine;
            } else {
                ball.sigma_px *= fx;
            }
        }
        ball = to_a_fraction_of_a_pixel(linear, ball);
    }
    sort_by_evidence(whole, linear, found);
    return found;
}

}  // namespace culet
