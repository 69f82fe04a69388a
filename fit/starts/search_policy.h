#pragma once
// How long the search for a start goes on, and how its stages lead to the stone. Private to the
// room. The corpus (bench/corpus_bench.cpp) tells what a change of these costs.

#include <array>

namespace culet {

struct SearchPolicy {
    // Which starts are tried, and when the best of them is taken.

    /// Chi-square that edges held at no length may cost before another start is asked: less than a
    /// sigma of one reading.
    double cheap_holding = 1;
    /// Starts in a row that gave nothing better before the search ends; good: the best agrees with
    /// the readings, or the mesh was drawn with care, and others would only end there again.
    int patience = 6, patience_good = 2;
    /// Starts in a row, from the first, that gave nothing like a stone: the readings are no
    /// stone's.
    int patience_without_stone = 5;
    /// Starts times facets that are tried, but no fewer starts than these: a start of 300 facets
    /// takes seconds.
    int most_facets = 4500, least_starts = 4;
    /// Of all starts together (KktSolver::work), and at least so many starts: those of readings
    /// that fit no stone take ten times as many steps each as others. The less while none gave a
    /// stone. All starts of 105 facets and noise of 20 % take up to 1e9, half a second.
    double most_work = 1.5e10, most_work_in_vain = 7e9;
    int least_starts_in_vain = 2;
    /// A stone whose last steps creep is the better one where it agrees better by more than
    /// chi-square's own noise: this part of it, and two sigmas of one reading.
    double creeping_part = 1.05, creeping_noise = 4;

    // The stages: penalty continuation.

    struct Stage {
        double incidence, readings;  ///< PenaltyScale, in half diameters
    };
    /// From the schedule that brought 20 of 20 rough meshes home in trials: a third each time, so
    /// that a stage begins within what the one before left open.
    std::array<Stage, 6> stages{
        {{0.1, 0.05}, {0.03, 0.02}, {0.01, 0.005}, {0.003, 0.0}, {0.001, 0.0}, {0.0003, 0.0}}};
    /// Hinges are as many times stiffer than incidences: corners rise above a facet last.
    double hinge_stiffness = 5;
    /// Steps of a stage; a good start takes fewer to find its place in the first one.
    int most_steps = 40, first_steps = 15;
    /// As long as incidences are this soft, facets within this sine of upright may turn out to look
    /// the other way.
    double leaning_until = 0.005, may_lean = 0.6;
    /// The best of a stage trades misfit for nearness to the mesh: of a rough mesh about this part
    /// of what the priors leave. It only decides which starts are finished first.
    double traded = 0.2;
    /// Measured, in multiplications: a step of a stage, for each number that is varied.
    double work_of_a_row = 7000;
};

inline constexpr SearchPolicy k_search;

/// Which way facets look, by the edges round them (closing_sides.h).
struct ClosingConstants {
    /// Sums of two squared normal errors exceed this once in a thousand times: where edges close
    /// better nothing is asked.
    double open = 13.8;
    /// Of one facet, in chi-square: beyond it something else is wrong.
    double most_misfit = 50;
    /// A side is known where the other costs five sigmas more.
    double known = 25;
    double least_gain = 1e-6;
    /// Turns in one chain, from everywhere and from one facet on.
    int chain = 60, local_chain = 14;
    /// Chains that cost so much in between lead nowhere.
    double highest = 200;
    int most_rounds = 100;
    /// What was not read is off by as much as a hand-made mesh is: a part of an edge's own length.
    double drawn_length = 0.3;
    /// An edge's direction is not known at all where its planes are this near to parallel.
    double least_sine = 1e-9, any_direction = 1.5;
    /// Variance of lengths that are exact.
    double rounding = 1e-24;
};
inline constexpr ClosingConstants k_closing;

/// Robust losses (robust.h).
struct RobustConstants {
    /// Of residuals in sigmas (Huber 1964; Holland & Welsch 1977).
    double huber = 1.345, cauchy = 2.385;
    int rounds = 40;
    /// In multiplications (KktSolver::work), some seconds: of large stones a few rounds have to do.
    double most_work = 5e9;
    /// A weight never goes to nothing: a sigma a million times as large says as much.
    double least_weight = 1e-12;
};
inline constexpr RobustConstants k_robust;

/// How well a mesh was drawn (starts.h).
struct DrawnConstants {
    /// A mesh whose corners lie within this part of the half diameter of their facets' planes was
    /// drawn with care, if those above a neighbour facet rise so little in the mean square over all
    /// corners and their neighbours.
    double drawn_with_care = 0.02, nearly_convex = 0.005;
};
inline constexpr DrawnConstants k_drawn;

/// Ends of starts (multistart.h).
struct EndConstants {
    /// Chance of so large a chi-square, from which on the readings agree well.
    double agrees_well = 0.2;
    /// Ends whose chi-squares differ by less are of one stone: a third of a sigma in one reading.
    double same_chi2 = 0.1;
};
inline constexpr EndConstants k_ends;

}  // namespace culet
