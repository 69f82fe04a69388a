#include "compare/pose/coarse_search.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Step between the rotations that are tried. Half of it moves a table by 0.6 % of the stone's
// diameter, within the reach of the edge map.
constexpr double k_step_deg = 2.6;
// Views nearer than this refine to the same one.
constexpr double k_same_deg = 1.2;
// A smaller outline error, as a share of the diameter, may come from the coarse grid, the mask's
// pixels or facet errors.
constexpr double k_outline_slack = 0.004;
// Nearer points of the wireframe are not independent: an unrelated edge of the picture runs for
// about 3 % of the diameter.
constexpr double k_independent = 0.03;

double sum_of_agreement(const Target& target, const StoneView& view, double& variance) {
    const std::vector<WireEdge> edges = visible_edges(target.wire, view);
    const double step = 1.5 * target.edges.pixel();
    const double independent = std::max(k_independent * target.shape.diameter, step);
    double sum = 0;
    variance = 0;
    for (const WireEdge& edge : edges) {
        if (edge.outline) continue;
        const double dx = edge.to.x - edge.from.x, dy = edge.to.y - edge.from.y;
        const double length = std::hypot(dx, dy);
        const int count = static_cast<int>(length / step);
        if (count < 3) continue;
        const double nx = dy / length, ny = -dx / length;
        const EdgeMap::Direction along = target.edges.direction(nx, ny);
        double of_edge = 0;
        for (int i = 1; i + 1 < count; ++i) {
            const double share = (i + 0.5) / count;
            of_edge += along.agreement({edge.from.x + share * dx, edge.from.y + share * dy});
        }
        const double effective_points = std::max(1.0, length / independent);
        const double mean = of_edge / (count - 2);
        sum += mean * effective_points;
        variance += effective_points;
    }
    variance *= target.edges.spread() * target.edges.spread();
    return sum;
}

/// Improves a view by rotations about single axes in shrinking steps.
CoarseView climbed(const Target& target, CoarseView best, double first_step, double last_step) {
    for (double step = first_step; step >= last_step; step *= 0.5) {
        for (int round = 0; round < 4; ++round) {
            bool better = false;
            for (int axis = 0; axis < 3; ++axis) {
                for (const double sign : {1.0, -1.0}) {
                    Vec3 w(0);
                    w[axis] = sign * step;
                    StoneView turned = best.view;
                    turned.turn = rotation_by(w) * turned.turn;
                    const CoarseView tried = score_view(target, turned);
                    if (tried.score <= best.score) continue;
                    best = tried;
                    better = true;
                    break;
                }
            }
            if (!better) break;
        }
    }
    return best;
}

bool same_view(const StoneView& a, const StoneView& b, double within) {
    return angle_of(a.turn * glm::transpose(b.turn)) < within;
}

std::vector<CoarseView> distinct(std::vector<CoarseView> views, int most, double within) {
    std::stable_sort(views.begin(), views.end(),
                     [](const CoarseView& a, const CoarseView& b) { return a.score > b.score; });
    std::vector<CoarseView> kept;
    for (const CoarseView& view : views) {
        const bool known = std::any_of(kept.begin(), kept.end(), [&](const CoarseView& other) {
            return same_view(view.view, other.view, within);
        });
        if (known) continue;
        kept.push_back(view);
        if (static_cast<int>(kept.size()) >= most) break;
    }
    return kept;
}

std::vector<CoarseView> all_climbed(const Target& target, const std::vector<CoarseView>& views,
                                    double first_step, double last_step) {
    std::vector<CoarseView> result(views.size());
    tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
        result[i] = climbed(target, views[i], first_step, last_step);
    });
    return result;
}

}  // namespace

CoarseView score_view(const Target& target, const StoneView& start) {
    const FittedOutline fitted = fit_outline(target.wire, target.shape, start, target.focal_px);
    CoarseView result{fitted.view, -1e300};
    const double diameter = target.shape.diameter;
    if (!(fitted.rms < 0.2 * diameter)) return result;
    double variance = 0;
    const double sum = sum_of_agreement(target, fitted.view, variance);
    const double z = variance > 0 ? sum / std::sqrt(variance) : 0;
    // The outline has about 16 independent tangents.
    const double slack = k_outline_slack * diameter + 0.3;
    const double off = fitted.rms / slack;
    result.score = 0.5 * z * std::abs(z) - 0.5 * 16 * off * off;
    return result;
}

std::vector<CoarseView> search_views(const Target& target, const StoneView& start, double angle,
                                     int most, const Progress& progress) {
    const double step = radians(k_step_deg);
    // Rotation vectors on a grid, which is nearly uniform near the identity.
    const int reach = static_cast<int>(std::ceil(angle / step));
    std::vector<Vec3> turns;
    for (int x = -reach; x <= reach; ++x) {
        for (int y = -reach; y <= reach; ++y) {
            for (int z = -reach; z <= reach; ++z) {
                const Vec3 w = step * Vec3(x, y, z);
                if (glm::length(w) <= angle + 0.5 * step) turns.push_back(w);
            }
        }
    }
    std::vector<CoarseView> views(turns.size());
    std::atomic<bool> stopped{false};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, turns.size(), 256),
                      [&](const tbb::blocked_range<std::size_t>& part) {
                          if (stopped) return;
                          for (std::size_t i = part.begin(); i < part.end(); ++i) {
                              StoneView turned = start;
                              turned.turn = rotation_by(turns[i]) * start.turn;
                              views[i] = score_view(target, turned);
                          }
                      });
    if (progress && !progress(0)) throw Interrupted();
    // Coarse steps first, then fine steps for the best views.
    const std::vector<CoarseView> wide = distinct(std::move(views), 8 * most, 0.9 * step);
    const std::vector<CoarseView> climbed_once =
        all_climbed(target, wide, radians(1.3), radians(0.6));
    return distinct(all_climbed(target, distinct(climbed_once, 2 * most, radians(k_same_deg)),
                                radians(0.6), radians(0.15)),
                    most, radians(k_same_deg));
}

std::vector<CoarseView> turned_views(const Target& target, const StoneView& view, int most) {
    constexpr int k_turns = 180;
    std::vector<CoarseView> views(k_turns);
    tbb::parallel_for(std::size_t{0}, std::size_t{k_turns}, [&](std::size_t i) {
        StoneView turned = view;
        const double turn = 2 * std::numbers::pi * static_cast<double>(i) / k_turns;
        turned.turn = view.turn * rotation_by({0, 0, turn});
        views[i] = score_view(target, turned);
    });
    return distinct(all_climbed(target, distinct(std::move(views), 3 * most, radians(3)),
                                radians(1), radians(0.15)),
                    most, radians(k_same_deg));
}

}  // namespace culet
