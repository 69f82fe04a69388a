#include "app/render/render_words.h"

#include <fmt/format.h>

#include <cmath>

#include "app/program/terminal.h"

namespace culet {

void print_accuracy(const RenderStats& stats, Check check, bool time_limited, bool quiet) {
    if (std::isnan(stats.error_bound) && check == Check::none) {
        say("not checked: the picture's error is unknown", quiet);
        return;
    }
    if (std::isnan(stats.error_bound)) {
        if (!time_limited) return;  // a note says why
        say("a rough picture of unknown error: a checked one takes more than about 10 s "
            "(--tolerance 0.2 draws it)",
            quiet);
        return;
    }
    if (!stats.allowed_tolerance) return;
    const bool finest = stats.error_bound <= RenderSettings().tolerance;
    say(fmt::format(
            "within {:.2g} of the mean radiance{}", stats.error_bound,
            finest ? std::string()
                   : fmt::format(", as fine as the usual time allows; --tolerance {:g} is finer",
                                 RenderSettings().tolerance)),
        quiet);
}

void say_all_about(const RenderStats& stats) {
    for (const EffectDecision& decision : stats.effects) {
        say(fmt::format("{:<14}{:<4} {}", name_of(decision.effect), decision.on ? "on" : "off",
                        decision.why),
            false);
    }
    say(fmt::format(
            "{} rays, {} beams in {:.2f} s; light not followed {:.2g}, light cut {:.2g}, error "
            "bound {:.2g} of the mean",
            stats.rays, stats.beams,
            stats.seconds_setup + stats.seconds_build + stats.seconds_shade + stats.seconds_check,
            stats.remainder, stats.cut, stats.error_bound),
        false);
}

void say_verified(const Verification& found, bool quiet) {
    say(fmt::format("measured error {:.2g} of the mean radiance at {} pixels (their own noise "
                    "{:.2g}), error bound {:.2g}",
                    found.measured, found.pixels, found.noise, found.bound),
        quiet);
    if (!found.holds()) say("the error bound does not hold", quiet);
}

}  // namespace culet
