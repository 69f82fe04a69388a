#include "refine/spin/series_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "compare/turntable/flat_ground.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr double k_whole_step = 0.75;  // of a step: less is a wobble
constexpr std::size_t k_least_side = 4;
// Pixels. Outlines of a still stone disagree by one or two; wild ones are clipped.
constexpr double k_most_gap = 15, k_slip_px = 1.5, k_slip_times = 1.5;
// What is left within the two parts, if the stone slipped: of the residual of all, and pixels.
constexpr double k_slip_part = 0.4, k_slip_rest = 2.5;

void say_steps(const SteppedTurns& turns, double step, const std::vector<std::string>& names,
               SeriesFaults& faults) {
    if (turns.scale != 1)
        faults.notes.push_back(fmt::format("the steps are {:.2f} degrees, not {:.2f}",
                                           degrees(std::abs(step * turns.scale)),
                                           degrees(std::abs(step))));
    for (const TurnJump& jump : turns.jumps) {
        const std::string &one = names[jump.before], &next = names[jump.before + 1];
        const double steps = std::round(jump.steps);
        if (jump.steps > k_whole_step)
            faults.notes.push_back(fmt::format("{:.0f} step{} missing between {} and {}", steps,
                                               steps > 1 ? "s are" : " is", one, next));
        else if (jump.steps < -k_whole_step)
            faults.notes.push_back(
                fmt::format("the stone did not turn on between {} and {}", one, next));
    }
}

// The first picture behind the place where outlines before and behind disagree most.
std::optional<std::size_t> most_likely_slip(const Tangency& found) {
    std::optional<std::size_t> best;
    double most = 0;
    for (std::size_t at = k_least_side; at + k_least_side <= found.turns.size(); ++at) {
        double across = 0, within = 0, crossing = 1e-9, others = 1e-9;
        for (const TangentGap& gap : found.gaps) {
            const bool crosses = gap.one < at && gap.other >= at;
            const double px = std::min(std::abs(gap.px), k_most_gap);
            (crosses ? across : within) += px;
            ++(crosses ? crossing : others);
        }
        across /= crossing;
        within /= others;
        if (across < k_slip_px || across < k_slip_times * within || across - within <= most)
            continue;
        most = across - within;
        best = at;
    }
    return best;
}

// By themselves the two parts fit far better.
bool parts_agree(const Tangency& found, const TangencyOptions& options, std::size_t at,
                 const std::vector<CoarseOutline>& outlines) {
    const std::size_t all = outlines.size();
    for (const auto& [begin, end] : {std::pair(std::size_t{0}, at), std::pair(at, all)}) {
        std::vector<OutlineHull> hulls;
        std::vector<double> turns;
        for (std::size_t i = begin; i < end; ++i) {
            hulls.push_back({outlines[i].corners});
            turns.push_back(found.turns[i]);
        }
        const double rest = tangency_of(hulls, turns, options).residual_px;
        if (rest > k_slip_rest || rest > k_slip_part * found.residual_px) return false;
    }
    return true;
}

}  // namespace

SeriesFaults faults_of_series(const Tangency& found, const TangencyOptions& options, double step,
                              const std::vector<std::string>& names,
                              const std::vector<CoarseOutline>& outlines) {
    SeriesFaults faults;
    const auto slip = most_likely_slip(found);
    if (slip && parts_agree(found, options, *slip, outlines)) {
        faults.trouble = fmt::format("the stone slipped on the turntable between {} and {}",
                                     names[*slip - 1], names[*slip]);
        faults.remedy = fmt::format(
            "Give the frames before or behind alone, with --step {:.4f}, or photograph it anew",
            degrees(std::abs(step)));
    } else {
        say_steps(found.expected, step, names, faults);
    }
    return faults;
}

SeriesFaults cut_out(const std::vector<SpinFrame>& frames,
                     const std::vector<CoarseOutline>& outlines) {
    SeriesFaults faults;
    std::size_t flat = 0;
    for (std::size_t f = 0; f < frames.size(); ++f)
        flat += has_flat_ground(frames[f].picture, outlines[f].corners);
    if (2 * flat <= frames.size()) return faults;
    faults.trouble = fmt::format(
        "the ground of {} frames is one flat colour: it was cut out, and the stone's edges with it",
        flat);
    faults.remedy = "Give the frames as the camera wrote them";
    return faults;
}

}  // namespace culet
