#include "app/terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>

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
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();

    // The line is wiped when the work lets go of it, so that the next message starts clean.
    ~LineState() {
        if (drawn) std::fputs("\r\033[K", stderr);
    }
};

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
            if (elapsed.count() > 1.0 && percent != line->last_percent) {
                line->last_percent = percent;
                line->drawn = true;
                fmt::print(stderr, "\r\033[K{} {:3d} %", line->what, percent);
                std::fflush(stderr);
            }
        }
        return !interrupted();
    };
}

void say(const std::string& line, bool quiet) {
    if (!quiet) fmt::print(stderr, "{}\n", line);
}

}  // namespace culet
