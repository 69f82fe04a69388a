#pragma once
// The equations of a fit for the solver: incidences and hinges in closed form, readings by their
// formulas, each as one row in the parameters. Private to the room: shows Eigen.

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

/// How far a stage softens what will have to hold.
struct PenaltyScale {
    double incidence = 0;        ///< of exact incidences and exact readings; 0: they are hard
    double readings = 0;         ///< added to each reading's own uncertainty
    double hinge = 1e-4;         ///< by how much a corner may stand above a neighbour facet
    double held = k_held.sigma;  ///< by how much a held corner may stand off where it is held
    bool with_readings = true;   ///< false: only a convex stone of these meets, near the mesh
    bool with_hinges = true;
    bool with_priors = true;  ///< the mesh's points, as far as a hand-made mesh may be off:
    double mesh_sigma = 0.4;  ///< up to 20 % of its width
};

/// A corner held below a facet that it wanted to pass.
struct ActiveCorner {
    int facet = -1, point = -1;
    bool operator==(const ActiveCorner&) const = default;
};

/// Each corner lies on the other's facet: of the edge between the facets, or one that they cut.
bool are_ends_of_one_edge(const FitModel& model, const ActiveCorner& one,
                          const ActiveCorner& other);

/// Two corners that share a caliper's jaw, and are level along its direction.
struct SharedContact {
    int one = -1, other = -1;
    Vec3 direction{0, 0, 0};
    int equation = -1, jaw = 0;  ///< of the readings', as chosen
};

/// All equations at one shape.
struct StepLinearisation {
    JacobianRows rows;  ///< incidences first, in the model's order
    Eigen::VectorXd prior_stiffness;
    double merit = 0;     ///< sum of squares of all that is soft, priors and hinges included
    double prior = 0;     ///< the priors' part of it
    double hard_sum = 0;  ///< sum of sizes of what is left of hard equations
    double chi2 = 0;      ///< of readings and soft meets, at their own uncertainties
    std::vector<ActiveCorner> holding;  ///< those held corners that have a row
    bool finite = true;
};

class Relaxation {
public:
    Relaxation(const FitModel& model, const Parameters& parameters);

    const FitModel& model() const { return model_; }
    const Parameters& parameters() const { return parameters_; }

    /// Chooses what the readings mean at this shape: which corners the caliper's jaws touch, which
    /// way upright facets lean. Later linearisations keep to it, so that they are smooth.
    /// `meets_hold`: of `FitModel::reading_equations`.
    /// Where a jaw would change between two corners for ever, it rests on both: at the bottom of
    /// a kink the two are held level.
    /// `outline`: of a stone whose meets come apart, the corners that its planes give; the mesh's
    /// where none is given.
    void choose(const Shape& shape, bool meets_hold,
                std::shared_ptr<const Outline> outline = nullptr);
    const std::vector<SharedContact>& shared_contacts() const { return shared_contacts_; }
    /// At the end of an earlier fit jaws already rest on corners that are level: each shares its
    /// jaw with the one that is touched.
    void share_level_corners(const Shape& shape);
    /// Each corner of a shared contact carries a part of its jaw's force, and together no more than
    /// all of it: else the jaw would rather rest on some of them only. At an end, where what shared
    /// contacts miss by is their force.
    bool contacts_hold(const Shape& shape) const;
    /// Of another way there: which corners the jaws touched on it says nothing of this one; or of
    /// the end of a way, whose shared contacts are these.
    void forget_contacts(std::vector<SharedContact> but = {}) {
        shared_contacts_ = std::move(but);
        left_.clear();
        begins_ = true;
    }

    /// One equation of a stage: formula = 0, within the root of the variance.
    struct Term {
        enum class Kind { equation, held_corner, contact, hinge };
        Formula formula;
        double variance = 0;  ///< 0: it holds exactly
        Kind kind = Kind::equation;
        ActiveCorner corner{};                ///< of a held corner
        double chi2_weight = 0, scatter = 0;  ///< of what chi-square counts
    };
    /// In this order: incidences, readings (one of each orbit), corners that are held, contacts
    /// that share a jaw, and hinges, of which those that are held already are left out. The terms
    /// look at this relaxation and `penalty` as long as they are asked.
    std::vector<Term> terms(const PenaltyScale& penalty, const std::vector<ActiveCorner>& held = {},
                            const std::vector<ActiveCorner>& hinges = {}) const;

    /// The terms at a shape, as rows in the parameters, with the hinges that are positive there:
    /// one that says nothing would fill the factors all the same. A corner that is held has a row
    /// where it would rise, and none where nothing pulls it up.
    StepLinearisation linearisation(const Shape& shape, const PenaltyScale& penalty,
                                    const std::vector<ActiveCorner>& held = {}) const;

    /// By how much hard equations are missed, corners that share a jaw, and readings of no more
    /// variance than `sharp`: in the rows of a linearisation that holds these corners, zero in
    /// others.
    struct Missed {
        Eigen::VectorXd residuals;
        double worst = 0;  ///< of the hard ones
    };
    Missed missed(const Shape& shape, const PenaltyScale& penalty,
                  const std::vector<ActiveCorner>& holding, double sharp) const;
    /// By how much incidences and other equations that hold exactly are missed at most.
    double worst_hard(const Shape& shape) const;
    /// Positive hinges; with a margin those, too, that it would make positive.
    std::vector<ActiveCorner> above(const Shape& shape, double margin = 0) const;
    /// How many of the held corners lie where they are held, not lower; an edge's two ends are one.
    int binding(const Shape& shape, const std::vector<ActiveCorner>& held) const;
    bool is_convex(const Shape& shape) const { return above(shape).empty(); }

    /// Readings and soft meets; equations that hold exactly; and directions that these leave free,
    /// less the shifts that nothing sees.
    struct Counts {
        int soft = 0, hard = 0, free = 0;
    };
    Counts counts() const;
    /// What the true stone is expected to leave of such a stage's merit, but for its priors.
    double expected_misfit(const PenaltyScale& penalty) const;
    Eigen::VectorXd metric() const;
    /// Rows of `linearisation` that may as well mean another value, and by how much more that is:
    /// of facets within this sine of upright. However often a facet was read, it leans one way:
    /// readings of the same facet that would turn to the same side are one.
    struct SignAmbiguity {
        struct Turn {
            int row = -1;
            double shift = 0;
        };
        int facet = -1;
        std::vector<Turn> turns;
    };
    std::vector<SignAmbiguity> ambiguous(const Shape& shape, double within) const;
    /// How wide the stone is along level directions, where nothing else says how it stands about
    /// up; none where something does.
    struct Caliper {
        Vec3 direction{0, 0, 0};
        double value = 0, sigma = 0;
        const std::vector<int>* corners = nullptr;  ///< that its jaws may touch
    };
    std::vector<Caliper> calipers_that_tell_the_turn() const;

    /// Second derivatives of the Lagrangian: of the incidences, which are bilinear, and of
    /// inclinations and edges, without which a turn of the whole stone would seem to change them.
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
    // One facet and point of each orbit, and how many go with it.
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
    // Of each reading and jaw, the corners that it has left.
    std::map<std::pair<int, int>, std::vector<int>> left_;
};

}  // namespace culet
