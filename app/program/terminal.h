#pragma once
// What a person at a terminal sees while culet works. All of it goes to stderr.

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "stone/progress/progress.h"

namespace culet {

/// Ctrl-C asks long work to stop through Progress instead of killing the program.
void catch_interrupts();
bool interrupted();

/// A progress line for `what`, with the time left: drawn only when stderr is a terminal, `quiet` is
/// off and the work has lasted over a second. It always answers Ctrl-C, terminal or not.
Progress progress_line(std::string what, bool quiet);

/// What it says after so many seconds: how much is done and how long the rest will take at that
/// pace; for the time being, how long it has taken.
std::string progress_text(double fraction, double seconds);

/// Foreign text as one line for `stream` (for_terminal): in ASCII on a terminal whose character
/// set, by the locale (LC_ALL, LC_CTYPE, LANG), is not UTF-8. Files and pipes get UTF-8.
std::string safe_for(std::FILE* stream, std::string_view text);

/// Lines for people on stdout; foreign text in them is made safe (safe_for).
void print_lines(std::string_view text);

/// One line for people, unless `quiet`; foreign text in it is made safe (safe_for).
void say(const std::string& line, bool quiet);

/// What was noted on reading a picture, a line each.
void say_notes(const std::string& picture, const std::vector<std::string>& notes, bool quiet);

}  // namespace culet
