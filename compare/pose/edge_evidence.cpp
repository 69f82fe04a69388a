#include "compare/pose/edge_evidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/pose/edge_lines.h"

namespace culet {

namespace {

constexpr int k_places = 12;                                       // on either side of an edge
constexpr double k_nearest_place = 0.02, k_farthest_place = 0.09;  // share of the diameter
// How far from its predicted place an edge is searched: pixels, and sigmas of the facets' errors.
constexpr double k_width_px = 0.5, k_width_sigmas = 2;
// The chance rate of all edges counts as much as this many places of the edge itself.
constexpr double k_shared = 4;
// Bounds on the share of the stone's edges that are seen: some are too faint, some hidden by
// reflexes.
constexpr double k_least_seen = 0.5, k_most_seen = 0.95;
constexpr double k_parallel = 0.94, k_own_px = 3;

struct EdgeRun {
    std::vector<WirePoint> points;
    double length = 0;
    bool met = false;
    int places = 0, hits = 0;
    double chance = 0;
};

std::vector<EdgeRun> crown_runs(const std::vector<WirePoint>& points) {
    std::vector<EdgeRun> runs;
    for (const WirePoint& point : points) {
        if (point.outline) continue;
        if (runs.empty() || runs.back().points.front().edge != point.edge) runs.emplace_back();
        runs.back().points.push_back(point);
    }
    std::erase_if(runs, [](const EdgeRun& run) { return run.points.size() < 3; });
    for (EdgeRun& run : runs) {
        const PicturePoint a = run.points.front().at, b = run.points.back().at;
        run.length = std::hypot(b.x - a.x, b.y - a.y);
    }
    return runs;
}

std::vector<WirePoint> moved(const std::vector<WirePoint>& points, double shift) {
    std::vector<WirePoint> there = points;
    for (WirePoint& point : there) {
        point.at.x += shift * point.normal_x;
        point.at.y += shift * point.normal_y;
    }
    return there;
}

bool on_stone(const cv::Mat& stone, const std::vector<WirePoint>& points) {
    for (const WirePoint* point : {&points.front(), &points.back()}) {
        const int x = static_cast<int>(point->at.x), y = static_cast<int>(point->at.y);
        if (x < 0 || y < 0 || x >= stone.cols || y >= stone.rows) return false;
        if (stone.at<unsigned char>(y, x) == 0) return false;
    }
    return true;
}

/// Whether another edge of the wireframe runs along there: meeting it would not be chance.
bool on_another(const std::vector<EdgeRun>& runs, const EdgeRun& run,
                const std::vector<WirePoint>& there) {
    const WirePoint& middle = there[there.size() / 2];
    for (const EdgeRun& other : runs) {
        if (&other == &run) continue;
        const WirePoint& a = other.points.front();
        const double facing = a.normal_x * middle.normal_x + a.normal_y * middle.normal_y;
        if (std::abs(facing) < k_parallel) continue;
        const double dx = middle.at.x - a.at.x, dy = middle.at.y - a.at.y;
        const double across = dx * a.normal_x + dy * a.normal_y;
        const double width = std::hypot(k_own_px, k_width_sigmas * a.facet_sigma);
        if (std::abs(across) > width) continue;
        const PicturePoint& b = other.points.back().at;
        const double along =
            (dx * (b.x - a.at.x) + dy * (b.y - a.at.y)) / std::max(1e-9, other.length);
        if (along > -0.5 * run.length && along < other.length + 0.5 * run.length) return true;
    }
    return false;
}

MetLine line_along(const EdgePicture& picture, const std::vector<WirePoint>& points) {
    const std::vector<double> expected(points.size(), 0.0);
    std::vector<double> width;
    for (const WirePoint& point : points)
        width.push_back(std::hypot(k_width_px, k_width_sigmas * point.facet_sigma));
    return met_lines(picture, points, expected, width).front();
}

void look_elsewhere(const EdgePicture& picture, const cv::Mat& stone,
                    const std::vector<EdgeRun>& runs, EdgeRun& run, double diameter_px) {
    for (int k = 0; k < 2 * k_places; ++k) {
        const double share = (k / 2 + 0.5) / k_places;
        const double shift =
            diameter_px * (k_nearest_place + share * (k_farthest_place - k_nearest_place));
        const std::vector<WirePoint> there = moved(run.points, k % 2 == 0 ? shift : -shift);
        if (!on_stone(stone, there) || on_another(runs, run, there)) continue;
        ++run.places;
        if (!line_along(picture, there).places.empty()) ++run.hits;
    }
}

}  // namespace

CrownEvidence crown_evidence(const EdgePicture& picture, const cv::Mat& stone,
                             const std::vector<WirePoint>& points, double diameter_px) {
    CrownEvidence evidence;
    std::vector<EdgeRun> runs = crown_runs(points);
    double places = 0, hits = 0, length = 0, squares = 0, count = 0;
    for (EdgeRun& run : runs) {
        const MetLine line = line_along(picture, run.points);
        run.met = !line.places.empty();
        for (const MetLine::Place& place : line.places) {
            const WirePoint& point = run.points[static_cast<std::size_t>(place.point)];
            const double sigma = std::hypot(point.facet_sigma, place.found.sigma, 0.2);
            squares += place.found.offset * place.found.offset / (sigma * sigma);
            ++count;
        }
        look_elsewhere(picture, stone, runs, run, diameter_px);
        places += run.places;
        hits += run.hits;
        length += run.length;
        ++evidence.looked;
        evidence.met += run.met ? 1 : 0;
    }
    if (runs.empty()) return evidence;
    evidence.misfit = count > 0 ? std::sqrt(squares / count) : 0;
    const double everywhere = (hits + 1) / (places + 2);
    const double seen =
        std::clamp(static_cast<double>(evidence.met) / evidence.looked, k_least_seen, k_most_seen);
    for (const EdgeRun& run : runs) {
        const double chance =
            std::clamp((run.hits + k_shared * everywhere) / (run.places + k_shared), 0.01, 0.99);
        evidence.chance_share += chance * run.length / length;
        evidence.log_odds +=
            run.met ? std::log(seen / chance) : std::log((1 - seen) / (1 - chance));
    }
    return evidence;
}

}  // namespace culet
