#include "fit/turning.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "fit/orbits.h"
#include "stone/units.h"

namespace culet {

namespace {

// Jaws change corners every few degrees. After half a turn a caliper reads the same.
constexpr double k_pace_deg = 0.1, k_range_deg = 90;
// A stone is laid between the jaws by eye.
constexpr double k_laid_sigma_deg = 2;
// What it costs in chi-square to take the mesh for turned altogether: five sigmas.
constexpr double k_mesh_is_wrong = 25;
// Of chi-square, a sigma in one reading: of ends as good as each other the nearest is kept.
constexpr double k_least_gain = 1;
// The calipers' variances in the model that does without them.
constexpr double k_loose = 1e4;
constexpr double k_damping = 1e-6, k_precision = 1e-11;
// Of the corners' places, from which the turn is taken that the loose calipers leave: sigmas a
// hundred times their own.
constexpr double k_place_precision = 1e-7;
// A step this long in one of the freedoms is no longer linear.
constexpr double k_longest = 0.5;
// More calipers than this say nothing new of the turn: so many of them are asked.
constexpr std::size_t k_most_calipers = 48;
// In how many rounds it is settled which corners the jaws touch.
constexpr int k_most_rounds = 4;

// What the readings but the calipers leave of the corners, at this turn of the stone.
struct Corners {
    std::vector<Vec3> places;
    std::vector<Eigen::Index> column;  // of each corner in `covariance`, x then y; -1: not asked
    Eigen::MatrixXd covariance;

    double covariance_of(int one, const Vec3& u, int other, const Vec3& v) const {
        const Eigen::Index r = column[std::size_t(one)], c = column[std::size_t(other)];
        return u.x * (covariance(r, c) * v.x + covariance(r, c + 1) * v.y) +
               u.y * (covariance(r + 1, c) * v.x + covariance(r + 1, c + 1) * v.y);
    }
};

using Caliper = Relaxation::Caliper;

// From the shape to where the mesh stands, about up (Kabsch 1976), and how surely: corners that are
// off by s each turn it by s / sqrt(sum of squared radii).
struct Standing {
    double angle = 0, sigma = 0;

    double misfit(double turn) const {
        const double off = std::remainder(turn - angle, std::numbers::pi);
        return off == 0 ? 0 : std::min(off * off / (sigma * sigma), k_mesh_is_wrong);
    }
};
Standing standing_of_mesh(const std::vector<Vec3>& points, const std::vector<Vec3>& mesh) {
    Vec3 mean(0), mesh_mean(0);
    for (std::size_t p = 0; p < points.size(); ++p) {
        mean += points[p] / double(points.size());
        mesh_mean += mesh[p] / double(points.size());
    }
    double east = 0, north = 0, radii = 0, mesh_radii = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
        const Vec3 a = points[p] - mean, b = mesh[p] - mesh_mean;
        east += a.x * b.x + a.y * b.y;
        north += a.x * b.y - a.y * b.x;
        radii += a.x * a.x + a.y * a.y;
        mesh_radii += b.x * b.x + b.y * b.y;
    }
    if (!(radii > 0)) return {0, radians(k_range_deg)};
    const double off = std::max(0.0, radii + mesh_radii - 2 * std::hypot(east, north));
    const double by_corners = std::sqrt(off / (2 * double(points.size())) / radii);
    return {std::atan2(north, east), std::hypot(by_corners, radians(k_laid_sigma_deg))};
}

struct Jaws {
    int first = -1, second = -1;
    Vec3 direction{0, 0, 0};  // as the stone sees it
    bool operator==(const Jaws&) const = default;
};

// With corners at these places. Of those that were not asked none is touched, unless all may be.
std::vector<Jaws> jaws_at(const std::vector<Caliper>& calipers, const Corners& corners,
                          const std::vector<Vec3>& places, double angle, bool all_may_be) {
    std::vector<Jaws> all;
    const glm::dmat3 back = turn_about_z(-angle);
    for (const Caliper& caliper : calipers) {
        const Vec3 d = back * caliper.direction;
        Jaws jaws{-1, -1, d};
        double high = -1e300, low = 1e300;
        for (const int c : *caliper.corners) {
            if (!all_may_be && corners.column[std::size_t(c)] < 0) continue;
            const double at = glm::dot(places[std::size_t(c)], d);
            if (at > high) {
                high = at;
                jaws.first = c;
            }
            if (at < low) {
                low = at;
                jaws.second = c;
            }
        }
        all.push_back(jaws);
    }
    return all;
}

struct Misfit {
    double chi2 = 0;
    Eigen::VectorXd forces;
};

// With jaws on these corners, at this turn and a little around it.
Misfit misfit_of(const std::vector<Caliper>& calipers, const Corners& corners,
                 const std::vector<Jaws>& jaws, double around) {
    const auto count = static_cast<Eigen::Index>(calipers.size());
    Eigen::VectorXd off(count), slope(count);
    Eigen::MatrixXd covariance(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Jaws& a = jaws[std::size_t(i)];
        const Caliper& caliper = calipers[std::size_t(i)];
        const Vec3 between =
            corners.places[std::size_t(a.first)] - corners.places[std::size_t(a.second)];
        off(i) = glm::dot(a.direction, between) - caliper.value;
        slope(i) = glm::dot(Vec3{a.direction.y, -a.direction.x, 0}, between);
        for (Eigen::Index k = 0; k <= i; ++k) {
            const Jaws& b = jaws[std::size_t(k)];
            covariance(i, k) = covariance(k, i) =
                corners.covariance_of(a.first, a.direction, b.first, b.direction) -
                corners.covariance_of(a.first, a.direction, b.second, b.direction) -
                corners.covariance_of(a.second, a.direction, b.first, b.direction) +
                corners.covariance_of(a.second, a.direction, b.second, b.direction);
        }
        covariance(i, i) += caliper.sigma * caliper.sigma;
    }
    const Eigen::LDLT<Eigen::MatrixXd> factor(covariance);
    Misfit result;
    if (factor.info() != Eigen::Success || !factor.isPositive()) {
        result.chi2 = std::numeric_limits<double>::infinity();
        return result;
    }
    const double downhill = slope.dot(factor.solve(off)), bend = slope.dot(factor.solve(slope));
    const double move = bend > 0 ? std::clamp(-downhill / bend, -around, around) : 0;
    off += move * slope;
    const Eigen::VectorXd pull = factor.solve(off);
    result.chi2 = off.dot(pull);
    result.forces = Eigen::VectorXd::Zero(corners.covariance.cols());
    for (Eigen::Index i = 0; i < count; ++i) {
        const Jaws& j = jaws[std::size_t(i)];
        for (const int axis : {0, 1}) {
            const double force = pull(i) * j.direction[axis];
            result.forces(corners.column[std::size_t(j.first)] + axis) -= force;
            result.forces(corners.column[std::size_t(j.second)] + axis) += force;
        }
    }
    return result;
}

// At this turn, with the calipers' jaws where the stone that fits them best is widest: where that
// changes for ever, the larger of the two.
Misfit misfit_at(const std::vector<Caliper>& calipers, const Corners& corners, double angle,
                 double around) {
    std::vector<Jaws> jaws = jaws_at(calipers, corners, corners.places, angle, false);
    Misfit before;
    for (int round = 0; round < k_most_rounds; ++round) {
        Misfit misfit = misfit_of(calipers, corners, jaws, around);
        if (!std::isfinite(misfit.chi2)) return misfit;
        std::vector<Vec3> places = corners.places;
        const Eigen::VectorXd moved = corners.covariance * misfit.forces;
        for (std::size_t p = 0; p < places.size(); ++p) {
            if (corners.column[p] < 0) continue;
            places[p].x += moved(corners.column[p]);
            places[p].y += moved(corners.column[p] + 1);
        }
        std::vector<Jaws> next = jaws_at(calipers, corners, places, angle, false);
        if (next == jaws || (round + 1 == k_most_rounds && misfit.chi2 > before.chi2)) {
            return misfit;
        }
        before = std::move(misfit);
        jaws = std::move(next);
    }
    return before;
}

std::vector<Caliper> evenly_chosen(const std::vector<Caliper>& calipers) {
    std::vector<Caliper> some;
    for (std::size_t k = 0; k < k_most_calipers; ++k) {
        some.push_back(calipers[k * calipers.size() / k_most_calipers]);
    }
    return some;
}

// slope . (the corner's place), as a functional of the freedoms.
void add_along(Eigen::VectorXd& functional, const Freedoms::Chart& chart, int point,
               const Vec3& slope) {
    const Freedoms::Slots& slots = chart.points[std::size_t(point)];
    for (int k = 0; k < slots.count; ++k) {
        functional(slots.column + k) += glm::dot(slots.along[std::size_t(k)], slope);
    }
}

// How far all corners together turn about up and move, as functionals of the freedoms.
struct Motions {
    Eigen::VectorXd turn;
    std::array<Eigen::VectorXd, 2> shift;  // in the mean
};
Motions motions_of(const Shape& shape, const Freedoms::Chart& chart, const Eigen::VectorXd& none) {
    Motions motions{none, {none, none}};
    Vec3 mean(0);
    for (const Vec3& p : shape.points) mean += p / double(shape.points.size());
    for (std::size_t p = 0; p < shape.points.size(); ++p) {
        const int point = static_cast<int>(p);
        const double part = 1 / double(shape.points.size());
        const Vec3 out = shape.points[p] - mean;
        add_along(motions.turn, chart, point, {-out.y, out.x, 0});
        add_along(motions.shift[0], chart, point, Vec3{part, 0, 0});
        add_along(motions.shift[1], chart, point, Vec3{0, part, 0});
    }
    return motions;
}

// Corners that a jaw may touch at one of these turns get their columns in `corners`.
std::vector<int> number_touched(const std::vector<Caliper>& calipers, Corners& corners, int from,
                                int to) {
    std::vector<int> touched;
    for (int k = from; k <= to; ++k) {
        for (const Jaws& j :
             jaws_at(calipers, corners, corners.places, k * radians(k_pace_deg), true)) {
            for (const int corner : {j.first, j.second}) {
                if (corners.column[std::size_t(corner)] >= 0) continue;
                corners.column[std::size_t(corner)] = 2 * Eigen::Index(touched.size());
                touched.push_back(corner);
            }
        }
    }
    return touched;
}

// Their places, x then y, against the mean of all: nothing says where the stone as a whole lies.
Eigen::MatrixXd places_of(const std::vector<int>& touched, const Freedoms::Chart& chart,
                          const Motions& motions) {
    Eigen::MatrixXd places =
        Eigen::MatrixXd::Zero(motions.turn.size(), 2 * Eigen::Index(touched.size()));
    for (std::size_t k = 0; k < touched.size(); ++k) {
        for (const int axis : {0, 1}) {
            Eigen::VectorXd functional = -motions.shift[std::size_t(axis)];
            add_along(functional, chart, touched[k], axis == 0 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
            places.col(2 * Eigen::Index(k) + axis) = functional;
        }
    }
    return places;
}

// Of these turns the one where calipers and mesh together say less than `limit`, and least.
struct Best {
    int pace = 0;
    Misfit misfit;
};
Best best_turn(const std::vector<Caliper>& calipers, const Corners& corners, const Standing& mesh,
               int from, int to, double limit) {
    const double pace = radians(k_pace_deg);
    Best best;
    for (int k = from; k <= to; ++k) {
        Misfit misfit = misfit_at(calipers, corners, k * pace, pace);
        const double sum = misfit.chi2 + mesh.misfit(k * pace);
        if (!(sum < limit)) continue;
        limit = sum;
        best = {k, std::move(misfit)};
    }
    return best;
}

}  // namespace

double turn_off_the_mesh(const Relaxation& relaxation, const Shape& shape) {
    return standing_of_mesh(shape.points, relaxation.system().mesh_shape().points).misfit(0);
}

std::optional<Shape> turned_better(Relaxation& relaxation, SaddleSolver& solver, const Shape& shape,
                                   const Softness& softness) {
    relaxation.forget_ties();
    relaxation.choose(shape, softness.incidence == 0);
    std::vector<Caliper> calipers = relaxation.calipers_that_tell_the_turn();
    if (calipers.size() < 2) return std::nullopt;
    Sheet sheet = relaxation.sheet(shape, softness);
    for (const Caliper& c : calipers) {
        sheet.rows.variance[std::size_t(c.row)] *= k_loose;
    }
    if (!solver.factor(sheet.rows, sheet.prior_stiffness + k_damping * relaxation.metric())) {
        return std::nullopt;
    }
    if (calipers.size() > k_most_calipers) calipers = evenly_chosen(calipers);

    // Everything else stands still about up, or the model could turn by itself.
    const Freedoms& freedoms = relaxation.freedoms();
    const Freedoms::Chart chart = freedoms.chart(shape);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(freedoms.size());
    const Motions motions = motions_of(shape, chart, none);
    const Eigen::VectorXd& turn = motions.turn;
    const auto turned = solver.solve(turn, Eigen::VectorXd::Zero(sheet.rows.count()), k_precision);
    const auto moved = solver.solve(none, -sheet.rows.residuals(), k_precision);
    if (!turned.good || !moved.good) return std::nullopt;
    const double of_turn = turn.dot(turned.unknowns);
    if (!(of_turn > 0)) return std::nullopt;
    const double along_turn = turn.dot(moved.unknowns);
    Eigen::VectorXd step = moved.unknowns - turned.unknowns * (along_turn / of_turn);
    if (!(step.cwiseAbs().maxCoeff() < k_longest)) return std::nullopt;

    const auto moved_by = [&](const Eigen::VectorXd& s) {
        return freedoms.moved(shape, {s.data(), static_cast<std::size_t>(s.size())});
    };
    Corners corners;
    corners.places = moved_by(step).points;
    corners.column.assign(shape.points.size(), -1);
    const Standing mesh = standing_of_mesh(shape.points, relaxation.system().mesh_shape().points);
    // What the other readings leave at least; then at each turn the calipers.
    const double others =
        sheet.rows.residuals().dot(moved.forces) + along_turn * along_turn / of_turn;
    const double gain = sheet.merit + mesh.misfit(0) - others;
    if (!(gain > k_least_gain)) return std::nullopt;
    const double range = gain > k_mesh_is_wrong
                             ? radians(k_range_deg)
                             : std::min(mesh.sigma * std::sqrt(gain), radians(k_range_deg));
    const double pace = radians(k_pace_deg);
    const int from = static_cast<int>(std::floor((mesh.angle - range) / pace)),
              to = static_cast<int>(std::ceil((mesh.angle + range) / pace));
    const std::vector<int> touched = number_touched(calipers, corners, from, to);
    const Eigen::MatrixXd functionals = places_of(touched, chart, motions);
    const auto solved = solver.solve_all(functionals, Eigen::MatrixXd(), k_place_precision);
    if (!solved.good) return std::nullopt;
    const Eigen::VectorXd with_turn = functionals.transpose() * turned.unknowns;
    corners.covariance =
        functionals.transpose() * solved.unknowns - with_turn * with_turn.transpose() / of_turn;

    const Best best = best_turn(calipers, corners, mesh, from, to, gain - k_least_gain);
    // Where it stands, too, jaws may be on corners between which no small step leads.
    if (best.misfit.forces.size() == 0) return std::nullopt;
    step += solved.unknowns * best.misfit.forces -
            turned.unknowns * (with_turn.dot(best.misfit.forces) / of_turn);
    if (!(step.cwiseAbs().maxCoeff() < k_longest)) return std::nullopt;
    Shape result = moved_by(step);
    const glm::dmat3 by = turn_about_z(best.pace * pace);
    for (Vec3& n : result.normals) n = by * n;
    for (Vec3& p : result.points) p = by * p;
    return result;
}

}  // namespace culet
