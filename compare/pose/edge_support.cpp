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
    void add(bool hit) {
        points += 1;
        if (hit) met += 1;
    }
    double share() const { return points > 0 ? met / points : 0; }
};

// The point in the wireframe's `k`-th shift.
WirePoint shifted_point(WirePoint point, int k, double diameter_px) {
    const double angle = 2 * std::numbers::pi * (k + 0.5) / k_shifts;
    const double shift = diameter_px * (0.025 + 0.045 * ((k * 7) % k_shifts) / k_shifts);
    point.at.x += shift * std::cos(angle);
    point.at.y += shift * std::sin(angle);
    return point;
}

// Negative log-likelihood of the outline's distances; they count as sixteen independent ones.
double outline_misfit(const EdgePicture& picture, const std::vector<WirePoint>& points,
                      std::size_t every, double diameter_px) {
    double met = 0, squares = 0;
    for (std::size_t i = 0; i < points.size(); i += every) {
        if (!points[i].outline) continue;
        // The outermost edge is the outline's. The search is wide, so that a bad fit shows.
        double nearest = 0.02 * diameter_px;
        const auto found = edges_across(picture, points[i], nearest);
        if (found.empty()) continue;
        for (const FoundEdge& edge : found) nearest = std::min(nearest, std::abs(edge.offset));
        ++met;
        squares += nearest * nearest;
    }
    const double rms = met > 0 ? std::sqrt(squares / met) : 0;
    const double off = rms / (0.4 + 0.0015 * diameter_px);
    return 0.5 * 16 * off * off;
}

}  // namespace

EdgeSupport edge_support(const EdgePicture& picture, const std::vector<WirePoint>& points,
                         double diameter_px) {
    EdgeSupport support;
    // A subset of the points is enough for shares.
    const std::size_t every = std::max<std::size_t>(1, points.size() / 1500);
    Share crown;
    std::vector<Share> shifted(k_shifts);
    const double step = 2.0 * static_cast<double>(every);
    const double independent = std::max(k_independent_px, k_independent_share * diameter_px);
    // For the shifted wireframes, points nearer than this add nothing.
    const int apart = std::max(1, static_cast<int>(independent / step));
    int crown_point = 0;
    for (std::size_t i = 0; i < points.size(); i += every) {
        if (points[i].outline) continue;
        crown.add(is_met(picture, points[i]));
        ++crown_point;
        for (int k = crown_point % apart; k < k_shifts; k += apart) {
            shifted[static_cast<std::size_t>(k)].add(
                is_met(picture, shifted_point(points[i], k, diameter_px)));
        }
    }
    support.met = crown.share();
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
    support.log_likelihood = effective_points * (met > chance ? gain : -gain) -
                             outline_misfit(picture, points, every, diameter_px);
    return support;
}

}  // namespace culet
