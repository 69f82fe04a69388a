#include "compare/pose/edge_support.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace culet {

namespace {

constexpr int k_shifts = 24;
// Neighbouring points meet or miss together, because an edge of the picture runs for some pixels.
constexpr double k_independent_px = 6, k_independent_share = 0.03;

double near_limit(const WirePoint& point) {
    return std::hypot(1.0, 1.5 * point.facet_sigma);
}

bool is_met(const EdgePicture& picture, const WirePoint& point) {
    return !edges_across(picture, point, near_limit(point)).empty();
}

struct Share {
    double met = 0, points = 0;
    double share() const { return points > 0 ? met / points : 0; }
};

}  // namespace

EdgeSupport edge_support(const EdgePicture& picture, const std::vector<WirePoint>& points,
                         double diameter_px) {
    EdgeSupport support;
    // A subset of the points is enough for shares.
    const std::size_t every = std::max<std::size_t>(1, points.size() / 1500);
    Share crown;
    double outlines = 0, outline_squares = 0;  // number of outline points met, and their distances
    std::vector<Share> shifted(k_shifts);
    const double step = 2.0 * static_cast<double>(every);
    const double independent = std::max(k_independent_px, k_independent_share * diameter_px);
    // For the shifted wireframes, points nearer than this add nothing.
    const int apart = std::max(1, static_cast<int>(independent / step));
    int crown_point = 0;
    for (std::size_t i = 0; i < points.size(); i += every) {
        const WirePoint& point = points[i];
        if (point.outline) {
            // The outermost edge is the outline's. The search is wide, so that a bad fit shows.
            const auto found = edges_across(picture, point, 0.02 * diameter_px);
            double nearest = 0.02 * diameter_px;
            for (const FoundEdge& edge : found) nearest = std::min(nearest, std::abs(edge.offset));
            if (found.empty()) continue;
            ++outlines;
            outline_squares += nearest * nearest;
            continue;
        }
        crown.points += 1;
        if (is_met(picture, point)) crown.met += 1;
        ++crown_point;
        for (int k = crown_point % apart; k < k_shifts; k += apart) {
            const double angle = 2 * std::numbers::pi * (k + 0.5) / k_shifts;
            const double shift = diameter_px * (0.025 + 0.045 * ((k * 7) % k_shifts) / k_shifts);
            WirePoint elsewhere = point;
            elsewhere.at.x += shift * std::cos(angle);
            elsewhere.at.y += shift * std::sin(angle);
            Share& share = shifted[static_cast<std::size_t>(k)];
            share.points += 1;
            if (is_met(picture, elsewhere)) share.met += 1;
        }
    }
    support.met = crown.share();
    const double outline_rms = outlines > 0 ? std::sqrt(outline_squares / outlines) : 0;
    if (crown.points == 0) return support;
    double sum = 0, squares = 0, shifts = 0;
    for (const Share& share : shifted) {
        if (share.points == 0) continue;
        sum += share.share();
        squares += share.share() * share.share();
        ++shifts;
    }
    support.chance = sum / shifts;
    const double variance = std::max(0.0, squares / shifts - support.chance * support.chance);
    const double effective_points = std::max(1.0, crown.points * std::min(1.0, step / independent));
    const double chance = std::clamp(support.chance, 0.02, 0.98);
    const double spread = std::sqrt(variance + chance * (1 - chance) / effective_points);
    support.z = (support.met - support.chance) / spread;
    // Every point meets with the overall share, or with that of chance.
    const double met = std::clamp(support.met, 0.02, 0.98);
    const double gain =
        met * std::log(met / chance) + (1 - met) * std::log((1 - met) / (1 - chance));
    support.log_likelihood = effective_points * (met > chance ? gain : -gain);
    const double outline_sigma = 0.4 + 0.0015 * diameter_px;
    const double off = outline_rms / outline_sigma;
    support.log_likelihood -= 0.5 * 16 * off * off;
    return support;
}

}  // namespace culet
