// The error compared with the Cramer-Rao limit, with fewer and fewer readings.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fit/hypotheses/preparations.h"
#include "fit/study/parts.h"

namespace culet {

namespace {

// Parts of all readings that have a value. A last row has the fewest that determine the stone.
constexpr std::array k_shares{1.0, 0.9, 0.75, 0.625, 0.5, 0.375, 0.25, 0.1875, 0.125};
// Redundancies closer than this count as equal; then the order of the list decides.
constexpr double k_same_redundancy = 1e-6;

bool counts(const Reading& reading) {
    return !reading.exact && !is_relation(reading.kind);
}

int count(const std::vector<Reading>& readings) {
    return static_cast<int>(std::count_if(readings.begin(), readings.end(), counts));
}

// Indices of the `most` readings that the others already determine best, sorted.
std::vector<std::size_t> most_redundant(const std::vector<Reading>& readings,
                                        const FitResult& fitted, int most) {
    std::vector<std::size_t> order;
    for (std::size_t r = 0; r < readings.size(); ++r) {
        if (counts(readings[r]) && fitted.readings[r].redundancy > k_same_redundancy) {
            order.push_back(r);
        }
    }
    const auto rounded = [&](std::size_t r) {
        return std::llround(fitted.readings[r].redundancy / k_same_redundancy);
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return rounded(a) > rounded(b); });
    if (order.size() > static_cast<std::size_t>(most)) order.resize(static_cast<std::size_t>(most));
    std::sort(order.begin(), order.end());
    return order;
}

struct Selection {
    std::vector<Reading> readings;
    FitResult fitted;  // to their true values
    StudyLimit row;
    std::vector<StudyError> errors;  // of the draws
};

// Removes readings, a few at a time, the most redundant first, until `target` are left. False if
// the next would leave an undetermined parameter.
bool thin_out(const StudyTruth& truth, const FitOptions& options, int target,
              const StudyBudget& budget, Selection& selection) {
    while (count(selection.readings) > target) {
        const int now = count(selection.readings);
        int batch = std::min(now - target, std::max(1, now / 12));
        bool removed = false;
        for (; batch > 0 && !removed; batch /= 2) {
            if (budget.spent()) return false;
            const auto out = most_redundant(selection.readings, selection.fitted, batch);
            if (out.empty()) return false;
            Selection next{without(selection.readings, out), {}, {}, {}};
            next.fitted = fit_stone(truth.stone, next.readings, options);
            if (!is_sound(truth.stone, next.fitted) || next.fitted.statistics.rank_defect > 0) {
                continue;
            }
            selection = std::move(next);
            removed = true;
        }
        if (!removed) return false;
    }
    return true;
}

void measure(const StudyTruth& truth, const FitOptions& options, int draw, std::uint64_t seed,
             Selection& selection) {
    const std::vector<Reading> drawn = drawn_readings(truth.readings, seed, draw);
    std::vector<Reading> kept;
    // The same reading has the same error in every row.
    for (const Reading& reading : selection.readings) {
        const auto same = std::find_if(drawn.begin(), drawn.end(),
                                       [&](const Reading& d) { return d.id == reading.id; });
        kept.push_back(*same);
    }
    const FitResult fitted = fit_stone(truth.stone, kept, options);
    ++selection.row.draws;
    if (is_settled(truth.stone, fitted)) {
        selection.errors.push_back(error_of(truth, fitted));
    } else {
        ++selection.row.failed;
    }
}

void sum_up(const StudyTruth& truth, Selection& selection) {
    StudyLimit& row = selection.row;
    const std::vector<StudyError>& errors = selection.errors;
    row.readings = count(selection.readings);
    row.share = double(row.readings) / std::max(1, count(truth.readings));
    row.dof = selection.fitted.statistics.dof;
    const StudyError limit = limit_of(truth, selection.fitted), mean = mean_of(errors);
    row.angle_limit = std::sqrt(limit.angle);
    row.offset_limit = std::sqrt(limit.offset);
    if (errors.empty()) return;
    const double n = static_cast<double>(errors.size());
    row.angle_error = std::sqrt(mean.angle);
    row.offset_error = std::sqrt(mean.offset);
    if (!(row.angle_limit > 0)) return;
    row.ratio = row.angle_error / row.angle_limit;
    double scatter = 0;
    for (const StudyError& e : errors) scatter += (e.angle - mean.angle) * (e.angle - mean.angle);
    // d(sqrt m) = dm / (2 sqrt m)
    if (n > 1 && mean.angle > 0) {
        row.ratio_sigma = 0.5 * row.ratio * std::sqrt(scatter / (n - 1) / n) / mean.angle;
    }
}

}  // namespace

void study_limits(const Stone& stone, const FitResult& base, const StudyTruth& truth,
                  StudyBudget& budget, Study& study) {
    // Soft meets and symmetries are observations too, but cannot be drawn anew: they are exact
    // here.
    FitOptions options = study.options.fit;
    std::vector<Reading> readings = truth.readings;
    const auto treat_exact = [&](MeetTreatment& meets) {
        if (meets == MeetTreatment::exact) return;
        meets = MeetTreatment::exact;
        study.limit_made_exact = true;
    };
    treat_exact(options.meets);
    // So is the prior, so it is off: it is centred on the truth in every draw, and errors would
    // come out below a limit that counts it.
    const bool supposed = options.prior.source != Prior::Source::none;
    options.prior.source = Prior::Source::none;
    for (Reading& reading : readings) {
        if (!is_relation(reading.kind) || reading.exact || reading.released) continue;
        reading.exact = true;
        study.limit_made_exact = true;
    }
    const FitResult ideal =
        study.limit_made_exact || supposed ? fit_stone(stone, readings, options) : base;
    if (!is_sound(stone, ideal)) {
        study.limit_message =
            fmt::format("no stone with exact meets and symmetries was found: {}", ideal.message);
        return;
    }
    if (ideal.statistics.rank_defect > 0) {
        study.limit_message =
            "the readings do not determine the stone: there is no limit to compare with";
        return;
    }
    const StudyTruth right = truth_of(stone, readings, ideal, true);
    // Starts at the optimum of the truth, so that no other start is tried.
    options.start = right.stone.solid;
    Selection now{right.readings, fit_stone(right.stone, right.readings, options), {}, {}};
    const int all = count(right.readings);
    if (all == 0) {
        study.limit_message = "no reading has an uncertainty";
        return;
    }

    // The order of removal needs no noise, so all selections are made before any draw.
    std::vector<Selection> selections;
    bool more = true;
    for (std::size_t s = 0; s <= k_shares.size() && more && !budget.spent(); ++s) {
        const int target =
            s < k_shares.size() ? static_cast<int>(std::lround(k_shares[s] * all)) : 0;
        more = thin_out(right, options, target, budget, now);
        const int left = count(now.readings);
        if (selections.empty() || left < count(selections.back().readings)) {
            selections.push_back(now);
        }
        budget.report(0.5 + 0.2 * double(s) / double(k_shares.size()));
    }
    if (!more && !budget.spent()) {
        study.limit_message = fmt::format("fewer than {} readings leave parts of the stone open",
                                          count(selections.back().readings));
    }
    for (int draw = 0; draw < study.options.draws; ++draw) {
        for (std::size_t s = 0; s < selections.size(); ++s) {
            if (budget.spent()) continue;
            measure(right, options, draw, study.options.seed, selections[s]);
            budget.report(0.7 + 0.3 * (draw + double(s) / double(selections.size())) /
                                    study.options.draws);
        }
    }
    for (Selection& selection : selections) {
        sum_up(right, selection);
        if (selection.row.draws > 0) {
            study.limits.push_back(selection.row);
        } else {
            study.left_out.push_back(fmt::format("limit with {} readings", selection.row.readings));
        }
    }
}

}  // namespace culet
