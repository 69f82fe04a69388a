#pragma once
// The kinds of failure that culet knows. A result that should not be trusted (not converged,
// contradictory) is none of them: it is a status in the result.

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace culet {

/// The user's input is wrong: what was found, what was expected and what to do, in one line.
/// Caught once, in `main`; ends the program with exit code 2.
class InputError : public std::runtime_error {
public:
    explicit InputError(const std::string& message) : std::runtime_error(message) {}
    /// `file: message`
    InputError(const std::filesystem::path& file, const std::string& message);
    /// `file:line: message`; lines count from 1.
    InputError(const std::filesystem::path& file, long line, const std::string& message);
};

/// We were wrong: a condition that the program itself must keep does not hold. Exit code 3.
class InternalError : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

/// The caller asked long work to stop. Exit code 130.
class Interrupted : public std::runtime_error {
public:
    Interrupted() : std::runtime_error("interrupted") {}
};

/// Foreign text as one line that a terminal may be given: control characters (of ASCII and of
/// Unicode's C1) are blanks; characters that reorder or hide text, and bytes that are no UTF-8, are
/// written as `\u202e` and `\xff`, as is all beyond ASCII where `ascii` says that the terminal
/// shows no more. What stands in double quotes is shortened beyond 120 characters and the whole
/// beyond 2000.
std::string for_terminal(std::string_view text, bool ascii = false);

/// Throws InternalError with `what` unless `condition` holds. Stays on in release builds.
inline void check(bool condition, const char* what) {
    if (!condition) throw InternalError(what);
}

}  // namespace culet
