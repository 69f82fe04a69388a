#include "app/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>

#include "stone/errors.h"

namespace culet {

namespace {

volatile std::sig_atomic_t interrupt_seen = 0;

extern "C" void note_interrupt(int) {
    interrupt_seen = 1;
}

struct LineState {
    std::string what;
    bool visible = false, drawn = false;
    int last_percent = -1;
    double last_drawn = 0;  // seconds from the start
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();

    // The line is wiped when the work lets go of it, so that the next message starts clean.
    ~LineState() {
        if (drawn) std::fputs("\r\033[K", stderr);
    }
};

// From how long the work has lasted and how far it is. Early guesses are worthless, for work often
// begins faster than it goes on, and the last seconds need none.
std::string time_left(double elapsed, double fraction) {
    if (!(elapsed > 3 && fraction > 0.05 && fraction < 1)) return {};
    const double left = elapsed * (1 - fraction) / fraction;
    if (left < 1.5) return {};
    if (left < 90) return fmt::format(", about {:.0f} s left", left);
    if (left < 5400) return fmt::format(", about {:.0f} min left", left / 60);
    return fmt::format(", about {:.1f} h left", left / 3600);
}

}  // namespace

void catch_interrupts() {
    struct sigaction action {};
    action.sa_handler = note_interrupt;
    // A second Ctrl-C ends the program at once.
    action.sa_flags = SA_RESETHAND;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
}

bool interrupted() {
    return interrupt_seen != 0;
}

Progress progress_line(std::string what, bool quiet) {
    auto line = std::make_shared<LineState>();
    line->what = std::move(what);
    line->visible = !quiet && isatty(STDERR_FILENO) != 0;
    return [line](double fraction) {
        if (line->visible) {
            const std::chrono::duration<double> elapsed =
                std::chrono::steady_clock::now() - line->start;
            const int percent = static_cast<int>(100.0 * fraction);
            // Once a second at least while the work answers, for the time left runs on.
            const bool due =
                percent != line->last_percent || elapsed.count() > line->last_drawn + 1;
            if (elapsed.count() > 1.0 && due) {
                line->last_percent = percent;
                line->last_drawn = elapsed.count();
                line->drawn = true;
                fmt::print(stderr, "\r\033[K{} {:3d} %{}", line->what, percent,
                           time_left(elapsed.count(), fraction));
                std::fflush(stderr);
            }
        }
        return !interrupted();
    };
}

void say(const std::string& line, bool quiet) {
    if (!quiet) fmt::print(stderr, "{}\n", for_terminal(line));
}

}  // namespace culet
