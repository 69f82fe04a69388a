#pragma once
// The kinds of failure in culet. An untrustworthy result (not converged, contradictory) is not a
// failure but has a status.

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace culet {

/// Wrong input. The message says in one line what was found, what was expected and what to do.
/// Caught once, in `main`; exit code 2.
class InputError : public std::runtime_error {
public:
    explicit InputError(const std::string& message) : std::runtime_error(message) {}
    /// `file: message`
    InputError(const std::filesystem::path& file, const std::string& message);
    /// `file:line: message`; lines count from 1.
    InputError(const std::filesystem::path& file, long line, const std::string& message);
};

/// A bug: an invariant of the program does not hold. Exit code 3.
class InternalError : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

/// The caller asked long work to stop. Exit code 130.
class Interrupted : public std::runtime_error {
public:
    Interrupted() : std::runtime_error("interrupted") {}
};

/// Makes foreign text safe for a terminal, on one line. Control characters (ASCII and C1) become
/// blanks. Characters that reorder or hide text, and invalid UTF-8, become `\u202e` and `\xff`; so
/// does everything beyond ASCII if `ascii`. Quoted text is cut at 120 characters and the whole at
/// 2000.
std::string for_terminal(std::string_view text, bool ascii = false);

/// Stays on in release builds.
inline void check(bool condition, const char* what) {
    if (!condition) throw InternalError(what);
}

}  // namespace culet
