#include "compare/light_probe/window_fit.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "stone/solid/perpendicular.h"

namespace culet {

namespace {

// The window in units of its distance: the middle's two offsets from the start direction, and the
// nearness; a rotation (about the two axes across that direction, then about itself); the
// logarithms of the half-extents.
enum Parameter { beside_x, beside_y, near, tilt_x, tilt_y, roll, log_u, log_v, parameter_count };
using Parameters = std::array<double, parameter_count>;

constexpr double k_tilt_known = 0.5;  // radians
constexpr std::size_t k_least_sights = 12;

struct Frame {
    Vec3 towards, across, along;
    explicit Frame(const Vec3& direction)
        : towards(direction),
          across(perpendicular_to(direction)),
          along(glm::cross(direction, across)) {}
};

template <class Number>
using Vector = std::array<Number, 3>;

/// Middle and half-extents, times the nearness.
template <class Number>
struct ScaledWindow {
    Vector<Number> middle, u, v;
};

template <class Number>
ScaledWindow<Number> window_of(const Frame& frame, const Number* p) {
    using std::exp;
    const auto in_world = [&](const Number& x, const Number& y, const Number& z) {
        Vector<Number> w;
        for (int k = 0; k < 3; ++k)
            w[static_cast<std::size_t>(k)] =
                x * frame.across[k] + y * frame.along[k] + z * frame.towards[k];
        return w;
    };
    // Roll about the line of sight first, then tilt.
    const Number rolled[3] = {Number(0), Number(0), p[roll]};
    const Number tilted[3] = {p[tilt_x], p[tilt_y], Number(0)};
    const auto turned = [&](int axis, const Number& length) {
        Number start[3] = {Number(0), Number(0), Number(0)}, middle[3], end[3];
        start[axis] = length;
        ceres::AngleAxisRotatePoint(rolled, start, middle);
        ceres::AngleAxisRotatePoint(tilted, middle, end);
        return in_world(end[0], end[1], end[2]);
    };
    return {in_world(p[beside_x], p[beside_y], Number(1)), turned(0, exp(p[log_u])),
            turned(1, exp(p[log_v]))};
}

/// Sine of the angle by which a direction passes inside the nearest of the four planes through the
/// place and an edge; negative outside. `place`: times the nearness.
template <class Number>
Number inside_edges(const ScaledWindow<Number>& w, const Vector<Number>& place,
                    const Vector<Number>& direction) {
    using std::sqrt;
    Vector<Number> middle;
    for (std::size_t k = 0; k < 3; ++k) middle[k] = w.middle[k] - place[k];
    Number least(2);
    for (int side = 0; side < 4; ++side) {
        const Vector<Number>& out = side < 2 ? w.u : w.v;
        const Vector<Number>& edge = side < 2 ? w.v : w.u;
        const double sign = side % 2 == 0 ? 1 : -1;
        Vector<Number> on_edge;
        for (std::size_t k = 0; k < 3; ++k) on_edge[k] = middle[k] + sign * out[k];
        Vector<Number> normal;
        ceres::CrossProduct(on_edge.data(), edge.data(), normal.data());
        const auto along = [&](const Vector<Number>& v) {
            return ceres::DotProduct(normal.data(), v.data());
        };
        Number inside = along(direction) / sqrt(along(normal));
        if (along(middle) < 0.0) inside = -inside;
        if (inside < least) least = inside;
    }
    return least;
}

struct MissedEdge {
    const Frame& frame;
    EdgeSight sight;  ///< `from` relative to the place
    Vec3 place;
    double sigma;

    template <class Number>
    bool operator()(const Number* p, const Number* turn, Number* residual) const {
        const Number from_start[3] = {Number(sight.from.x), Number(sight.from.y),
                                      Number(sight.from.z)};
        const Number direction_start[3] = {Number(sight.direction.x), Number(sight.direction.y),
                                           Number(sight.direction.z)};
        Number from[3], direction[3];
        ceres::AngleAxisRotatePoint(turn, from_start, from);
        ceres::AngleAxisRotatePoint(turn, direction_start, direction);
        Vector<Number> at;
        for (int k = 0; k < 3; ++k)
            at[static_cast<std::size_t>(k)] = p[near] * (place[k] + from[k]);
        residual[0] =
            inside_edges(window_of(frame, p), at, {direction[0], direction[1], direction[2]}) /
            sigma;
        return true;
    }
};

MissedEdge missed_edge(const Frame& frame, const SeenOutline& outline, const EdgeSight& sight,
                       double sigma) {
    return {frame, {sight.from - outline.place, sight.direction}, outline.place, sigma};
}

struct TurnPrior {
    double sigma;
    template <class Number>
    bool operator()(const Number* turn, Number* residual) const {
        for (int k = 0; k < 3; ++k) residual[k] = turn[k] / sigma;
        return true;
    }
};

struct Solved {
    Parameters at{};
    double cost = std::numeric_limits<double>::infinity();
    double nearness_sigma = 0, tilt_sigma = 0;
    double residual = 0;
};

Solved solved(const Frame& frame, const std::vector<SeenOutline>& outlines, Parameters start,
              bool hold_nearness, bool facing) {
    Solved result;
    result.at = start;
    std::vector<std::array<double, 3>> turns(outlines.size(), {0, 0, 0});
    ceres::Problem problem;
    problem.AddParameterBlock(result.at.data(), parameter_count);
    // Wide bounds, only against windows without sides to fit: edge-on, wider than half the world,
    // or narrower than any pixel.
    for (const int k : {tilt_x, tilt_y}) {
        problem.SetParameterLowerBound(result.at.data(), k, -1.4);
        problem.SetParameterUpperBound(result.at.data(), k, 1.4);
    }
    for (const int k : {log_u, log_v}) {
        problem.SetParameterLowerBound(result.at.data(), k, -12);
        problem.SetParameterUpperBound(result.at.data(), k, 3);
    }
    std::vector<int> held;
    if (hold_nearness) held.push_back(near);
    if (facing) held.insert(held.end(), {tilt_x, tilt_y});
    if (!held.empty())
        problem.SetManifold(result.at.data(), new ceres::SubsetManifold(parameter_count, held));
    std::size_t sights = 0;
    for (std::size_t o = 0; o < outlines.size(); ++o) {
        double* turn = turns[o].data();
        problem.AddParameterBlock(turn, 3);
        if (o == 0 || outlines[o].turned_sigma <= 0) {
            problem.SetParameterBlockConstant(turn);
        } else {
            problem.AddResidualBlock(new ceres::AutoDiffCostFunction<TurnPrior, 3, 3>(
                                         new TurnPrior{outlines[o].turned_sigma}),
                                     nullptr, turn);
        }
        for (const EdgeSight& sight : outlines[o].sights) {
            problem.AddResidualBlock(
                new ceres::AutoDiffCostFunction<MissedEdge, 1, parameter_count, 3>(
                    new MissedEdge(missed_edge(frame, outlines[o], sight, outlines[o].sigma))),
                nullptr, result.at.data(), turn);
            ++sights;
        }
    }
    ceres::Solver::Options options;
    options.max_num_iterations = 100;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable()) return result;
    result.cost = summary.final_cost;

    double squares = 0, weighted = 0;
    for (std::size_t o = 0; o < outlines.size(); ++o) {
        for (const EdgeSight& sight : outlines[o].sights) {
            double missed = 0;
            missed_edge(frame, outlines[o], sight, 1.0)(result.at.data(), turns[o].data(), &missed);
            squares += missed * missed;
            weighted += missed * missed / (outlines[o].sigma * outlines[o].sigma);
        }
    }
    result.residual = std::sqrt(squares / static_cast<double>(sights));
    const double scale =
        std::sqrt(std::max(1.0, weighted / static_cast<double>(sights - parameter_count)));
    ceres::Covariance::Options settings;
    settings.algorithm_type = ceres::DENSE_SVD;
    settings.null_space_rank = -1;
    settings.num_threads = 1;
    ceres::Covariance covariance(settings);
    std::array<double, parameter_count * parameter_count> block{};
    const double unknown = std::numeric_limits<double>::infinity();
    result.nearness_sigma = result.tilt_sigma = unknown;
    const double* at = result.at.data();
    const std::vector<std::pair<const double*, const double*>> wanted{{at, at}};
    if (covariance.Compute(wanted, &problem) &&
        covariance.GetCovarianceBlock(at, at, block.data())) {
        const auto sigma = [&](int k) {
            return scale * std::sqrt(std::max(block[static_cast<std::size_t>(k) * parameter_count +
                                                    static_cast<std::size_t>(k)],
                                              0.0));
        };
        result.nearness_sigma = sigma(near);
        result.tilt_sigma = std::hypot(sigma(tilt_x), sigma(tilt_y));
    }
    return result;
}

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
    constexpr double k_eighth = std::numbers::pi / 4;
    const bool held = nearness.has_value();
    const std::vector<double> starts =
        held ? std::vector<double>{*nearness} : std::vector<double>{0.01, 0.05, 0.15, 0.4};

    Solved best;
    // Twice: the first solution gives the middle's direction, which becomes the frame's axis.
    for (int round = 0; round < 2; ++round) {
        if (round > 0) {
            const auto middle = window_of(frame, best.at.data()).middle;
            frame = Frame(glm::normalize(Vec3(middle[0], middle[1], middle[2])));
            best = Solved{};
        }
        for (const double from : starts) {
            for (const double turned_by : {0.0, k_eighth}) {
                const Solved one = solved(
                    frame, outlines, start_of(frame, outlines[0], from, turned_by), held, true);
                if (one.cost < best.cost) best = one;
            }
        }
        if (!std::isfinite(best.cost)) return std::nullopt;
    }
    bool facing = true;
    if (!held) {
        // Several starts, because from far away two tilts look alike.
        Solved tilted;
        for (const double from : starts) {
            for (const auto& [x, y] :
                 {std::array{0.0, 0.0}, {0.6, 0.0}, {-0.6, 0.0}, {0.0, 0.6}, {0.0, -0.6}}) {
                Parameters start = best.at;
                start[near] = from;
                start[tilt_x] = x;
                start[tilt_y] = y;
                const Solved one = solved(frame, outlines, start, false, false);
                if (one.cost < tilted.cost) tilted = one;
            }
        }
        if (tilted.cost <= best.cost && tilted.tilt_sigma < k_tilt_known) {
            best = tilted;
            facing = false;
        }
    }
    best = solved(frame, all, best.at, held, facing);
    if (!std::isfinite(best.cost)) return std::nullopt;
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
