#include "compare/pose/edge_lines.h"

#include <algorithm>
#include <cmath>

namespace culet {

namespace {

constexpr double k_tolerance_px = 0.3;
constexpr double k_least_share = 0.65;
constexpr int k_least_points = 3;
// At most this many points start or end a trial line.
constexpr std::size_t k_most_ends = 8;
// Penalty: a line at the end of the search range must meet this much more of the edge than one at
// the expected place.
constexpr double k_far_costs = 0.25;

struct Peak {
    int point = -1;
    double along = 0, width = 1, off = 0;  // `off`: from where it is expected
    FoundEdge found;
};

struct Line {
    double at_0 = 0, slope = 0;
    double off(double along) const { return at_0 + slope * along; }
};

/// Points met by the line, with the nearest edge of each.
std::vector<const Peak*> met_by(const Line& line, const std::vector<Peak>& peaks) {
    std::vector<const Peak*> met;
    for (const Peak& peak : peaks) {
        const double miss = std::abs(peak.off - line.off(peak.along));
        if (miss > k_tolerance_px + peak.found.sigma) continue;
        if (!met.empty() && met.back()->point == peak.point) {
            if (miss < std::abs(met.back()->off - line.off(peak.along))) met.back() = &peak;
            continue;
        }
        met.push_back(&peak);
    }
    return met;
}

double worth(const Line& line, const std::vector<const Peak*>& met, int looked) {
    double off = 0;
    for (const Peak* peak : met) off += std::abs(line.off(peak->along)) / peak->width;
    const double count = static_cast<double>(met.size());
    if (met.empty()) return 0;
    off /= count;
    return count / looked - k_far_costs * off * off;
}

MetLine best_line(const std::vector<WirePoint>& points, const std::vector<Peak>& peaks,
                  int looked) {
    MetLine result;
    result.looked = looked;
    if (peaks.size() < static_cast<std::size_t>(k_least_points)) return result;
    const double middle = 0.5 * (peaks.front().along + peaks.back().along);
    std::vector<const Peak*> starts, ends;
    for (const Peak& peak : peaks) (peak.along < middle ? starts : ends).push_back(&peak);
    const auto thinned = [](std::vector<const Peak*>& list) {
        if (list.size() <= k_most_ends) return;
        std::vector<const Peak*> few;
        for (std::size_t i = 0; i < k_most_ends; ++i)
            few.push_back(list[i * list.size() / k_most_ends]);
        list = few;
    };
    thinned(starts);
    thinned(ends);
    double most = 0;
    std::vector<const Peak*> best;
    for (const Peak* start : starts) {
        for (const Peak* end : ends) {
            Line line;
            line.slope = (end->off - start->off) / (end->along - start->along);
            line.at_0 = start->off - line.slope * start->along;
            const std::vector<const Peak*> met = met_by(line, peaks);
            const double here = worth(line, met, looked);
            if (here <= most) continue;
            most = here;
            best = met;
        }
    }
    const double least = std::max<double>(k_least_points, k_least_share * looked);
    if (static_cast<double>(best.size()) < least) return result;
    result.edge = points[static_cast<std::size_t>(best.front()->point)].edge;
    result.outline = points[static_cast<std::size_t>(best.front()->point)].outline;
    for (const Peak* peak : best) result.places.push_back({peak->point, peak->found});
    return result;
}

}  // namespace

std::vector<MetLine> met_lines(const EdgePicture& picture, const std::vector<WirePoint>& points,
                               const std::vector<double>& expected,
                               const std::vector<double>& width) {
    std::vector<MetLine> lines;
    for (std::size_t first = 0; first < points.size();) {
        std::size_t last = first;
        while (last < points.size() && points[last].edge == points[first].edge) ++last;
        std::vector<Peak> peaks;
        for (std::size_t i = first; i < last; ++i) {
            const WirePoint& point = points[i];
            const double along =
                std::hypot(point.at.x - points[first].at.x, point.at.y - points[first].at.y);
            for (const FoundEdge& found :
                 edges_across(picture, point, std::abs(expected[i]) + width[i])) {
                const double off = found.offset - expected[i];
                if (std::abs(off) > width[i]) continue;
                peaks.push_back({static_cast<int>(i), along, width[i], off, found});
            }
        }
        MetLine line = best_line(points, peaks, static_cast<int>(last - first));
        line.edge = points[first].edge;
        line.outline = points[first].outline;
        lines.push_back(std::move(line));
        first = last;
    }
    return lines;
}

}  // namespace culet
