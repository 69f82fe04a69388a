#include "compare/light_probe/ball_finder.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/light_probe/circle_fit.h"
#include "compare/light_probe/rim_compression.h"
#include "compare/photo/pixels.h"

namespace culet {

namespace {

constexpr int k_hough_side = 640;  // longer side of the pictures for Hough's transform, pixels
constexpr double k_size_step = 1.6;
constexpr std::size_t k_circles_of_a_size = 6;
constexpr double k_one_ball = 0.25;  // of the radius: nearer circles are the same ball

// Perceived luminance: cube root above the dark level, 0..1 at the 99.5 % quantile.
cv::Mat seen_luminance(const Photo& photo) {
    cv::Mat plane = luminance(colour_of(photo));
    const auto white = static_cast<float>(std::max(quantile(plane, {}, 0.995), 1e-30));
    for (int y = 0; y < plane.rows; ++y) {
        float* row = plane.ptr<float>(y);
        for (int x = 0; x < plane.cols; ++x)
            row[x] = std::cbrt(std::clamp(row[x] / white, 0.0f, 1.5f));
    }
    return plane;
}

// Each value's rank, 0..255.
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

std::vector<BallCircle> hough_circles(const cv::Mat& picture, double edge, double threshold) {
    const int shorter = std::min(picture.cols, picture.rows);
    std::vector<BallCircle> result;
    // Large circles meet more edges by chance, so each range of sizes has its own candidates.
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

// Coordinates of pixel centres after cv::resize by 1 / `factor`, converted back.
BallCircle enlarged(const BallCircle& c, double factor) {
    return {(c.x + 0.5) * factor - 0.5, (c.y + 0.5) * factor - 0.5, c.radius * factor};
}

// Edges alone may belong to a can or a table. If no rim is compressed, sorts by support with a
// preference for larger circles, because a ball's reflections are circles too.
void sort_by_evidence(const cv::Mat& whole, const cv::Mat& linear, std::vector<FoundBall>& found) {
    cv::Mat soft;
    cv::GaussianBlur(whole, soft, {}, 1.0);
    const auto weigh = [&](FoundBall& ball) {
        const RimLook rim = rim_look(soft, ball.circle);
        const double pressed = ball.support * std::max(0.0, rim.compression - 1);
        ball.evidence = pressed * (1 - rim.alike);
        return pressed;
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
    // Refits the best: a circle that Hough's transform put beside a ball may have met edges of its
    // reflections.
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

std::vector<FoundBall> find_balls(const Photo& photo, double least_support) {
    if (photo.width < 16 || photo.height < 16) return {};
    const cv::Mat whole = seen_luminance(photo);
    const double factor =
        std::max(1.0, static_cast<double>(std::max(whole.cols, whole.rows)) / k_hough_side);
    cv::Mat small;
    cv::resize(whole, small, {}, 1 / factor, 1 / factor, cv::INTER_AREA);
    const double fx = static_cast<double>(whole.cols) / small.cols;
    // Besides the picture itself, an equalised one: for a ball in a dim room whose lamps take up
    // the whole range.
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

    // Smoothing brings edges of a few pixels' width out of the noise.
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
