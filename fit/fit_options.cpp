// The [fit] table of a stone file.

#include <fmt/format.h>

#include <toml++/toml.h>
#include <cmath>

#include "fit/fit.h"
#include "stone/errors.h"
#include "stone/output_file.h"

namespace culet {

namespace {

void set_option(const std::filesystem::path& file, long line, std::string_view key,
                const toml::node& node, FitOptions& options) {
    const auto fail = [&](const std::string& expected) {
        const std::string what = fmt::format("`{}` of [fit] must be {}", key, expected);
        throw line > 0 ? InputError(file, line, what) : InputError(what);
    };
    const auto number = node.value<double>();
    if (key == "meets") {
        const std::string text = node.value_or(std::string());
        if (text == "exact") {
            options.meets = MeetTreatment::exact;
        } else if (text == "soft") {
            options.meets = MeetTreatment::soft;
        } else if (text == "released") {
            options.meets = MeetTreatment::released;
        } else {
            fail("\"exact\", \"soft\" or \"released\"");
        }
    } else if (key == "meet_sigma") {
        if (node.value_or(std::string()) == "auto") {
            options.meet_sigma.reset();
        } else if (!number || !(*number > 0) || !std::isfinite(*number)) {
            fail("a positive length in the stone's unit, or \"auto\"");
        } else {
            options.meet_sigma = *number;
        }
    } else if (key == "iterations") {
        if (!node.is_integer() || !number || *number < 1 || *number > 1e6) {
            fail("a whole number of steps, 1 or more");
        }
        options.iterations = static_cast<int>(*number);
    } else if (key == "significance") {
        if (!number || !(*number > 0) || !(*number < 0.5)) fail("between 0 and 0.5");
        options.significance = *number;
    } else {
        const std::string what = fmt::format(
            "[fit] has no key `{}`; known are meets, meet_sigma, iterations and significance", key);
        throw line > 0 ? InputError(file, line, what) : InputError(what);
    }
}

}  // namespace

FitOptions read_fit_options(const std::filesystem::path& stone_file,
                            const std::vector<std::string>& overrides) {
    FitOptions options;
    toml::table root;
    try {
        root = toml::parse(read_text(stone_file, 64u << 20), stone_file.string());
    } catch (const toml::parse_error& error) {
        throw InputError(stone_file, static_cast<long>(error.source().begin.line),
                         std::string(error.description()));
    }
    if (const toml::node* node = root.get("fit")) {
        const toml::table* table = node->as_table();
        const long line = static_cast<long>(node->source().begin.line);
        if (table == nullptr) throw InputError(stone_file, line, "`fit` must be a [fit] table");
        for (const auto& [key, value] : *table) {
            set_option(stone_file, static_cast<long>(value.source().begin.line), key.str(), value,
                       options);
        }
    }
    for (const std::string& set : overrides) {
        if (set.rfind("fit.", 0) != 0) continue;
        const std::size_t equals = set.find('=');
        if (equals == std::string::npos) {
            throw InputError(fmt::format("--set {}: expected KEY=VALUE", set));
        }
        const std::string key = set.substr(4, equals - 4);
        toml::table one;
        try {
            one = toml::parse("value = " + set.substr(equals + 1));
        } catch (const toml::parse_error&) {
            // A bare word is a text.
            one.insert_or_assign("value", set.substr(equals + 1));
        }
        set_option(stone_file, 0, key, *one.get("value"), options);
    }
    return options;
}

}  // namespace culet
