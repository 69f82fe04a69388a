#include "app/program/terminal.h"

#include <fmt/format.h>
#include <langinfo.h>
#include <locale.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <memory>

#include "stone/text/errors.h"

namespace culet {

namespace {

volatile std::sig_atomic_t interrupt_seen = 0;

extern "C" void note_interrupt(int) {
    interrupt_seen = 1;
}

struct LineState {
    std::string what;
    bool visible = false, drawn = false;
    std::string last;
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();

    // Wipes the line when the work ends, so that the next message starts on a clean line.
    ~LineState() {
        if (drawn) std::fputs("\r\033[K", stderr);
    }
};

}  // namespace

std::string progress_text(double fraction, double seconds) {
    // Too little is done to estimate.
    constexpr double k_least = 0.01;
    if (!(fraction >= k_least)) return fmt::format("{:.0f} s", seconds);
    const double left = seconds * (1 - fraction) / fraction;
    // Rounded to about two digits: more is not known, and would flicker.
    const double step = left < 20 ? 1 : left < 100 ? 5 : 10;
    return fmt::format("{:3.0f} %, about {:.0f} s left", 100 * fraction,
                       std::max(1.0, step * std::ceil(left / step)));
}

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
            std::string told = progress_text(fraction, elapsed.count());
            if (elapsed.count() > 1.0 && told != line->last) {
                line->drawn = true;
                fmt::print(stderr, "\r\033[K{} {}", line->what, told);
                std::fflush(stderr);
                line->last = std::move(told);
            }
        }
        return !interrupted();
    };
}

std::string safe_for(std::FILE* stream, std::string_view text) {
    static const bool utf8 = [] {
        const locale_t locale = newlocale(LC_CTYPE_MASK, "", locale_t{});
        if (locale == locale_t{}) return false;
        const std::string set = nl_langinfo_l(CODESET, locale);
        freelocale(locale);
        return set == "UTF-8";
    }();
    return for_terminal(text, !utf8 && isatty(fileno(stream)) != 0);
}

void print_lines(std::string_view text) {
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        fmt::print("{}\n", safe_for(stdout, text.substr(0, end)));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
}

void say(const std::string& line, bool quiet) {
    if (!quiet) fmt::print(stderr, "{}\n", safe_for(stderr, line));
}

void say_notes(const std::string& picture, const std::vector<std::string>& notes, bool quiet) {
    for (const std::string& note : notes) say(fmt::format("note: {}: {}", picture, note), quiet);
}

}  // namespace culet
