#pragma once
// The equations of a fit for the solver: incidences (a corner lies on a facet's plane), hinges (a
// corner stays below a neighbour facet) and readings, each as one row in the parameters.
// Private to the room: shows Eigen.

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "fit/model/equations.h"
#include "fit/model/fit_model.h"
#include "fit/model/jacobian_rows.h"
#include "fit/model/parameters.h"
#include "fit/solve/constants.h"

namespace culet {

/// How far a stage softens its constraints. Lengths in half diameters, angles in radians.
struct PenaltyScale {
    double incidence = 0;        ///< of exact incidences and exact readings; 0: they are hard
    double readings = 0;         ///< added to each reading's uncertainty (in quadrature)
    double hinge = 1e-4;         ///< sigma of a corner's height above a neighbour facet
    double held = k_held.sigma;  ///< sigma of a held corner about the level where it is held
    bool with_readings = true;   ///< false: fit only a convex stone with these meets, near the mesh
    bool with_hinges = true;
    bool with_priors = true;  ///< on the mesh's points, with `mesh_sigma`:
    double mesh_sigma = 0.4;  ///< a hand-made mesh may be off by up to 20 % of its width
};

/// A member of the active set: a corner held below a facet that it would otherwise pass.
struct ActiveCorner {
    int facet = -1, point = -1;
    bool operator==(const ActiveCorner&) const = default;
};

/// Whether each corner lies on the other's facet: they are the ends of one edge.
bool are_ends_of_one_edge(const FitModel& model, const ActiveCorner& one,
                          const ActiveCorner& other);

/// Two corners that share a caliper's jaw, and are level along its direction.
struct SharedContact {
    int one = -1, other = -1;
    Vec3 direction{0, 0, 0};
    int equation = -1, jaw = 0;  ///< index among the readings' equations
};

struct StepLinearisation {
    JacobianRows rows;  ///< incidences first, in the model's order
    Eigen::VectorXd prior_stiffness;
    double merit = 0;     ///< sum of squares of all soft terms, priors and hinges included
    double prior = 0;     ///< the priors' part of it
    double hard_sum = 0;  ///< sum of the absolute residuals of hard equations
    double chi2 = 0;      ///< of readings and soft meets, with their own uncertainties
    std::vector<ActiveCorner> holding;  ///< the held corners that have a row
    bool finite = true;
};

class Relaxation {
public:
    Relaxation(const FitModel& model, const Parameters& parameters);

    const FitModel& model() const { return model_; }
    const Parameters& parameters() const { return parameters_; }

    /// Selects the active branch of each non-smooth reading at this shape: which corners the
    /// caliper's jaws touch, which way upright facets lean. Later linearisations keep to it, so
    /// that they are smooth. A jaw that would alternate between two corners for ever rests on both:
    /// they share the contact and are held level. `meets_hold`: as in `reading_equations`.
    /// `outline`: the corners that the planes of a stone with split meets give; by default the
    /// mesh's.
    void select_branches(const Shape& shape, bool meets_hold,
                         std::shared_ptr<const Outline> outline = nullptr);
    const std::vector<SharedContact>& shared_contacts() const { return shared_contacts_; }
    /// For the minimum of an earlier fit: lets each touched corner share its jaw with those that
    /// are level with it.
    void share_level_corners(const Shape& shape);
    /// Whether each corner of a shared contact carries a positive part of its jaw's load, and
    /// together no more than all of it. Otherwise the jaw would rest on some of them only. Valid at
    /// a local minimum, where a shared contact's residual gives its Lagrange multiplier.
    bool contacts_hold(const Shape& shape) const;
    /// Forgets which corners the jaws have touched, before another search. `but`: the shared
    /// contacts at its start.
    void forget_contacts(std::vector<SharedContact> but = {}) {
        shared_contacts_ = std::move(but);
        left_.clear();
        begins_ = true;
    }

    /// One equation of a stage: formula = 0 within sqrt(variance).
    struct Term {
        enum class Kind { equation, held_corner, contact, hinge };
        Formula formula;
        double variance = 0;  ///< 0: exact
        Kind kind = Kind::equation;
        ActiveCorner corner{};                ///< of a held corner
        double chi2_weight = 0, scatter = 0;  ///< contribution to chi-square
    };
    /// Returns incidences, readings (one of those that symmetry makes equal), held corners,
    /// shared contacts and hinges, in this order, without hinges that are held already. The terms
    /// refer to this relaxation and to `penalty`, which must outlive them.
    std::vector<Term> terms(const PenaltyScale& penalty, const std::vector<ActiveCorner>& held = {},
                            const std::vector<ActiveCorner>& hinges = {}) const;

    /// Linearises the terms at a shape. Hinges have a row only where they are violated, because
    /// rows of zeros would only fill the matrix factors. A held corner has a row unless it
    /// lies below its level.
    StepLinearisation linearisation(const Shape& shape, const PenaltyScale& penalty,
                                    const std::vector<ActiveCorner>& held = {}) const;

    /// Residuals of the equations to be corrected: hard ones, shared contacts, and readings with a
    /// variance below `sharp`. They are indexed like the rows of a linearisation that holds these
    /// corners; all other residuals are zero.
    struct Missed {
        Eigen::VectorXd residuals;
        double worst = 0;  ///< of the hard equations
    };
    Missed missed(const Shape& shape, const PenaltyScale& penalty,
                  const std::vector<ActiveCorner>& holding, double sharp) const;
    /// The largest residual of incidences and other exact equations.
    double worst_hard(const Shape& shape) const;
    /// Corners above a neighbour facet, or less than `margin` below it.
    std::vector<ActiveCorner> above(const Shape& shape, double margin = 0) const;
    /// How many held corners bind; the two ends of an edge count once.
    int binding(const Shape& shape, const std::vector<ActiveCorner>& held) const;
    bool is_convex(const Shape& shape) const { return above(shape).empty(); }

    /// Numbers of soft equations (readings, soft meets), of exact ones, and of degrees of freedom
    /// that these leave, without the shifts that no reading sees.
    struct Counts {
        int soft = 0, hard = 0, free = 0;
    };
    Counts counts() const;
    /// Expected misfit of the true stone in such a stage: its merit without the priors.
    double expected_misfit(const PenaltyScale& penalty) const;
    Eigen::VectorXd metric() const;
    /// Facets so nearly upright (sine of the angle below `within`) that they may lean either way:
    /// the rows of `linearisation` that would then change, and how much larger they would be. A
    /// facet leans one way however often it was read, so readings of one facet that would turn to
    /// the same side are one ambiguity.
    struct SignAmbiguity {
        struct Turn {
            int row = -1;
            double shift = 0;
        };
        int facet = -1;
        std::vector<Turn> turns;
    };
    std::vector<SignAmbiguity> ambiguous(const Shape& shape, double within) const;
    /// The widths along level directions, if they alone determine the azimuth of the stone;
    /// otherwise none.
    struct Caliper {
        Vec3 direction{0, 0, 0};
        double value = 0, sigma = 0;
        const std::vector<int>* corners = nullptr;  ///< that its jaws may touch
    };
    std::vector<Caliper> calipers_that_tell_the_turn() const;

    /// The second-order terms of the Lagrangian: of incidences, which are bilinear, and of
    /// inclinations and edges. Without the latter, turning the whole stone would seem to change
    /// them.
    std::vector<SymmetricEntry> curvature(const Shape& shape,
                                          const Eigen::VectorXd& multipliers) const;

private:
    double height(const Shape& shape, int facet, int point) const;
    const std::vector<int>& corners_between_jaws(const Equation& caliper) const;
    void add_priors(const Shape& shape, const PenaltyScale& penalty,
                    const Parameters::TangentBasis& basis, StepLinearisation& sum) const;
    struct OrbitPair;
    const OrbitPair* hinge_of(const ActiveCorner& corner) const;
    bool binds(const Shape& shape, const ActiveCorner& held) const;

    const FitModel& model_;
    const Parameters& parameters_;
    // One facet and point of each orbit, and the size of the orbit.
    struct OrbitPair {
        int facet = -1, point = -1;
        double images = 1;
        int incidence = -1;  // index in the model's, or -1
    };
    std::vector<OrbitPair> incidences_, hinges_;
    std::vector<int> points_;          // all of them
    std::vector<Equation> equations_;  // of the readings, as chosen
    bool begins_ = true;               // nothing chosen since contacts were forgotten
    std::vector<SharedContact> shared_contacts_;
    // For each reading and jaw: the corners that it has left.
    std::map<std::pair<int, int>, std::vector<int>> left_;
};

}  // namespace culet
