#include "fit/starts/multistart.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "fit/model/enclosed.h"
#include "fit/starts/constants.h"
#include "fit/starts/penalty_continuation.h"
#include "fit/uncertainty/diagnostics.h"
#include "fit/uncertainty/statistics.h"

namespace culet {

namespace {

// The chi-square test. Counting gives bounds of the redundancy, which decide most cases at once;
// only between them is it computed.
bool agrees(const FitModel& model, const Candidate& candidate, int free, int counted,
            double significance) {
    if (model.meets().has_estimated_groups()) return true;
    const double chi2 = candidate.finished.chi2;
    const int least = counted - free + candidate.binding;
    if (chi2_tail(chi2, std::max(0, least)) > significance && counted > free) return true;
    if (!(chi2_tail(chi2, counted + candidate.binding) > significance)) return false;
    const Diagnosis d = diagnose(model, candidate.finished.shape, candidate.finished.outline,
                                 {.full = false, .binding = candidate.binding});
    // Readings with a total redundancy below one cannot contradict each other.
    return chi2_tail(d.chi2, std::max(1.0, d.dof)) > significance;
}

// A stone that did not converge still ranks first if it agrees better by more than the noise of
// chi-square. Degenerate edges cause such stalls.
auto rank(const Candidate& c, double handicap = 0) {
    const double chi2 = c.finished.chi2 + handicap;
    return std::make_tuple(!c.sound, !(c.finished.worst_hard < k_hard_limit),
                           c.finished.converged
                               ? chi2
                               : k_search.unconverged_part * chi2 + k_search.unconverged_noise);
}

// The starts after the first stages.
class Screening {
public:
    Screening(const FitModel& model, Relaxation& relaxation)
        : relaxation_(relaxation), starts_(model) {}

    bool mesh_is_good() const { return starts_.mesh_is_good(); }
    /// Returns the next plausible start; when there is none, the best of those set aside. Tries at
    /// most `most` starts.
    std::optional<Screened> next(int most, bool only_plausible, double& work,
                                 const Progress& progress) {
        while (static_cast<int>(waiting_.size()) < most) {
            std::optional<Start> start = starts_.next();
            if (!start) break;
            Screened found = screen(relaxation_, *start, progress);
            work += found.work;
            if (found.is_plausible) return found;
            waiting_.push_back(std::move(found));
        }
        if (waiting_.empty() || only_plausible) return std::nullopt;
        const auto best = std::min_element(
            waiting_.begin(), waiting_.end(),
            [](const Screened& a, const Screened& b) { return a.misfit < b.misfit; });
        Screened found = std::move(*best);
        waiting_.erase(best);
        return found;
    }

private:
    Relaxation& relaxation_;
    Starts starts_;
    std::vector<Screened> waiting_;
};

}  // namespace

Candidate finish_candidate(const FitModel& model, Relaxation& relaxation, const Shape& shape,
                           const ActiveSetOptions& options) {
    Candidate candidate;
    if (model.meets().splits) {
        candidate.finished = finish(model, shape, options.iterations);
        const Enclosed enclosed = enclosed_by(model, candidate.finished.shape);
        candidate.sound = enclosed.closed && enclosed.missing.empty();
        return candidate;
    }
    static_cast<ActiveSetFit&>(candidate) = fit_active_set(relaxation, shape, options);
    candidate.binding = relaxation.binding(candidate.finished.shape, candidate.held);
    candidate.sound = relaxation.is_convex(candidate.finished.shape) &&
                      volume(met_solid(model, candidate.finished.shape)) > 0;
    return candidate;
}

Multistart fit_from_starts(const FitModel& model, const FitOptions& options,
                           const Progress& progress) {
    const Parameters parameters = model.parameters();
    Relaxation relaxation(model, parameters);
    const Relaxation::Counts counts = relaxation.counts();
    const int counted = counts.soft, free = counts.free;

    Multistart result;
    Screening approaches(model, relaxation);
    std::vector<double> minima;
    int fruitless = 0, without_stone = 0;
    double& work = result.work;
    // One start of a large stone costs as much as all starts of a small one.
    const int facets = static_cast<int>(model.stone().solid.facets.size());
    const int most =
        std::min(options.starts, std::max(k_search.least_starts, k_search.most_facets / facets));
    const auto may_go_on = [&] {
        const bool found = result.best.sound;
        return result.starts < most &&
               (work < (found ? k_search.most_work : k_search.most_work_in_vain) ||
                result.starts < (found ? k_search.least_starts : k_search.least_starts_in_vain));
    };
    while (may_go_on()) {
        const double begin = 0.7 * result.starts / (result.starts + 1.0);
        const Progress part = [&](double fraction) {
            return !progress || progress(begin + (0.7 - begin) * fraction);
        };
        // Beside a stone that agrees, only plausible starts are worth the time.
        const bool only_plausible = result.best.agrees;
        const std::optional<Screened> rough =
            approaches.next(most - result.starts, only_plausible, work, part);
        if (!rough) break;
        const Continued continued = continue_penalties(relaxation, *rough, part);
        Candidate candidate =
            finish_candidate(model, relaxation, continued.shape,
                             {.iterations = options.iterations,
                              .hopeless = result.best.sound ? result.best.finished.chi2 : 1e300});
        candidate.start = rough->start;
        candidate.finished.iterations += continued.steps;
        without_stone += candidate.is_no_stone;
        work += continued.work + candidate.finished.work;
        const bool good = candidate.is_local_minimum();
        candidate.agrees = good && agrees(model, candidate, free, counted, options.significance);
        const double chi2 = candidate.finished.chi2;
        // A minimum that agrees poorly or has degenerate edges may not be the global one: try
        // others.
        const bool accept = candidate.agrees &&
                            candidate.cost_of_holding < k_search.cheap_holding &&
                            (model.meets().has_estimated_groups() ||
                             chi2_tail(chi2, std::max(1, counted - free + candidate.binding)) >
                                 k_minima.agrees_well);
        // Starts built from the topology are alike: with a bad mesh the first ones may all fail in
        // the same way.
        const bool again = good && (candidate.agrees || approaches.mesh_is_good()) &&
                           std::any_of(minima.begin(), minima.end(), [&](double other) {
                               return std::abs(other - chi2) < k_minima.same_chi2;
                           });
        if (good) minima.push_back(chi2);
        ++fruitless;
        // Undetermined directions stay as the earlier start has them: the mesh comes before the
        // others.
        if (result.starts++ == 0 || rank(candidate, k_minima.same_chi2) < rank(result.best)) {
            result.best = std::move(candidate);
            fruitless = 0;
        }
        // Contradictory readings contradict each other from every start.
        const bool tired =
            result.best.sound && result.best.finished.converged &&
            fruitless >= (result.best.agrees || approaches.mesh_is_good() ? k_search.patience_good
                                                                          : k_search.patience);
        if (without_stone == result.starts && without_stone >= k_search.patience_without_stone)
            break;
        // The same minimum twice is no accident, unless a better one was seen.
        if (accept || tired || (again && result.best.finished.chi2 > chi2 - k_minima.same_chi2))
            break;
    }
    return result;
}

}  // namespace culet
