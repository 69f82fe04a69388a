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

/// A progress line with the time left. It is drawn only if stderr is a terminal, not `quiet`, and
/// after a second of work; it always reacts to Ctrl-C.
Progress progress_line(std::string what, bool quiet);

/// The share done and the time left at that rate; early on, the time taken.
std::string progress_text(double fraction, double seconds);

/// Makes foreign text one safe line for `stream` (for_terminal): ASCII on a terminal whose locale
/// (LC_ALL, LC_CTYPE, LANG) is not UTF-8; files and pipes get UTF-8.
std::string safe_for(std::FILE* stream, std::string_view text);

/// Prints to stdout and makes foreign text safe (safe_for).
void print_lines(std::string_view text);

/// Prints one line, unless `quiet`, and makes foreign text safe (safe_for).
void say(const std::string& line, bool quiet);

void say_notes(const std::string& picture, const std::vector<std::string>& notes, bool quiet);

}  // namespace culet
