#include "app/program/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "page/html.h"
#include "stone/text/errors.h"

namespace culet {

void add_common(CLI::App& command, CommonOptions& options, bool reads_toml) {
    command.add_flag("-q,--quiet", options.quiet, "no messages but errors");
    command.add_flag("-v,--verbose", options.verbose, "say more");
    command.add_option("--threads", options.threads, "worker threads (0: all processors)")
        ->check(CLI::Range(0, 4096))
        ->type_name("N");
    command.add_option("--seed", options.seed, "seed of everything random")->type_name("N");
    if (reads_toml) {
        command.add_option("--set", options.set, "override a key of the file, e.g. render.depth=8")
            ->type_name("KEY=VALUE")
            ->allow_extra_args(false);
    }
}

std::string as_given(const CLI::App& command) {
    std::string line = "culet " + command.get_name();
    std::vector<const CLI::Option*> told;
    for (const CLI::Option* option : command.parse_order()) {
        if (std::find(told.begin(), told.end(), option) != told.end()) continue;
        told.push_back(option);
        const bool flag = option->get_expected_max() == 0;
        for (const std::string& value : option->results()) {
            if (!option->get_positional()) line += " " + option->get_name();
            if (!flag) line += " " + shell_word(value);
        }
    }
    return line;
}

std::vector<double> numbers_in(const std::string& text, std::size_t least, std::size_t most,
                               const std::string& expected) {
    std::vector<double> numbers;
    const char *at = text.data(), *const end = at + text.size();
    bool good = true;
    while (good && at <= end) {
        const char* const comma = std::find(at, end, ',');
        while (at < comma && *at == ' ') ++at;
        double value = 0;
        const auto [stop, problem] = std::from_chars(at, comma, value);
        good = problem == std::errc() && stop == comma && std::isfinite(value);
        numbers.push_back(value);
        at = comma + 1;
    }
    if (!good || numbers.size() < least || numbers.size() > most)
        throw InputError(fmt::format("\"{}\": {}", text, expected));
    return numbers;
}

}  // namespace culet
