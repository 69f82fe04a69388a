#include "fit/starts/penalty_continuation.h"

#include "fit/solve/relax.h"
#include "fit/solve/sign_ambiguity.h"
#include "fit/starts/constants.h"

namespace culet {

namespace {

using Stage = SearchPolicy::Stage;

PenaltyScale penalty_of(const Stage& stage, bool with_readings) {
    PenaltyScale s;
    s.incidence = stage.incidence;
    s.readings = stage.readings;
    s.hinge = stage.incidence / k_search.hinge_stiffness;
    s.with_readings = with_readings;
    return s;
}

struct StageRunner {
    Relaxation& relaxation;
    const Progress& progress;
    const std::vector<int>& sides;  ///< known ones stay
    KktSolver solver{};
    int steps = 0;
    double work = 0;

    struct Kind {
        bool with_readings = false, keep = false;
        int most_steps = k_search.most_steps;
    };
    void once(Shape& shape, const Stage& stage, Kind kind, double fraction) {
        relaxation.select_branches(shape, false);
        const int before = steps;
        shape = relax(relaxation, shape, penalty_of(stage, kind.with_readings),
                      {.keep_normals = kind.keep, .most_steps = kind.most_steps}, progress,
                      fraction, steps);
        work += k_search.work_of_a_row * (steps - before) * relaxation.parameters().size();
    }
    void stage(Shape& shape, const Stage& stage, double fraction) {
        once(shape, stage, {.with_readings = true}, fraction);
        resolve_signs(shape, stage, fraction);
    }
    void resolve_signs(Shape& shape, const Stage& stage, double fraction) {
        if (stage.incidence <= k_search.leaning_until) return;
        for (int round = 0; round < k_search.most_lean_rounds; ++round) {
            const std::vector<Shape> others =
                better_signs(relaxation, solver, shape, penalty_of(stage, true), k_search.may_lean,
                             k_search.sign_choices, sides);
            if (others.empty()) break;
            shape = relaxation.parameters().symmetrised(others.front());
            once(shape, stage, {.with_readings = true}, fraction);
        }
    }
};

}  // namespace

Screened screen(Relaxation& relaxation, const Start& start, const Progress& progress) {
    Screened result;
    result.start = start.name;
    result.sides = start.sides;
    result.shape = relaxation.parameters().symmetrised(start.shape);
    relaxation.forget_contacts();  // of another start
    StageRunner run{relaxation, progress, start.sides};
    // First fit a convex stone with planar facets, without the readings: lengths of edges that are
    // inside out in a rough mesh would keep them so.
    const bool keep = start.keep_normals_at_first;
    if (!start.is_convex)
        run.once(result.shape, k_search.convex, {.keep = keep}, k_search.shown_convex);
    result.shape = relaxation.parameters().symmetrised(
        looking_as(relaxation.model(), std::move(result.shape), start.sides));
    if (keep)
        run.once(result.shape, k_search.kept_normals, {.with_readings = true, .keep = true},
                 k_search.shown_kept);
    const auto judge = [&] {
        const PenaltyScale penalty = penalty_of(k_search.stages[result.stages], true);
        const StepLinearisation linearisation = relaxation.linearisation(result.shape, penalty);
        result.misfit = linearisation.merit - linearisation.prior;
        result.is_plausible = result.misfit <= relaxation.expected_misfit(penalty) +
                                                   k_search.traded * linearisation.prior;
    };
    run.once(result.shape, k_search.stages[0],
             {.with_readings = true, .most_steps = k_search.first_steps}, k_search.shown_first);
    judge();
    if (result.is_plausible) {
        run.resolve_signs(result.shape, k_search.stages[0], k_search.shown_signs);
        ++result.stages;
        run.stage(result.shape, k_search.stages[1], k_search.shown_first + k_search.shown_stage);
        judge();
        ++result.stages;
    }
    result.steps = run.steps;
    result.work = (run.work + run.solver.work());
    return result;
}

Continued continue_penalties(Relaxation& relaxation, const Screened& rough,
                             const Progress& progress) {
    Continued result;
    result.shape = rough.shape;
    relaxation.forget_contacts();
    StageRunner run{relaxation, progress, rough.sides};
    for (std::size_t i = rough.stages; i < k_search.stages.size(); ++i) {
        run.stage(result.shape, k_search.stages[i],
                  k_search.shown_first + k_search.shown_stage * double(i));
    }
    result.steps = rough.steps + run.steps;
    result.work = (run.work + run.solver.work());
    return result;
}

}  // namespace culet
