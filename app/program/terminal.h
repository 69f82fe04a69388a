#pragma once
// Output for a person at a terminal while culet works. All of it goes to stderr.

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "stone/progress/progress.h"

namespace culet {

/// Makes Ctrl-C ask long work to stop through Progress instead of killing the program.
void catch_interrupts();
bool interrupted();

/// A progress line for `what`, with the time left. It is drawn only when stderr is a terminal,
/// `quiet` is off and the work has taken over a second. It reacts to Ctrl-C in any case.
Progress progress_line(std::string what, bool quiet);

/// Its text after `seconds`: the share done and the time left at that rate; early on, the time
/// taken.
std::string progress_text(double fraction, double seconds);

/// Foreign text as one safe line for `stream` (for_terminal). ASCII on a terminal whose locale
/// (LC_ALL, LC_CTYPE, LANG) is not UTF-8; files and pipes get UTF-8.
std::string safe_for(std::FILE* stream, std::string_view text);

/// Prints lines for people on stdout and makes foreign text in them safe (safe_for).
void print_lines(std::string_view text);

/// Prints one line for people, unless `quiet`, and makes foreign text in it safe (safe_for).
void say(const std::string& line, bool quiet);

/// Prints the notes on reading a picture, one per line.
void say_notes(const std::string& picture, const std::vector<std::string>& notes, bool quiet);

}  // namespace culet
