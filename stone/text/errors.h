#pragma once
// The kinds of failure in culet. A result that should not be trusted (not converged, contradictory)
// is not a failure but a status in the result.

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace culet {

/// The user's input is wrong. The message says in one line what was found, what was expected and
/// what to do. Caught once, in `main`; exit code 2.
class InputError : public std::runtime_error {
public:
    explicit InputError(const std::string& message) : std::runtime_error(message) {}
    /// `file: message`
    InputError(const std::filesystem::path& file, const std::string& message);
    /// `file:line: message`; lines count from 1.
    InputError(const std::filesystem::path& file, long line, const std::string& message);
};

/// A bug: a condition that the program itself must keep does not hold. Exit code 3.
class InternalError : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

/// The caller asked long work to stop. Exit code 130.
class Interrupted : public std::runtime_error {
public:
    Interrupted() : std::runtime_error("interrupted") {}
};

/// Makes foreign text safe for a terminal, on one line. Control characters (of ASCII and of
/// Unicode's C1) become blanks. Characters that reorder or hide text, and bytes that are not UTF-8,
/// are written as `\u202e` and `\xff`; so is everything beyond ASCII if `ascii`. Text in double
/// quotes is cut at 120 characters and the whole at 2000.
std::string for_terminal(std::string_view text, bool ascii = false);

/// Throws InternalError with `what` unless `condition` holds, in release builds too.
inline void check(bool condition, const char* what) {
    if (!condition) throw InternalError(what);
}

}  // namespace culet
