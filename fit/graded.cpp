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
// Without readings: once all facets and hinges together miss by less than their softness.
constexpr double k_convex = 1;
// Of a sum of squares in units of the stage's own softness, by a step of less than this part of it.
constexpr double k_little = 0.01, k_part = 0.1;
// In how many rounds a step may find out which corners it has to stop.
constexpr int k_most_rounds = 4;
// As long as incidences are this soft, facets within this sine of upright may turn out to look the
// other way.
constexpr double k_leaning_until = 0.005, k_may_lean = 0.6;
// Tilts that are kept move by nothing that counts.
constexpr double k_keep = 1e9;

struct Stage {
    double incidence, readings;
};
// Of the half diameter. From the schedule that brought 20 of 20 rough meshes home in trials.
constexpr std::array<Stage, 6> k_stages{
    {{0.1, 0.05}, {0.03, 0.02}, {0.01, 0.005}, {0.003, 0.0}, {0.001, 0.0}, {0.0003, 0.0}}};

// The best of a stage trades misfit for nearness to the mesh: of a rough mesh about this part of
// what the priors leave. It only decides which starts are finished first.
constexpr double k_traded = 0.2;
// A good start takes fewer to find its place in the first stage.
constexpr int k_first_steps = 15;

Softness softness_of(const Stage& stage, bool with_readings) {
    Softness s;
    s.incidence = stage.incidence;
    s.readings = stage.readings;
    s.hinge = stage.incidence / 5;
    s.with_readings = with_readings;
    return s;
}

int solve_stage(Relaxation& relaxation, KktSolver& solver, Shape& shape,
                const Softness& softness, bool keep_normals, int most_steps,
                const Progress& progress, double fraction) {
    const Freedoms& freedoms = relaxation.freedoms();
    Eigen::VectorXd metric = relaxation.metric();
    Eigen::VectorXd kept = Eigen::VectorXd::Zero(metric.size());
    for (int i = 0; keep_normals && i < freedoms.size(); ++i) {
        if (freedoms.is_tilt(i)) kept(i) = k_keep;
    }
    relaxation.choose(shape, false);
    Sheet sheet = relaxation.sheet(shape, softness);
    // Coarser than the readings are: what is small to the stage is for a later one to do.
    const bool is_coarse = relaxation.expected_misfit(softness) < 0.5 * relaxation.counts().soft;
    double damping = 1e-3;
    int steps = 0;
    while (steps < most_steps && (softness.with_readings || sheet.merit - sheet.prior > k_convex)) {
        if (progress && !progress(fraction)) throw Interrupted();
        ++steps;
        bool better = false, enough = false;
        std::vector<int> pressed = sheet.above;
        for (int round = 0; round < k_most_rounds && !better; ++round) {
            if (!solver.factor(sheet.rows, sheet.prior_stiffness + kept + damping * metric)) break;
            const KktSolver::Solution s =
                solver.solve(-sheet.prior_gradient, -sheet.rows.residuals(), k_step_precision);
            const double length = s.unknowns.cwiseAbs().maxCoeff();
            if (!s.good || !(length < 10)) break;
            const Eigen::VectorXd& step = s.unknowns;
            Shape next =
                freedoms.moved(shape, {step.data(), static_cast<std::size_t>(step.size())});
            Sheet there = relaxation.sheet(next, softness);
            if (!there.finite) break;
            if (there.merit <= sheet.merit) {
                better = true;
                const double little =
                    is_coarse && s.unknowns.cwiseAbs().maxCoeff() < k_part * softness.incidence
                        ? k_little
                        : 0;
                enough = sheet.merit - there.merit <= k_enough * sheet.merit + little;
                shape = std::move(next);
                sheet = std::move(there);
            } else if (there.above == pressed) {
                break;
            } else {
                pressed = std::move(there.above);
                sheet = relaxation.sheet(shape, softness, {}, &pressed);
            }
        }
        if (better) {
            damping = std::max(1e-7, damping / 5);
            if (enough) break;
        } else {
            damping *= 8;
            if (damping > 1e6) break;
            sheet = relaxation.sheet(shape, softness);
        }
    }
    return steps;
}

struct StageRunner {
    Relaxation& relaxation;
    const Progress& progress;
    const std::vector<int>& sides;  ///< known ones stay
    KktSolver solver{};
    int steps = 0;

    struct Kind {
        bool with_readings = false, keep = false;
        int most_steps = k_most_steps;
    };
    void once(Shape& shape, const Stage& stage, Kind kind, double fraction) {
        steps += solve_stage(relaxation, solver, shape,
                             softness_of(stage, kind.with_readings), kind.keep, kind.most_steps,
                             progress, fraction);
    }
    void stage(Shape& shape, const Stage& stage, double fraction) {
        once(shape, stage, {.with_readings = true}, fraction);
        let_lean(shape, stage, fraction);
    }
    void let_lean(Shape& shape, const Stage& stage, double fraction) {
        if (stage.incidence <= k_leaning_until) return;
        for (int round = 0; round < 3; ++round) {
            const std::vector<Shape> others =
                better_leanings(relaxation, solver, shape,
                                softness_of(stage, true), k_may_lean, 1, sides);
            if (others.empty()) break;
            shape = relaxation.freedoms().symmetrised(others.front());
            once(shape, stage, {.with_readings = true}, fraction);
        }
    }
};

}  // namespace

Approach approach(Relaxation& relaxation, const Start& start, const Progress& progress) {
    Approach result;
    result.start = start.name;
    result.sides = start.sides;
    result.shape = relaxation.freedoms().symmetrised(start.shape);
    relaxation.forget_ties();  // of another start
    StageRunner run{relaxation, progress, start.sides};
    // First a convex stone with planar facets, whatever its size: lengths of edges that a rough
    // mesh has inside out would hold it there.
    const bool keep = start.keep_normals_at_first;
    if (!start.is_convex) run.once(result.shape, {0.03, 0.0}, {.keep = keep}, 0.05);
    result.shape = relaxation.freedoms().symmetrised(
        looking_as(relaxation.system(), std::move(result.shape), start.sides));
    if (keep) run.once(result.shape, {0.03, 0.02}, {.with_readings = true, .keep = true}, 0.1);
    const auto judge = [&] {
        const Softness softness = softness_of(k_stages[result.stages], true);
        const Sheet sheet = relaxation.sheet(result.shape, softness);
        result.misfit = sheet.merit - sheet.prior;
        result.is_plausible =
            result.misfit <= relaxation.expected_misfit(softness) + k_traded * sheet.prior;
    };
    run.once(result.shape, k_stages[0], {.with_readings = true, .most_steps = k_first_steps}, 0.2);
    judge();
    if (result.is_plausible) {
        run.let_lean(result.shape, k_stages[0], 0.25);
        ++result.stages;
        run.stage(result.shape, k_stages[1], 0.3);
        judge();
        ++result.stages;
    }
    result.steps = run.steps;
    result.work = run.solver.work();
    return result;
}

Graded graded_fit(Relaxation& relaxation, const Approach& rough, const Progress& progress) {
    Graded result;
    result.shape = rough.shape;
    relaxation.forget_ties();
    StageRunner run{relaxation, progress, rough.sides};
    for (std::size_t i = rough.stages; i < k_stages.size(); ++i) {
        run.stage(result.shape, k_stages[i], 0.2 + 0.1 * double(i));
    }
    result.steps = rough.steps + run.steps;
    result.work = run.solver.work();
    return result;
}

}  // namespace culet
