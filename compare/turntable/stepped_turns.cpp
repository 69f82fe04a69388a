#include "compare/turntable/stepped_turns.h"

#include <algorithm>
#include <cmath>

#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

// Turntables wobble by a degree at most; a jump is a good part of a step, and more than that.
constexpr double k_jump_steps = 0.4, k_jump = radians(1.2);
// From the first picture of a run to the last: single ones may be off by half of it.
constexpr double k_even = radians(1.1);

// A run of pictures without a jump: from `begin` to before `end`.
struct Run {
    std::size_t begin = 0, end = 0;
    double mean(const std::vector<double>& values) const {
        double sum = 0;
        for (std::size_t k = begin; k < end; ++k) sum += values[k];
        return sum / double(end - begin);
    }
};

// By how much steps are larger than given, over all runs.
double slope(const std::vector<Run>& runs, const std::vector<double>& given,
             const std::vector<double>& off) {
    double products = 0, squares = 0;
    for (const Run& s : runs) {
        const double middle = s.mean(given), mean = s.mean(off);
        for (std::size_t k = s.begin; k < s.end; ++k) {
            products += (given[k] - middle) * (off[k] - mean);
            squares += (given[k] - middle) * (given[k] - middle);
        }
    }
    return squares > 0 ? products / squares : 0;
}

}  // namespace

SteppedTurns stepped_turns(const std::vector<double>& given, const std::vector<double>& found) {
    SteppedTurns result;
    std::vector<double> steps, off;
    for (std::size_t i = 0; i < given.size(); ++i) {
        off.push_back(found[i] - given[i]);
        if (i > 0) steps.push_back(given[i] - given[i - 1]);
    }
    if (steps.empty()) return result;
    const double step = upper_median(std::move(steps)),
                 least = std::max(k_jump_steps * std::abs(step), k_jump);
    std::vector<Run> runs{{0, 1}};
    for (std::size_t i = 1; i < given.size(); ++i) {
        if (std::abs(off[i] - off[i - 1]) > least) {
            result.jumps.push_back({i - 1, (off[i] - off[i - 1]) / step});
            runs.push_back({i, i});
        }
        runs.back().end = i + 1;
    }
    double longest = 0;
    for (const Run& s : runs)
        longest = std::max(longest, std::abs(given[s.end - 1] - given[s.begin]));
    if (const double more = slope(runs, given, off); std::abs(more) * longest > k_even)
        result.scale = 1 + more;
    else if (runs.size() == 1)
        return {given, 1, {}};
    for (std::size_t i = 0; i < given.size(); ++i) off[i] = found[i] - result.scale * given[i];
    for (const Run& s : runs) {
        for (std::size_t k = s.begin; k < s.end; ++k)
            result.turns.push_back(result.scale * given[k] + s.mean(off));
    }
    return result;
}

}  // namespace culet
