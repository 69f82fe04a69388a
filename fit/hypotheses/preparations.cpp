#include "fit/hypotheses/preparations.h"

#include <algorithm>
#include <optional>

#include "fit/findings/blunder.h"
#include "fit/hypotheses/unread_size.h"
#include "fit/readings/level_facets.h"

namespace culet {

namespace {

using RestoreResult = std::function<void(FitResult&)>;
// Changes the problem if it applies, and returns what undoes this in the result.
using Preparation = std::optional<RestoreResult> (*)(Problem&);

std::optional<RestoreResult> leave_level_azimuths_out(Problem& problem) {
    std::vector<std::size_t> left_out = meaningless_azimuths(problem.readings);
    if (left_out.empty()) return std::nullopt;
    std::vector<Reading> all = problem.readings;
    problem.readings = without(all, left_out);
    return [all = std::move(all), left_out = std::move(left_out)](FitResult& result) {
        mark_left_out(all, left_out, result);
    };
}

std::optional<RestoreResult> take_size_of_mesh(Problem& problem) {
    if (says_size(problem.readings)) return std::nullopt;
    problem.readings.push_back(size_of_mesh(problem.stone));
    return [size = problem.readings.back()](FitResult& result) { take_back_size(size, result); };
}

constexpr Preparation k_preparations[] = {leave_level_azimuths_out, take_size_of_mesh};

}  // namespace

std::vector<Reading> without(const std::vector<Reading>& readings,
                             const std::vector<std::size_t>& left_out) {
    std::vector<Reading> others;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        if (!std::binary_search(left_out.begin(), left_out.end(), i)) {
            others.push_back(readings[i]);
        }
    }
    return others;
}

Prepared prepared(Problem problem) {
    Prepared result{std::move(problem), {}};
    for (const Preparation prepare : k_preparations) {
        if (auto restored = prepare(result.problem)) {
            result.restored.insert(result.restored.begin(), std::move(*restored));
        }
    }
    return result;
}

}  // namespace culet
