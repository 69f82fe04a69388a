#include "fit/solve/turning.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "fit/model/orbits.h"
#include "fit/solve/caliper_misfit.h"
#include "fit/solve/sign_ambiguity.h"
#include "stone/units.h"

namespace culet {

namespace {

// Jaws change corners every few degrees. After half a turn a caliper reads the same.
constexpr double k_pace_deg = 0.1, k_any_turn_deg = 90;
// A stone is laid between the jaws by eye.
constexpr double k_laid_sigma_deg = 2;
// What it costs in chi-square to take the mesh for turned altogether: five sigmas.
constexpr double k_mesh_is_wrong = 25;
// Of chi-square, a sigma in one reading: of ends as good as each other the nearest is kept.
constexpr double k_turn_gain = 1;
// The calipers' variances in the model that does without them.
constexpr double k_loose = 1e4;
constexpr double k_turn_damping = 1e-6, k_turn_precision = 1e-11;
// Of the corners' places, from which the turn is taken that the loose calipers leave: sigmas a
// hundred times their own.
constexpr double k_place_precision = 1e-7;
// A step this long in one of the parameters is no longer linear.
constexpr double k_turn_longest = 0.5;
// More calipers than this say nothing new of the turn: so many of them are asked.
constexpr std::size_t k_most_calipers = 48;

using Caliper = Relaxation::Caliper;

// From the shape to where the mesh stands, about up (Kabsch 1976), and how surely: corners that are
// off by s each turn it by s / sqrt(sum of squared radii).
struct StandingMesh {
    double angle = 0, sigma = 0;

    double misfit(double turn) const {
        const double off = std::remainder(turn - angle, std::numbers::pi);
        return off == 0 ? 0 : std::min(off * off / (sigma * sigma), k_mesh_is_wrong);
    }
};
StandingMesh standing_of_mesh(const std::vector<Vec3>& points, const std::vector<Vec3>& mesh) {
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
    if (!(radii > 0)) return {0, radians(k_any_turn_deg)};
    const double off = std::max(0.0, radii + mesh_radii - 2 * std::hypot(east, north));
    const double by_corners = std::sqrt(off / (2 * double(points.size())) / radii);
    return {std::atan2(north, east), std::hypot(by_corners, radians(k_laid_sigma_deg))};
}

std::vector<Caliper> evenly_chosen(const std::vector<Caliper>& calipers) {
    std::vector<Caliper> some;
    for (std::size_t k = 0; k < k_most_calipers; ++k) {
        some.push_back(calipers[k * calipers.size() / k_most_calipers]);
    }
    return some;
}

// slope . (the corner's place), as a functional of the parameters.
void add_along(Eigen::VectorXd& functional, const Parameters::TangentBasis& tangent_basis,
               int point, const Vec3& slope) {
    const Parameters::Slots& slots = tangent_basis.points[std::size_t(point)];
    for (int k = 0; k < slots.count; ++k) {
        functional(slots.column + k) += glm::dot(slots.along[std::size_t(k)], slope);
    }
}

// How far all corners together turn about up and move, as functionals of the parameters.
struct Motions {
    Eigen::VectorXd turn;
    std::array<Eigen::VectorXd, 2> shift;  // in the mean
};
Motions motions_of(const Shape& shape, const Parameters::TangentBasis& tangent_basis,
                   const Eigen::VectorXd& none) {
    Motions motions{none, {none, none}};
    Vec3 mean(0);
    for (const Vec3& p : shape.points) mean += p / double(shape.points.size());
    for (std::size_t p = 0; p < shape.points.size(); ++p) {
        const int point = static_cast<int>(p);
        const double part = 1 / double(shape.points.size());
        const Vec3 out = shape.points[p] - mean;
        add_along(motions.turn, tangent_basis, point, {-out.y, out.x, 0});
        add_along(motions.shift[0], tangent_basis, point, Vec3{part, 0, 0});
        add_along(motions.shift[1], tangent_basis, point, Vec3{0, part, 0});
    }
    return motions;
}

// Their places, x then y, against the mean of all: nothing says where the stone as a whole lies.
Eigen::MatrixXd places_of(const std::vector<int>& touched,
                          const Parameters::TangentBasis& tangent_basis, const Motions& motions) {
    Eigen::MatrixXd places =
        Eigen::MatrixXd::Zero(motions.turn.size(), 2 * Eigen::Index(touched.size()));
    for (std::size_t k = 0; k < touched.size(); ++k) {
        for (const int axis : {0, 1}) {
            Eigen::VectorXd functional = -motions.shift[std::size_t(axis)];
            add_along(functional, tangent_basis, touched[k],
                      axis == 0 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
            places.col(2 * Eigen::Index(k) + axis) = functional;
        }
    }
    return places;
}

// Of these turns the one where calipers and mesh together say less than `limit`, and least.
struct Best {
    int pace = 0;
    CaliperMisfit misfit;
    double sum = 0;
};
Best best_turn(const std::vector<Caliper>& calipers, const Corners& corners,
               const StandingMesh& mesh, int from, int to, double limit) {
    const double pace = radians(k_pace_deg);
    Best best;
    for (int k = from; k <= to; ++k) {
        CaliperMisfit misfit = misfit_at(calipers, corners, k * pace, pace);
        const double sum = misfit.chi2 + mesh.misfit(k * pace);
        if (!(sum < limit)) continue;
        limit = sum;
        best = {k, std::move(misfit), sum};
    }
    return best;
}

// The equations with the calipers loosened: nothing says how the stone stands, and everything else
// stands still about up, or the model could turn by itself.
class Loosened {
public:
    // Small moves of all the unknowns against the motion that `turn` measures.
    Loosened(const KktSolver& solver, const JacobianRows& rows, const Eigen::VectorXd& turn)
        : solver_(solver), rows_(rows), turn_(turn) {
        const auto turned =
            solver.solve(turn, Eigen::VectorXd::Zero(rows.count()), k_turn_precision);
        if (!turned.good) return;
        turned_ = turned.unknowns;
        of_turn_ = turn.dot(turned_);
    }
    bool is_usable() const { return of_turn_ > 0; }

    // What the readings leave, and least of it.
    struct Left {
        Eigen::VectorXd step;
        double merit = 0;
        Eigen::VectorXd pulls;  // of the rows
    };
    // Where the rows' values are more by `shift`; none where no small step leads there.
    std::optional<Left> left_by(const Eigen::VectorXd& shift) const {
        const Eigen::VectorXd right = shift - rows_.residuals();
        const auto solved =
            solver_.solve(Eigen::VectorXd::Zero(turn_.size()), right, k_turn_precision);
        if (!solved.good) return std::nullopt;
        const double along = turn_.dot(solved.unknowns);
        Left left{solved.unknowns - turned_ * (along / of_turn_),
                  along * along / of_turn_ - right.dot(solved.forces), solved.forces};
        if (!(left.step.cwiseAbs().maxCoeff() < k_turn_longest)) return std::nullopt;
        return left;
    }
    // As the readings are meant, and where some facets lean the other way.
    std::vector<Left> ways_to_lean(const std::vector<Relaxation::Folded>& folded) const {
        const std::optional<Left> as_meant = left_by(Eigen::VectorXd::Zero(rows_.count()));
        if (!as_meant) return {};
        std::vector<Left> all{*as_meant};
        for (const Eigen::VectorXd& shift :
             better_sign_choices(folded, solver_, as_meant->pulls, k_most_leanings)) {
            if (std::optional<Left> left = left_by(shift)) all.push_back(std::move(*left));
        }
        return all;
    }

    // Of quantities (columns of `functionals`): the columns by which forces on them move the
    // unknowns, and their covariance.
    struct Spread {
        Eigen::MatrixXd moves, covariance;
    };
    std::optional<Spread> spread_of(const Eigen::MatrixXd& functionals) const {
        const auto solved = solver_.solve_all(functionals, Eigen::MatrixXd(), k_place_precision);
        if (!solved.good) return std::nullopt;
        const Eigen::VectorXd with_turn = functionals.transpose() * turned_;
        Spread spread{solved.unknowns - turned_ * (with_turn / of_turn_).transpose(), {}};
        spread.covariance = functionals.transpose() * spread.moves;
        return spread;
    }

private:
    const KktSolver& solver_;
    const JacobianRows& rows_;
    const Eigen::VectorXd& turn_;
    Eigen::VectorXd turned_;
    double of_turn_ = 0;
};

}  // namespace

double turn_off_the_mesh(const Relaxation& relaxation, const Shape& shape) {
    return standing_of_mesh(shape.points, relaxation.system().mesh_shape().points).misfit(0);
}

std::optional<Shape> turned_better(Relaxation& relaxation, KktSolver& solver, const Shape& shape,
                                   const PenaltyScale& penalty) {
    relaxation.forget_contacts();
    relaxation.choose(shape, penalty.incidence == 0);
    std::vector<Caliper> calipers = relaxation.calipers_that_tell_the_turn();
    if (calipers.size() < 2) return std::nullopt;
    StepLinearisation linearisation = relaxation.linearisation(shape, penalty);
    for (const Caliper& c : calipers) {
        linearisation.rows.variance[std::size_t(c.row)] *= k_loose;
    }
    if (!solver.factor(linearisation.rows,
                       linearisation.prior_stiffness + k_turn_damping * relaxation.metric())) {
        return std::nullopt;
    }
    if (calipers.size() > k_most_calipers) calipers = evenly_chosen(calipers);

    const Parameters& parameters = relaxation.parameters();
    const Parameters::TangentBasis tangent_basis = parameters.tangent_basis(shape);
    const Motions motions =
        motions_of(shape, tangent_basis, Eigen::VectorXd::Zero(parameters.size()));
    const Loosened loosened(solver, linearisation.rows, motions.turn);
    if (!loosened.is_usable()) return std::nullopt;
    const std::vector<Loosened::Left> ways =
        loosened.ways_to_lean(relaxation.folded(shape, k_nearly_upright));
    double least = std::numeric_limits<double>::infinity();
    for (const Loosened::Left& way : ways) least = std::min(least, way.merit);
    const StandingMesh mesh =
        standing_of_mesh(shape.points, relaxation.system().mesh_shape().points);
    const double now = linearisation.merit + mesh.misfit(0);
    if (!(now - least > k_turn_gain)) return std::nullopt;

    // At all turns that the mesh does not forbid.
    const double gain = now - least;
    const double range = gain > k_mesh_is_wrong
                             ? radians(k_any_turn_deg)
                             : std::min(mesh.sigma * std::sqrt(gain), radians(k_any_turn_deg));
    const double pace = radians(k_pace_deg);
    const int from = static_cast<int>(std::floor((mesh.angle - range) / pace)),
              to = static_cast<int>(std::ceil((mesh.angle + range) / pace));
    const auto moved_by = [&](const Eigen::VectorXd& s) {
        return parameters.retracted(shape, {s.data(), static_cast<std::size_t>(s.size())});
    };
    Corners corners;
    corners.column.assign(shape.points.size(), -1);
    for (const Loosened::Left& way : ways) {
        corners.places = moved_by(way.step).points;
        for (int k = from; k <= to; ++k) number_touched(calipers, k * pace, corners);
    }
    const auto spread = loosened.spread_of(places_of(corners.touched, tangent_basis, motions));
    if (!spread) return std::nullopt;
    corners.covariance = spread->covariance;
    Best best;
    const Loosened::Left* chosen = nullptr;
    double limit = now - k_turn_gain;
    for (const Loosened::Left& way : ways) {
        corners.places = moved_by(way.step).points;
        Best here = best_turn(calipers, corners, mesh, from, to, limit - way.merit);
        if (here.misfit.forces.size() == 0) continue;
        limit = way.merit + here.sum;
        best = std::move(here);
        chosen = &way;
    }
    if (!chosen) return std::nullopt;
    // Where it stands, too, jaws may be on corners between which no small step leads.
    const Eigen::VectorXd step = chosen->step + spread->moves * best.misfit.forces;
    if (!(step.cwiseAbs().maxCoeff() < k_turn_longest)) return std::nullopt;
    return turned_about_z(moved_by(step), best.pace * pace);
}

}  // namespace culet
