#include "compare/light_probe/window_fit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "compare/light_probe/window_solver.h"

namespace culet {

using namespace window;

namespace {

constexpr double k_tilt_known = 0.5;  // radians
constexpr std::size_t k_least_sights = 12;

// An even subset of each outline's sights, enough for a first solution.
std::vector<SeenOutline> thinned(const std::vector<SeenOutline>& outlines) {
    constexpr std::size_t k_enough = 48;
    std::vector<SeenOutline> result = outlines;
    for (std::size_t o = 0; o < outlines.size(); ++o) {
        const std::vector<EdgeSight>& sights = outlines[o].sights;
        if (sights.size() <= k_enough) continue;
        result[o].sights.clear();
        for (std::size_t k = 0; k < k_enough; ++k)
            result[o].sights.push_back(sights[k * sights.size() / k_enough]);
    }
    return result;
}

// Start values: the moments of the first outline's points in the plane at unit distance give
// extents and roll.
Parameters start_of(const Frame& frame, const SeenOutline& outline, double nearness,
                    double turned_by) {
    double xx = 0, xy = 0, yy = 0, mx = 0, my = 0, count = 0;
    std::vector<std::array<double, 2>> points;
    for (const EdgeSight& sight : outline.sights) {
        // Where the line meets the plane at distance 1 / nearness, in units of that distance.
        const double depth = glm::dot(sight.direction, frame.towards);
        const double far = (1 - nearness * glm::dot(sight.from, frame.towards)) / depth;
        const Vec3 at = nearness * sight.from + far * sight.direction;
        points.push_back({glm::dot(at, frame.across), glm::dot(at, frame.along)});
        mx += points.back()[0];
        my += points.back()[1];
        ++count;
    }
    mx /= count;
    my /= count;
    for (const auto& p : points) {
        xx += (p[0] - mx) * (p[0] - mx) / count;
        xy += (p[0] - mx) * (p[1] - my) / count;
        yy += (p[1] - my) * (p[1] - my) / count;
    }
    // A square's outline has no principal axes: the other start is an eighth of a turn on.
    const double turn = 0.5 * std::atan2(2 * xy, xx - yy) + turned_by;
    double u = 0, v = 0;
    for (const auto& p : points) {
        const double x = p[0] - mx, y = p[1] - my;
        u = std::max(u, std::abs(std::cos(turn) * x + std::sin(turn) * y));
        v = std::max(v, std::abs(-std::sin(turn) * x + std::cos(turn) * y));
    }
    Parameters start{};
    start[beside_x] = mx;
    start[beside_y] = my;
    start[near] = nearness;
    start[roll] = turn;
    start[log_u] = std::log(u);
    start[log_v] = std::log(v);
    return start;
}

// Facing the origin: from these nearnesses and two turns. `frame` becomes that of the solution.
Solved best_facing(const std::vector<SeenOutline>& outlines, const std::vector<double>& nearnesses,
                   bool held, Frame& frame) {
    constexpr double k_eighth = std::numbers::pi / 4;
    Solved best;
    // Twice: the first solution gives the middle's direction, which becomes the frame's axis.
    for (int round = 0; round < 2; ++round) {
        if (round > 0) {
            const auto middle = window_of(frame, best.at.data()).middle;
            frame = Frame(glm::normalize(Vec3(middle[0], middle[1], middle[2])));
            best = Solved{};
        }
        for (const double from : nearnesses) {
            for (const double turned_by : {0.0, k_eighth}) {
                const Solved one = solved(
                    frame, outlines, start_of(frame, outlines[0], from, turned_by), held, true);
                if (one.cost < best.cost) best = one;
            }
        }
        if (!std::isfinite(best.cost)) break;
    }
    return best;
}

// Several starts, because from far away two tilts look alike.
Solved best_tilted(const Frame& frame, const std::vector<SeenOutline>& outlines,
                   const std::vector<double>& nearnesses, Parameters start) {
    Solved best;
    for (const double from : nearnesses) {
        for (const auto& [x, y] :
             {std::array{0.0, 0.0}, {0.6, 0.0}, {-0.6, 0.0}, {0.0, 0.6}, {0.0, -0.6}}) {
            start[near] = from;
            start[tilt_x] = x;
            start[tilt_y] = y;
            const Solved one = solved(frame, outlines, start, false, false);
            if (one.cost < best.cost) best = one;
        }
    }
    return best;
}

WindowFit described(const Frame& frame, const Solved& best, bool held, bool facing) {
    WindowFit fit;
    const ScaledWindow<double> w = window_of(frame, best.at.data());
    const Vec3 middle(w.middle[0], w.middle[1], w.middle[2]);
    const double length = glm::length(middle);
    // Distance of the window: that along the start direction times the middle's length.
    fit.nearness = best.at[near] / length;
    fit.nearness_sigma = held ? 0 : best.nearness_sigma / length;
    fit.facing = facing;
    fit.residual = best.residual;
    const Vec3 u(w.u[0], w.u[1], w.u[2]), v(w.v[0], w.v[1], w.v[2]);
    fit.tilt = std::acos(
        std::min(std::abs(glm::dot(glm::normalize(glm::cross(u, v)), middle / length)), 1.0));
    fit.tilt_sigma = facing ? 0 : best.tilt_sigma;
    const double distance = best.at[near] > 0 ? 1 / best.at[near] : 0;
    fit.window = {distance * middle, distance * u, distance * v};
    return fit;
}

}  // namespace

std::optional<WindowFit> fit_window(const std::vector<SeenOutline>& all,
                                    const std::optional<double>& nearness) {
    if (all.empty()) return std::nullopt;
    for (const SeenOutline& outline : all)
        if (outline.sights.size() < k_least_sights) return std::nullopt;
    const std::vector<SeenOutline> outlines = thinned(all);
    Vec3 towards(0.0);
    for (const EdgeSight& sight : outlines[0].sights) towards += sight.direction;
    Frame frame(glm::normalize(towards));
    const bool held = nearness.has_value();
    const std::vector<double> starts =
        held ? std::vector<double>{*nearness} : std::vector<double>{0.01, 0.05, 0.15, 0.4};

    Solved best = best_facing(outlines, starts, held, frame);
    if (!std::isfinite(best.cost)) return std::nullopt;
    bool facing = true;
    if (!held) {
        const Solved tilted = best_tilted(frame, outlines, starts, best.at);
        if (tilted.cost <= best.cost && tilted.tilt_sigma < k_tilt_known) {
            best = tilted;
            facing = false;
        }
    }
    best = solved(frame, all, best.at, held, facing);
    if (!std::isfinite(best.cost)) return std::nullopt;
    return described(frame, best, held, facing);
}

double missed_angle(const Window& window, const std::vector<SeenOutline>& outlines) {
    const auto vector = [](const Vec3& v) { return Vector<double>{v.x, v.y, v.z}; };
    const ScaledWindow<double> w{vector(window.middle), vector(window.u), vector(window.v)};
    double squares = 0, count = 0;
    for (const SeenOutline& outline : outlines) {
        for (const EdgeSight& sight : outline.sights) {
            const double missed = inside_edges(w, vector(sight.from), vector(sight.direction));
            squares += missed * missed;
            ++count;
        }
    }
    return count > 0 ? std::sqrt(squares / count) : 0;
}

}  // namespace culet
