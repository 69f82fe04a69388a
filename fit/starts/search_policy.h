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

}  // namespace culet
