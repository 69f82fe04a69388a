#include "fit/graded.h"

#include <algorithm>
#include <array>

#include "fit/leaning.h"
#include "stone/errors.h"

namespace culet {

namespace {

constexpr int k_most_steps = 40;
// Stages only have to lead to the next one.
constexpr double k_enough = 1e-3, k_step_precision = 1e-8;
// As long as incidences are this soft, facets within this sine of upright may turn out to look the
// other way.
constexpr double k_leaning_until = 0.005, k_may_lean = 0.6;
// Tilts that are kept move by nothing that counts.
constexpr double k_keep = 1e9;

struct Stage {
    double incidence, readings;
};
// Of the half diameter. From the schedule that brought 20 of 20 rough meshes home in trials.
constexpr std::array<Stage, 5> k_stages{
    {{0.1, 0.05}, {0.03, 0.02}, {0.01, 0.005}, {0.003, 0.0}, {0.001, 0.0}}};

Softness softness_of(const Stage& stage, bool with_readings) {
    Softness s;
    s.incidence = stage.incidence;
    s.readings = stage.readings;
    s.hinge = stage.incidence / 5;
    s.with_readings = with_readings;
    return s;
}

int solve_stage(Relaxation& relaxation, SaddleSolver& solver, Shape& shape,
                const Softness& softness, bool keep_normals, const Progress& progress,
                double fraction) {
    const Freedoms& freedoms = relaxation.freedoms();
    Eigen::VectorXd metric = relaxation.metric();
    Eigen::VectorXd kept = Eigen::VectorXd::Zero(metric.size());
    for (int i = 0; keep_normals && i < freedoms.size(); ++i) {
        if (freedoms.is_tilt(i)) kept(i) = k_keep;
    }
    relaxation.choose(shape);
    Sheet sheet = relaxation.sheet(shape, softness);
    double damping = 1e-3;
    int steps = 0;
    while (steps < k_most_steps) {
        if (progress && !progress(fraction)) throw Interrupted();
        ++steps;
        const bool factored =
            solver.factor(sheet.rows, sheet.prior_stiffness + kept + damping * metric);
        bool better = false;
        double gain = 0;
        if (factored) {
            const SaddleSolver::Solution s = solver.solve(
                -sheet.prior_gradient,
                -Eigen::Map<const Eigen::VectorXd>(sheet.rows.residual.data(),
                                                   Eigen::Index(sheet.rows.residual.size())),
                k_step_precision);
            if (s.good && s.unknowns.cwiseAbs().maxCoeff() < 10) {
                const Shape next = freedoms.moved(
                    shape, {s.unknowns.data(), static_cast<std::size_t>(s.unknowns.size())});
                Sheet there = relaxation.sheet(next, softness);
                if (there.finite && there.merit <= sheet.merit) {
                    better = true;
                    gain = sheet.merit - there.merit;
                    shape = next;
                    sheet = std::move(there);
                }
            }
        }
        if (better) {
            damping = std::max(1e-7, damping / 5);
            if (gain <= k_enough * sheet.merit) break;
        } else {
            damping *= 8;
            if (damping > 1e6) break;
        }
    }
    return steps;
}

}  // namespace

Graded graded_fit(Relaxation& relaxation, const Start& start, const Progress& progress) {
    Graded result;
    result.shape = relaxation.freedoms().symmetrised(start.shape);
    SaddleSolver solver;
    const auto run = [&](const Stage& stage, bool with_readings, bool keep, double fraction) {
        result.steps += solve_stage(relaxation, solver, result.shape,
                                    softness_of(stage, with_readings), keep, progress, fraction);
    };
    // First a convex stone with planar facets, whatever its size: lengths of edges that a rough
    // mesh has inside out would hold it there.
    const bool keep = start.keep_normals_at_first;
    if (!start.is_convex) run({0.03, 0.0}, false, keep, 0.05);
    result.shape = relaxation.freedoms().symmetrised(
        looking_as(relaxation.system(), std::move(result.shape), start.sides));
    if (keep) run({0.03, 0.02}, true, true, 0.08);
    double fraction = 0.1;
    for (const Stage& stage : k_stages) {
        run(stage, true, false, fraction);
        if (stage.incidence > k_leaning_until) {
            for (int round = 0; round < 3; ++round) {
                const auto other =
                    leaning_better(relaxation, result.shape, softness_of(stage, true), k_may_lean);
                if (!other) break;
                result.shape = relaxation.freedoms().symmetrised(*other);
                run(stage, true, false, fraction);
            }
        }
        fraction += 0.1;
    }
    result.convex = relaxation.is_convex(result.shape);
    return result;
}

}  // namespace culet
