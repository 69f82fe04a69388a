#pragma once
// Constants of the solver: unit, meaning, and the bench they come from. Lengths are in half
// diameters, angles in radians, gains in chi-square. "corpus": bench/corpus_bench.cpp. A constant
// without a bench lies far between the two sizes that it separates. Private to the room.

#include <cstddef>

namespace culet {

/// Exact equations end at rounding: they miss by no more than this after the last stage. Exact
/// readings that miss by more contradict each other.
inline constexpr double k_hard_limit = 1e-12;

/// Stages by Ceres (relax.h).
struct StageConstants {
    /// A stage ends when a step gains less than this part of the cost.
    double least_gain = 1e-3;
    /// Corners that lie less than this many penalty scales below a neighbour facet take part,
    /// because they may rise above it. Corpus: with 1, two of ten step cuts drawn wrong by 10 %
    /// were lost.
    double hinge_margin = 5;
    /// Radius of the first trust region. Corpus: none lost; with Ceres' default of 1e4 one.
    double first_trust = 1e3;
    /// Penalty scales. A length is smoothed this far about zero; with less its kink still shows.
    double kink_width = 3;
};
inline constexpr StageConstants k_stage;

/// The constrained Newton steps (constrained_newton.h).
struct NewtonConstants {
    /// Damping of a step, relative to the metric: a parameter that the readings hold better than
    /// the mesh does moves by all but this part of its way; one that no reading holds does not
    /// move.
    double first_damping = 1e-2, least_damping = 1e-6;
    /// Factors of the damping after a step that gains, and after one that does not. A search whose
    /// damping exceeds `most_damping` gives up. After a change of branches the damping is at least
    /// `branch_damping`; above `stuck_damping` it is `first_damping` again. Not tuned.
    double damping_falls = 5, damping_rises = 10, most_damping = 1e8;
    double branch_damping = 1e-4, stuck_damping = 1;
    /// Longest step in any parameter. No linearisation holds over half the stone's radius (0.5).
    double longest = 0.2;
    /// After a step shorter than this in every parameter the next one is Newton's. Not tuned.
    double newton_length = 1e-2;
    /// Precision of a step, relative to the largest residual: `part_of_sigma` of the sharpest
    /// reading's sigma, between these bounds. Not tuned.
    double part_of_sigma = 0.01, finest = 1e-13, coarsest = 1e-7;
    /// Corrections of a step end when exact equations miss by less than `met` (rounding, of sums of
    /// four products of numbers up to one), or than `far_from_met` after a step longer than `near`,
    /// which is not the last.
    double far_from_met = 1e-13, near = 1e-3, met = 1e-15;
    /// Sums of residuals. Below `nearly_met` they do not count against a step; meets that miss by
    /// more than `all_but_met` do not meet; `rounding` is what may be left in the end.
    double nearly_met = 1e-10, all_but_met = 1e-6, rounding = 1e-14;
    /// What a sum of one above `nearly_met` adds to the merit: a step may not pay for readings with
    /// meets. Not tuned.
    double hard_weight = 1e6;
    /// A merit larger by less than `merit_part` of it and `merit_rise` is larger by rounding.
    double merit_part = 1e-12, merit_rise = 1e-9;
    /// Corrections of a step, and the relative precision of each: after a long step the first ones
    /// gain little, and what one leaves the next one takes.
    int most_corrections = 12;
    double correction_precision = 1e-3;
    /// Equations with a smaller variance are corrected within a step: exact ones, held corners, and
    /// readings sharper than rounding.
    double corrected_variance = 1e-15;
    /// The search ends after this many steps in a row that each gain less than the part `no_gain`
    /// of chi-square.
    int quiet_steps = 2;
    double no_gain = 1e-8;
    /// A step shorter than `no_step` in every parameter counts as one without gain. The search ends
    /// at one shorter than `lost_step` that does not gain: its gain is below rounding.
    double no_step = 1e-12, lost_step = 1e-9;
    /// The step after a Newton step this short would be lost in rounding.
    double short_step = 1e-7;
    /// The branches of non-smooth readings are chosen again when a step gains less than `little`,
    /// at most `most_branches` times. Branches whose merits differ by less than the part
    /// `same_branch` are one: jaws that touch two corners at once would alternate for ever between
    /// places a ten-millionth of a sigma apart.
    double little = 0.05;
    int most_branches = 12;
    double same_branch = 1e-7;
};
inline constexpr NewtonConstants k_newton;

/// The KKT solver (kkt_solver.h).
struct KktConstants {
    int refinements = 12;
    /// Refinement ends when it leaves more than this part of the residual.
    double least_progress = 0.7;
    /// Larger solutions come from a matrix that is singular but for rounding. Below, products with
    /// entries and sums of them do not overflow.
    double largest = 1e150;
    /// Variance that exact equations are factored with: far above rounding, far below any
    /// reading's. The second is for exact equations that nearly repeat each other (corners held
    /// where planes are nearly parallel), where it can be factored.
    double least_variance = 1e-9, least_variance_close = 1e-11;
    /// Work, in multiplications, of ordering the elimination and of the solutions after a
    /// factorisation, for each row (measured).
    double ordering_work = 2000, solving_work = 400;
};
inline constexpr KktConstants k_kkt;

/// Corners held below a neighbour facet (active_set.h).
struct HeldConstants {
    /// Corners are held this far below: far above rounding, far below anything measurable.
    double below = 1e-7;
    /// Sigma of where they are held. An edge that would turn over asks for its two ends to be held,
    /// and its one length cannot do both exactly.
    double sigma = 1e-8;
    /// The same, where that binds so tightly that meets give way. bench_fit, `times`: a tiered
    /// stone of 586 facets converges so in 9 s; without it, it does not in 28 s.
    double sigma_beside_meets = 1e-4;
    /// Corners this near to their level lie on it.
    double at_level = 1e-8;
    int most_rounds = 8;
    /// An edge shorter than `no_length` is degenerate; one longer than `drawn` was drawn.
    double no_length = 1e-9, drawn = 1e-5;
    /// Chi-square that holding an edge may cost which was not drawn degenerate: two sigmas.
    double cost_of_an_edge = 4;
};
inline constexpr HeldConstants k_held;

/// Jaws of calipers, and the corners that they touch (relaxation.h, caliper_turn.h).
struct JawConstants {
    /// Sigma to which corners that share a jaw are level.
    double contact_sigma = 1e-6;
    /// Corners this level at the end of an earlier fit share a jaw: a turn is found no more
    /// exactly.
    double was_level = 1e-7;
    /// A shared contact with a smaller Lagrange multiplier holds nothing: its corners are level by
    /// symmetry or on a level facet. In units of a reading that is off by its sigma.
    double least_multiplier = 1e-3;
    /// A result may be turned by `turn_range_deg` from where it was fitted. Corners that lie
    /// `out_of_reach` below the outermost are not touched within that; corners that differ by less
    /// than `level` are level.
    double turn_range_deg = 0.3, out_of_reach = 0.05, level = 1e-9;
};
inline constexpr JawConstants k_jaws;

/// Which way facets lean (sign_ambiguity.h).
struct SignConstants {
    /// Sine of the tilt up to which a facet may lean either way at the end of a search.
    double nearly_upright = 0.1;
    /// Choices that are tried in a round, because the gains are linear predictions; rounds;
    /// multiplications after which no others are tried (one minimum of a thousand facets takes some
    /// 15 s).
    std::size_t most_choices = 4;
    int most_rounds = 8;
    double most_work = 1.5e10;
    /// A choice may take the steps of a fit divided by this. bench_fit, `times`, 1000 facets:
    /// better choices took 16 to 28 of 100 steps, hopeless ones took all.
    int steps_divisor = 2;
    /// Minima whose chi-squares differ by less than `same_minimum` are one. A choice whose
    /// predicted gain is less than `least_gain` is not tried.
    double same_minimum = 1e-3, least_gain = 0.01;
    double damping = 1e-6;
    /// Relative precision of what turning one facet does to the others.
    double precision = 1e-4;
    /// A longer step, in any parameter, is not linear.
    double farthest = 0.5;
    /// Chains begin at each facet, or at this many whose first turn costs least.
    std::size_t most_begins = 128;
};
inline constexpr SignConstants k_signs;

/// Elimination of equations (null_space.h).
struct NullSpaceConstants {
    /// An equation repeats others if substitution leaves less than the part `repeats` of what went
    /// into it, or than `rounding` times the terms: fifty times the unit of rounding, as many terms
    /// as are added.
    double repeats = 1e-10, rounding = 1e-14;
    /// A preferred column is the pivot if its entry is at least this part of the largest.
    double preferred = 0.1;
    /// Entries smaller than this part of the largest term of their sum are cancellation.
    double cancelled = 1e-15;
};
inline constexpr NullSpaceConstants k_null_space;

}  // namespace culet
