#include "compare/study/study_advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace culet {

namespace {

// Each setting on the front must reduce the error at least by this factor.
constexpr double k_better = 0.98;

}  // namespace

std::vector<int> front_of(const SceneStudy& study) {
    std::vector<const StudiedRender*> order;
    for (const StudiedRender& render : study.renders) order.push_back(&render);
    std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
        return std::pair(a->cpu.median, a->claimed_error) <
               std::pair(b->cpu.median, b->claimed_error);
    });
    std::vector<int> front;
    double best = std::numeric_limits<double>::infinity();
    for (const StudiedRender* render : order) {
        if (!(render->claimed_error < k_better * best)) continue;
        best = render->claimed_error;
        front.push_back(render->id);
    }
    return front;
}

std::optional<int> cheapest_within(const SceneStudy& study, double tolerance) {
    const StudiedRender* best = nullptr;
    for (const StudiedRender& render : study.renders) {
        if (render.claimed_error > tolerance) continue;
        if (best == nullptr || render.cpu.median < best->cpu.median) best = &render;
    }
    return best == nullptr ? std::nullopt : std::optional(best->id);
}

std::vector<StudyAdvice> advice_of(const SceneStudy& study) {
    std::vector<StudyAdvice> all;
    for (const double tolerance : study.options.tolerances) {
        StudyAdvice advice;
        advice.tolerance = tolerance;
        advice.cheapest = cheapest_within(study, tolerance);
        for (const StudiedRender& render : study.renders) {
            if (render.automatic && render.settings.tolerance == tolerance)
                advice.automatic = render.id;
        }
        if (study.reference.noise.mean > tolerance) {
            advice.words = fmt::format(
                "tolerance {:g}: not decided, the reference itself may be off by {:.2g}", tolerance,
                study.reference.noise.mean);
        } else if (!advice.cheapest) {
            advice.words =
                fmt::format("tolerance {:g}: no setting that was drawn met it", tolerance);
        } else {
            const StudiedRender& best = study.render(*advice.cheapest);
            advice.words = fmt::format("for tolerance {:g} take {}: {:.3g} s, error {:.2g}",
                                       tolerance, best.words, best.cpu.median, best.claimed_error);
        }
        if (advice.automatic) {
            const StudiedRender& own = study.render(*advice.automatic);
            advice.automatic_meets = own.claimed_error <= tolerance;
            if (advice.cheapest) {
                advice.ratio = own.cpu.median / study.render(*advice.cheapest).cpu.median;
                advice.words += fmt::format(
                    "; automatic settings took {:.2f}x that{} {:.2g}", *advice.ratio,
                    advice.automatic_meets ? ", error" : " but missed it:", own.claimed_error);
            } else {
                advice.words += fmt::format("; automatic settings took {:.3g} s, error {:.2g}",
                                            own.cpu.median, own.claimed_error);
            }
        } else {
            advice.words += "; automatic settings took too long for this budget";
        }
        all.push_back(std::move(advice));
    }
    return all;
}

bool SceneStudy::usable() const {
    const double wanted = asked.tolerance > 0 ? asked.tolerance : 0.01;
    return reference.noise.mean <= wanted &&
           std::any_of(renders.begin(), renders.end(), [&](const StudiedRender& render) {
               return render.automatic && render.settings.tolerance == wanted;
           });
}

}  // namespace culet
