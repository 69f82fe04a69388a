#include "stone/text/toml_parse.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "stone/text/errors.h"
#include "stone/text/toml_advice.h"
#include "stone/text/toml_keys.h"

namespace culet {

namespace {

std::vector<std::string> split(std::string_view text, char at) {
    std::vector<std::string> parts(1);
    for (char c : text) {
        if (c == at) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

// Nested tables are destroyed by recursion, and toml++ limits the nesting of values (256) but not
// dotted keys.
constexpr std::size_t k_most_key_parts = 16;

// `number` counts from 1.
std::string_view line_of_text(std::string_view text, long number) {
    for (; number > 1; --number) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return {};
        text.remove_prefix(end + 1);
    }
    return text.substr(0, text.find('\n'));
}

}  // namespace

void apply_override(toml::table& root, const std::string& setting) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
        throw InputError(
            fmt::format("--set {}: write KEY.PATH=VALUE, e.g. render.depth=8", setting));
    }
    const std::string value_text = setting.substr(equals + 1);
    toml::table value;
    try {
        value = toml::parse("value = " + value_text);
        if (value.size() != 1) throw InputError(fmt::format("--set {}: one value only", setting));
    } catch (const toml::parse_error&) {
        value.insert_or_assign("value", value_text);
    }
    const std::vector<std::string> path = split(setting.substr(0, equals), '.');
    if (path.size() > k_most_key_parts) {
        throw InputError(
            fmt::format("--set {}: more than {} parts between dots", setting, k_most_key_parts));
    }
    toml::node* at = &root;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const bool last = i + 1 == path.size();
        if (toml::array* list = at->as_array()) {
            std::size_t index = 0;
            const auto [end, problem] =
                std::from_chars(path[i].data(), path[i].data() + path[i].size(), index);
            if (problem != std::errc() || end != path[i].data() + path[i].size() ||
                index >= list->size()) {
                throw InputError(
                    fmt::format("--set {}: \"{}\" is not an entry of a list of {} (counted from 0)",
                                setting, path[i], list->size()));
            }
            if (last) {
                list->erase(list->begin() + static_cast<std::ptrdiff_t>(index));
                list->insert(list->begin() + static_cast<std::ptrdiff_t>(index),
                             *value.get("value"));
            } else {
                at = list->get(index);
            }
            continue;
        }
        toml::table* table = at->as_table();
        if (table == nullptr || path[i].empty()) {
            throw InputError(fmt::format("--set {}: there is nothing under \"{}\"", setting,
                                         i == 0 ? path[i] : path[i - 1]));
        }
        if (last) {
            table->insert_or_assign(path[i], *value.get("value"));
        } else {
            if (!table->contains(path[i])) table->insert(path[i], toml::table{});
            at = table->get(path[i]);
        }
    }
}

toml::table parse_toml(std::string_view text, const std::filesystem::path& file,
                       const std::vector<std::string>& overrides) {
    if (const long line = line_of_deep_key(text, k_most_key_parts)) {
        throw InputError(file, line,
                         fmt::format("a key has more than {} parts between dots: no key of culet "
                                     "has more than a few",
                                     k_most_key_parts));
    }
    toml::table root;
    try {
        root = toml::parse(text, file.string());
    } catch (const toml::parse_error& error) {
        const auto line = static_cast<long>(error.source().begin.line);
        const std::string advice = toml_advice(line_of_text(text, line));
        throw InputError(file, line,
                         fmt::format("is not TOML: {}{}", error.description(),
                                     advice.empty() ? "" : "; " + advice));
    }
    for (const std::string& setting : overrides) apply_override(root, setting);
    return root;
}

void erase_keys(toml::table& root, const std::vector<std::string>& keys) {
    for (const std::string& key : keys) {
        const std::vector<std::string> path = split(key, '.');
        toml::table* table = &root;
        for (std::size_t i = 0; i + 1 < path.size() && table != nullptr; ++i)
            table = (*table)[path[i]].as_table();
        if (table != nullptr) table->erase(path.back());
    }
}

std::string formatted_toml(const toml::table& root) {
    std::ostringstream text;
    text << toml::toml_formatter{root} << "\n";
    return text.str();
}

void move_paths(toml::node& node, const std::filesystem::path& from,
                const std::filesystem::path& to) {
    if (toml::table* table = node.as_table()) {
        for (auto&& [key, value] : *table) move_paths(value, from, to);
    } else if (toml::array* list = node.as_array()) {
        for (toml::node& value : *list) move_paths(value, from, to);
    } else if (toml::value<std::string>* text = node.as_string()) {
        std::error_code ignored;
        const std::filesystem::path named(text->get());
        if (named.empty() || named.is_absolute()) return;
        if (!std::filesystem::is_regular_file(from / named, ignored)) return;
        const auto moved = std::filesystem::proximate(from / named, to.empty() ? "." : to, ignored);
        if (!ignored && !moved.empty()) *text = moved.generic_string();
    }
}

}  // namespace culet
