#include "compare/pose/outline_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace culet {

namespace {

struct Directions {
    std::array<double, k_tangents> cosine{}, sine{};
};

const Directions& directions() {
    static const Directions table = [] {
        Directions d;
        for (int k = 0; k < k_tangents; ++k) {
            const double angle = 2 * std::numbers::pi * k / k_tangents;
            d.cosine[static_cast<std::size_t>(k)] = std::cos(angle);
            d.sine[static_cast<std::size_t>(k)] = std::sin(angle);
        }
        return d;
    }();
    return table;
}

/// Corners of the outline relative to the view's point, ordered by angle. The outline is convex and
/// contains that point.
std::vector<PicturePoint> outline_of(const WireSolid& wire, const StoneView& view) {
    const Projection project(view);
    const std::vector<char> seen = facets_seen(wire, view);
    std::vector<std::pair<double, PicturePoint>> corners;
    for (const Edge& edge : wire.edges) {
        if (seen[static_cast<std::size_t>(edge.left)] == seen[static_cast<std::size_t>(edge.right)])
            continue;
        // Each corner belongs to two edges of the outline; duplicates do no harm.
        for (const int corner : {edge.from, edge.to}) {
            const PicturePoint p = project(wire.solid.vertices[static_cast<std::size_t>(corner)]);
            const PicturePoint arm{p.x - view.at.x, p.y - view.at.y};
            corners.emplace_back(std::atan2(arm.y, arm.x), arm);
        }
    }
    std::sort(corners.begin(), corners.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<PicturePoint> loop;
    for (const auto& [angle, p] : corners) {
        if (loop.empty() || p.x != loop.back().x || p.y != loop.back().y) loop.push_back(p);
    }
    return loop;
}

}  // namespace

OutlineShape outline_shape(const cv::Mat& mask) {
    OutlineShape shape;
    const cv::Moments moments = cv::moments(mask, true);
    shape.middle = {moments.m10 / moments.m00 + 0.5, moments.m01 / moments.m00 + 0.5};
    shape.diameter = 2 * std::sqrt(moments.m00 / std::numbers::pi);
    std::vector<cv::Point> pixels, hull;
    cv::findNonZero(mask, pixels);
    cv::convexHull(pixels, hull);
    const Directions& d = directions();
    for (std::size_t k = 0; k < k_tangents; ++k) {
        double most = -1e300;
        for (const cv::Point& p : hull)
            most = std::max(most, (p.x + 0.5) * d.cosine[k] + (p.y + 0.5) * d.sine[k]);
        // The pixel centres lie inside a straight edge, the outermost by a quarter of a pixel's
        // width on average.
        const double width = std::abs(d.cosine[k]) + std::abs(d.sine[k]);
        shape.reach[k] = most + 0.25 * width;
    }
    return shape;
}

FittedOutline fit_outline(const WireSolid& wire, const OutlineShape& shape, const StoneView& start,
                          double focal_px) {
    const Directions& d = directions();
    FittedOutline result{start, 0};
    const int rounds = focal_px > 0 ? 2 : 1;
    for (int round = 0; round < rounds; ++round) {
        StoneView& view = result.view;
        view.nearness = focal_px > 0 ? view.scale / focal_px : 0;
        const std::vector<PicturePoint> corners = outline_of(wire, view);
        if (corners.size() < 3) {
            result.rms = 1e300;
            return result;
        }
        // reach = grow * own + x cos + y sin with the unknowns grow, x, y.
        cv::Matx33d normal = cv::Matx33d::zeros();
        cv::Vec3d right(0, 0, 0);
        std::array<double, k_tangents> own;
        const auto along = [&](const PicturePoint& p, std::size_t k) {
            return p.x * d.cosine[k] + p.y * d.sine[k];
        };
        std::size_t furthest = 0;
        for (std::size_t i = 1; i < corners.size(); ++i) {
            if (along(corners[i], 0) > along(corners[furthest], 0)) furthest = i;
        }
        for (std::size_t k = 0; k < k_tangents; ++k) {
            // The furthest corner only moves forward as the direction turns.
            while (along(corners[(furthest + 1) % corners.size()], k) > along(corners[furthest], k))
                furthest = (furthest + 1) % corners.size();
            const double most = along(corners[furthest], k);
            own[k] = most;
            const cv::Vec3d row(most, d.cosine[k], d.sine[k]);
            normal += row * row.t();
            right += shape.reach[k] * row;
        }
        cv::Vec3d solution;
        if (!cv::solve(normal, right, solution, cv::DECOMP_CHOLESKY) || !(solution[0] > 0)) {
            result.rms = 1e300;
            return result;
        }
        double sum = 0;
        for (std::size_t k = 0; k < k_tangents; ++k) {
            const double off =
                shape.reach[k] - cv::Vec3d(own[k], d.cosine[k], d.sine[k]).dot(solution);
            sum += off * off;
        }
        result.rms = std::sqrt(sum / k_tangents);
        view.scale *= solution[0];
        view.at = {solution[1], solution[2]};
        view.nearness = focal_px > 0 ? view.scale / focal_px : 0;
    }
    return result;
}

}  // namespace culet
