#pragma once
// std::from_chars for floating point and std::bit_cast, which Emscripten's C++ library of Debian 12
// lacks. Included before every source (-include).

#include <bit>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <string>
#include <system_error>

namespace std {

/// The general format of [charconv.from.chars]: it refuses blanks, plus signs and hexadecimal
/// digits before the number, all of which strtod takes.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    const char* at = first;
    if (at != last && *at == '-') ++at;
    const bool is_number = at != last && ((*at >= '0' && *at <= '9') || *at == '.' || *at == 'i' ||
                                          *at == 'I' || *at == 'n' || *at == 'N');
    if (!is_number) return {first, errc::invalid_argument};
    const bool hexadecimal = last - at > 1 && at[0] == '0' && (at[1] == 'x' || at[1] == 'X');
    // strtod reads up to a zero byte.
    const string text(first, hexadecimal ? at + 1 : last);
    char* end = nullptr;
    errno = 0;
    const double number = strtod(text.c_str(), &end);
    if (end == text.c_str()) return {first, errc::invalid_argument};
    const char* const stop = first + (end - text.c_str());
    if (errno == ERANGE) return {stop, errc::result_out_of_range};
    value = number;
    return {stop, errc()};
}

#ifndef __cpp_lib_bit_cast
template <class To, class From>
constexpr To bit_cast(const From& from) {
    static_assert(sizeof(To) == sizeof(From));
    return __builtin_bit_cast(To, from);
}
#endif

}  // namespace std
