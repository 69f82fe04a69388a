#include "tests/compare/turned_stone.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "render/colour/colour.h"

namespace culet::synthetic {

namespace {

// Corners of the outline, in pixels, clockwise as shown.
std::vector<cv::Point2d> outline_of(const Solid& solid, double turn, const TurntableTruth& truth) {
    std::vector<cv::Point2f> all, hull;
    const double c = std::cos(turn), s = std::sin(turn);
    const double middle = (truth.size - 1) / 2.0;
    for (const Vec3& v : solid.vertices) {
        // The camera is over +x: after a counter-clockwise `turn` a point appears at its y, and
        // nearer by its x.
        const double near = c * v.x - s * v.y, right = s * v.x + c * v.y;
        const double up = std::cos(truth.elevation) * v.z - std::sin(truth.elevation) * near;
        const double u = (std::cos(truth.roll) * right + std::sin(truth.roll) * up) / truth.pixel,
                     w = (std::cos(truth.roll) * up - std::sin(truth.roll) * right) / truth.pixel;
        all.emplace_back(float(middle + truth.axis_px + u), float(middle - w));
    }
    cv::convexHull(all, hull);
    return {hull.begin(), hull.end()};
}

}  // namespace

Photo turned_picture(const Solid& solid, double turn, const TurntableTruth& truth,
                     std::mt19937_64& random) {
    const std::vector<cv::Point2d> outline = outline_of(solid, turn, truth);
    cv::Point2d inside(0, 0);
    for (const cv::Point2d& p : outline) inside += p * (1.0 / double(outline.size()));
    struct Edge {
        cv::Point2d normal;
        double offset;
    };
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const cv::Point2d along = outline[(i + 1) % outline.size()] - outline[i];
        const double length = std::hypot(along.x, along.y);
        if (!(length > 1e-9)) continue;
        cv::Point2d normal(along.y / length, -along.x / length);
        if (normal.dot(inside - outline[i]) > 0) normal = -normal;
        edges.push_back({normal, normal.dot(outline[i])});
    }
    // The part of a pixel that the nearest edge covers; then the lens.
    cv::Mat covered(truth.size, truth.size, CV_32F);
    for (int y = 0; y < truth.size; ++y) {
        for (int x = 0; x < truth.size; ++x) {
            double farthest = -1e300;
            for (const Edge& edge : edges)
                farthest =
                    std::max(farthest, edge.normal.dot({double(x), double(y)}) - edge.offset);
            covered.at<float>(y, x) = static_cast<float>(std::clamp(0.5 - farthest, 0.0, 1.0));
        }
    }
    cv::GaussianBlur(covered, covered, {0, 0}, truth.blur_px);
    Photo photo;
    photo.width = photo.height = truth.size;
    photo.saturation = truth.eight_bit ? 1 : 0;
    std::normal_distribution<double> normal;
    for (int y = 0; y < truth.size; ++y) {
        for (int x = 0; x < truth.size; ++x) {
            const double u = 2.0 * x / truth.size - 1, v = 2.0 * y / truth.size - 1;
            const double spot =
                0.6 * std::exp(-(std::pow(x - inside.x, 2) + std::pow(y - inside.y, 2)) / 800);
            double light = 0.8 * (1 - 0.05 * (u * u + v * v)) *
                           (1 - double(covered.at<float>(y, x)) * (0.97 - spot));
            light = std::clamp(light + 0.8 * truth.noise * normal(random), 0.0, 1.0);
            if (truth.eight_bit) light = srgb_decoded(std::round(255 * srgb_encoded(light)) / 255);
            photo.rgb.insert(photo.rgb.end(), 3, static_cast<float>(light));
        }
    }
    return photo;
}

}  // namespace culet::synthetic
