#pragma once
// How the search for a start goes on, and how its stages lead to the stone. Lengths are in half
// diameters, gains in chi-square. The corpus (bench/corpus_bench.cpp) shows what a change of these
// costs. Private to the room.

#include <array>
#include <cstddef>

namespace culet {

struct SearchPolicy {
    // Which starts are tried, and when the best of them is taken.

    /// Holding edges at no length may cost this much before another start is tried: less than a
    /// sigma of one reading.
    double cheap_holding = 1;
    /// The search ends after so many starts in a row without a better one; after `patience_good` if
    /// the best agrees with the readings or the mesh was drawn with care, because others end there
    /// too.
    int patience = 6, patience_good = 2;
    /// The search ends if this many starts, from the first, lead to nothing like a stone: no stone
    /// has these readings.
    int patience_without_stone = 5;
    /// Starts times facets that are tried, but never fewer starts than `least_starts`: a start of
    /// 300 facets takes seconds.
    int most_facets = 4500, least_starts = 4;
    /// Work of all starts together (KktSolver::work); less while none has led to a stone. Starts
    /// from readings that fit no stone take ten times as many steps as others. All starts of 105
    /// facets and noise of 20 % take up to 1e9, half a second.
    double most_work = 1.5e10, most_work_in_vain = 7e9;
    int least_starts_in_vain = 2;
    /// A stone that did not converge is preferred to another if it agrees better by more than this
    /// part of chi-square and two sigmas of one reading.
    double unconverged_part = 1.05, unconverged_noise = 4;

    // The stages: penalty continuation.

    struct Stage {
        double incidence, readings;  ///< PenaltyScale, in half diameters
    };
    /// Each about a third of the one before, so that a stage begins within the tolerance of the
    /// previous one. Trials: 20 of 20 rough meshes led to their stone.
    std::array<Stage, 6> stages{
        {{0.1, 0.05}, {0.03, 0.02}, {0.01, 0.005}, {0.003, 0.0}, {0.001, 0.0}, {0.0003, 0.0}}};
    /// Before them: without the readings, for starts that are not convex; with them, where normals
    /// are kept. Not tuned: soft as the second stage.
    Stage convex{0.03, 0.0}, kept_normals{0.03, 0.02};
    /// Hinges are this many times stiffer than incidences: corners rise above a facet last.
    double hinge_stiffness = 5;
    /// Steps of a stage, and of the first one, where a good start needs few.
    int most_steps = 40, first_steps = 15;
    /// While incidences are softer than `leaning_until`, facets within the sine `may_lean` of
    /// upright may still turn to the other side.
    double leaning_until = 0.005, may_lean = 0.6;
    /// Rounds of that after a stage, and sets of facets tried in each. Not tuned.
    int most_lean_rounds = 3;
    std::size_t sign_choices = 1;
    /// The misfit of a stage trades against nearness to the mesh: of a rough mesh, by about this
    /// part of what the priors leave. It only orders the starts.
    double traded = 0.2;
    /// Work of a step of a stage for each varied number, in multiplications (measured).
    double work_of_a_row = 7000;
    /// Progress shown during a start: in the steps above, in the first stage, while its facets turn
    /// over, and more with each later stage.
    double shown_convex = 0.05, shown_kept = 0.1, shown_first = 0.2, shown_signs = 0.25,
           shown_stage = 0.1;
};

inline constexpr SearchPolicy k_search;

/// Which way facets look, by the edges round them (closing_sides.h).
struct ClosingConstants {
    /// Chi-square of two numbers at a p-value of 0.001. A facet whose edges close better is left
    /// alone.
    double open = 13.8;
    /// Chi-square of one facet above which something else is wrong.
    double most_misfit = 50;
    /// A side is known if the other costs this much more: five sigmas.
    double known = 25;
    double least_gain = 1e-6;
    /// Turns in one chain: over all suspects, and growing from one facet.
    int chain = 60, local_chain = 14;
    /// A chain whose cost rises above this is given up.
    double highest = 200;
    int most_rounds = 100;
    /// Sigma of an edge that was not read, relative to its length: what a hand-made mesh is off by.
    double drawn_length = 0.3;
    /// Sine between planes below which their edge has no direction, and the sigma of that
    /// direction.
    double least_sine = 1e-9, any_direction = 1.5;
    /// Variance of exact lengths.
    double rounding = 1e-24;
};
inline constexpr ClosingConstants k_closing;

/// Robust losses (robust.h).
struct RobustConstants {
    /// Residuals in sigmas (Huber 1964; Holland & Welsch 1977).
    double huber = 1.345, cauchy = 2.385;
    int rounds = 40;
    /// Work in multiplications (KktSolver::work): some seconds. Large stones take few rounds.
    double most_work = 5e9;
    /// Least weight of a reading: that of a sigma a million times as large.
    double least_weight = 1e-12;
};
inline constexpr RobustConstants k_robust;

/// How well a mesh was drawn (starts.h).
struct DrawnConstants {
    /// A mesh was drawn with care if its corners lie this near to their facets' planes, and rise
    /// above neighbour facets by less than `nearly_convex` (root mean square over all corners and
    /// neighbours).
    double drawn_with_care = 0.02, nearly_convex = 0.005;
    /// The mesh tells a facet's side if its tilt there is nearer to one of the reading's two values
    /// by more than this many of its errors. Not tuned.
    double known_side = 6;
    /// A side that was read counts unless the facet may be upright within this many sigmas.
    double upright_sigmas = 3;
    /// The mesh tells length and width if its least stretch is above this part of the largest: a
    /// crushed one does not. Not tuned.
    double least_stretch = 0.15;
};
inline constexpr DrawnConstants k_drawn;

/// Local minima that starts lead to (multistart.h).
struct MinimumConstants {
    /// p-value above which the readings agree well.
    double agrees_well = 0.2;
    /// Minima whose chi-squares differ by less are one stone: a third of a sigma of one reading.
    double same_chi2 = 0.1;
};
inline constexpr MinimumConstants k_minima;

}  // namespace culet
