#pragma once
// The numbers of the solver: unit, meaning, and where each comes from. Lengths are in half
// diameters, angles in radians, gains in chi-square. "corpus": bench/corpus_bench.cpp; numbers
// without a bench lie far between the two sizes that they tell apart. Private to the room.

#include <cstddef>

namespace culet {

/// What is left of hard equations after the last stage is rounding: not more than this. Exact
/// readings that miss by more contradict each other.
inline constexpr double k_hard_limit = 1e-12;

/// Stages by Ceres (relax.h).
struct StageConstants {
    /// Part of the cost: a stage that gains less in a step has led to the next one.
    double least_gain = 1e-3;
    /// Penalty scales: corners that lie so little below a neighbour facet may rise above it.
    /// Corpus: with 1, two of ten step cuts drawn wrong by 10 % were lost.
    double hinge_margin = 5;
    /// Radius of the first step. Corpus: none lost; with Ceres' own 1e4 one.
    double first_trust = 1e3;
    /// Penalty scales: a length is rounded off so far about zero, or its kink still shows.
    double kink_width = 3;
};
inline constexpr StageConstants k_stage;

/// The constrained Newton steps (constrained_newton.h).
struct NewtonConstants {
    /// Parameters that the readings hold to better than the mesh does are moved by all but this
    /// part of their way in each step; those that no reading holds do not move.
    double first_damping = 1e-2, least_damping = 1e-6;
    /// Half a unit is half the stone's radius: no linearisation holds so far.
    double longest = 0.2;
    /// Corrections of a step end where hard equations miss by less; sooner where the step is longer
    /// than `near`, and may not be the last. `met`: rounding, of sums of four products of numbers
    /// up to one.
    double far_from_met = 1e-13, near = 1e-3, met = 1e-15;
    /// Misses below this do not count against a step; meets that miss by more, all together, do not
    /// meet; and what is left in the end.
    double nearly_met = 1e-10, all_but_met = 1e-6, rounding = 1e-14;
    /// Of a long step the first corrections take little each; what one leaves, the next one takes.
    int most_corrections = 12;
    double correction_precision = 1e-3;
    /// Variance of equations that are corrected within a step: exact ones, held corners, readings
    /// sharper than rounding.
    double corrected_variance = 1e-15;
    /// Steps in a row that gain less than this part of chi-square, at the end.
    int quiet_steps = 2;
    double no_gain = 1e-8;
    /// After a Newton step so short the next would be gone in rounding.
    double short_step = 1e-7;
    /// The readings' branches: chosen again where a step gains less than `little`, no more than so
    /// often; those whose merits differ by less than this part are one (jaws that touch two corners
    /// at once change their mind about places a ten-millionth of a sigma apart).
    double little = 0.05;
    int most_branches = 12;
    double same_branch = 1e-7;
};
inline constexpr NewtonConstants k_newton;

/// The KKT solver (kkt_solver.h).
struct KktConstants {
    int refinements = 12;
    /// A refinement that leaves more than this part of what was left leads nowhere.
    double least_progress = 0.7;
    /// Larger solutions are those of a matrix that is singular but for rounding. Up to here their
    /// products with any entry, and sums of such, are numbers.
    double largest = 1e150;
    /// Variance that exact equations are factored with: far above rounding, far below that of
    /// anything that is read. The second one where exact equations are nearly one (of corners held
    /// where planes are nearly parallel), and that can be factored.
    double least_variance = 1e-9, least_variance_close = 1e-11;
    /// Measured, in multiplications of a factorisation: what finding the order of elimination, and
    /// the solutions that follow a factorisation, take of each row.
    double ordering_work = 2000, solving_work = 400;
};
inline constexpr KktConstants k_kkt;

/// Corners held below a neighbour facet (active_set.h).
struct HeldConstants {
    /// So far below: far above rounding, far below anything one could measure.
    double below = 1e-7;
    /// About so far: an edge that would turn over asks its two ends to be held, which one length of
    /// the edge can do but about.
    double sigma = 1e-8;
    /// And so far where that binds so tightly that meets give way. bench_fit, `times`: of tiered
    /// stones of 600 and 1000 facets, one of 586 found its stone so (9 s; not in 28 s without), and
    /// others needed one start less.
    double sigma_beside_meets = 1e-4;
    /// This near to their level they lie at it.
    double at_level = 1e-8;
    int most_rounds = 8;
    /// An edge this short has come down to nothing; one so long was drawn.
    double no_length = 1e-9, drawn = 1e-5;
    /// By which an edge that was not drawn so may cost more when it is held: two sigmas.
    double cost_of_an_edge = 4;
};
inline constexpr HeldConstants k_held;

/// Jaws of calipers, and the corners that they touch (relaxation.h, caliper_turn.h).
struct JawConstants {
    /// Corners that share a jaw are level to this.
    double contact_sigma = 1e-6;
    /// Level at the end of an earlier fit: as exactly as a turn can be found.
    double was_level = 1e-7;
    /// Of the force of a reading that is off by its sigma: with less a shared contact holds
    /// nothing, be it level by symmetry or on a level facet.
    double no_force = 1e-3;
    /// By how much a result may lie otherwise than it was fitted. Corners so far below the
    /// outermost are not touched within that; what differs by less than `level` is level.
    double turn_range_deg = 0.3, out_of_reach = 0.05, level = 1e-9;
};
inline constexpr JawConstants k_jaws;

/// Which way facets lean (sign_ambiguity.h).
struct SignConstants {
    /// Sine: facets that may lean either way at the end of a search.
    double nearly_upright = 0.1;
    /// Choices that are tried in a round, since what is promised is linear; rounds; multiplications
    /// after which no others are looked for (of a thousand facets, one end of which takes some 15
    /// s).
    std::size_t most_choices = 4;
    int most_rounds = 8;
    double most_work = 1.5e10;
    /// Ends whose chi-squares differ by less are one; a choice that promises less is not worth
    /// another round.
    double same_end = 1e-3, least_gain = 0.01;
    double damping = 1e-6;
    /// Of what one turn does to the others.
    double precision = 1e-4;
    /// A step this long in one of the parameters is no longer linear.
    double farthest = 0.5;
    /// Chains begin at each facet; of more than so many at those whose first turn costs least.
    std::size_t most_begins = 128;
};
inline constexpr SignConstants k_signs;

/// Elimination of equations (null_space.h).
struct NullSpaceConstants {
    /// What is left of an equation after substitution, relative to what went into it, when it only
    /// repeats others; and relative to what its rounding errors are in proportion to: fifty times
    /// the unit of rounding, as many terms as are added up.
    double repeats = 1e-10, rounding = 1e-14;
    /// A preferred column is taken when its entry is at least this part of the largest.
    double preferred = 0.1;
    /// Entries this much smaller than the largest of their sum are what cancellation leaves.
    double cancelled = 1e-15;
};
inline constexpr NullSpaceConstants k_null_space;

}  // namespace culet
