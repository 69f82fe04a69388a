#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>
#include <cmath>

#include "stone/text/errors.h"
#include "stone/text/name_suggestions.h"
#include "stone/text/path_fence.h"
#include "stone/text/toml_advice.h"
#include "stone/text/toml_parse.h"

namespace culet {

namespace {

const toml::table& as_table(const void* node) {
    return *static_cast<const toml::table*>(node);
}

std::string describe(const toml::node& node) {
    if (node.is_string()) return fmt::format("the text \"{}\"", *node.value<std::string>());
    if (node.is_boolean()) return *node.value<bool>() ? "true" : "false";
    if (node.is_number()) return fmt::format("{}", *node.value<double>());
    if (node.is_array()) return fmt::format("a list of {}", node.as_array()->size());
    if (node.is_table()) return "a table";
    return "a date";
}

long line_of(const toml::node& node) {
    return static_cast<long>(node.source().begin.line);
}

[[noreturn]] void fail_at(const std::filesystem::path& file, const toml::node& node,
                          const std::string& message) {
    if (line_of(node) > 0) throw InputError(file, line_of(node), message);
    throw InputError(file, message + " (set on the command line)");
}

double finite_number(const std::filesystem::path& file, const toml::node& node,
                     std::string_view key) {
    const auto value = node.value<double>();
    if (!node.is_number() || !value) {
        const std::string advice =
            node.is_string() ? number_advice(*node.value<std::string>()) : std::string();
        fail_at(file, node,
                fmt::format("{} must be a number, found {}{}", key, describe(node),
                            advice.empty() ? "" : ": " + advice));
    }
    if (!std::isfinite(*value)) {
        fail_at(file, node, fmt::format("{} must be a finite number, found {}", key, *value));
    }
    return *value;
}

const toml::array& list_of(const std::filesystem::path& file, const toml::node& node,
                           std::string_view key, std::string_view of_what) {
    if (!node.is_array()) {
        fail_at(file, node,
                fmt::format("{} must be a list of {}, found {}", key, of_what, describe(node)));
    }
    return *node.as_array();
}

std::vector<double> row_of(const std::filesystem::path& file, const toml::node& node,
                           std::string_view key, std::size_t size) {
    static constexpr std::array<const char*, 5> words{"no", "one", "two", "three", "four"};
    const toml::array& list = list_of(file, node, key, fmt::format("{} numbers", words.at(size)));
    if (list.size() != size) {
        fail_at(file, node,
                fmt::format("{} must have {} numbers, found {}", key, words.at(size), list.size()));
    }
    std::vector<double> row;
    for (const toml::node& entry : list) row.push_back(finite_number(file, entry, key));
    return row;
}

}  // namespace

const std::filesystem::path& TomlTable::file() const {
    return content_->file;
}
long TomlTable::line() const {
    return line_of(as_table(node_));
}
bool TomlTable::has(std::string_view key) const {
    return as_table(node_).contains(key);
}

TomlTable::Kind TomlTable::kind(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return Kind::missing;
    if (node->is_number()) return Kind::number;
    if (node->is_boolean()) return Kind::boolean;
    if (node->is_string()) return Kind::text;
    if (node->is_array()) return Kind::list;
    if (node->is_table()) return Kind::table;
    return Kind::other;
}

void TomlTable::fail(std::string_view key, const std::string& message) const {
    const toml::node* node = key.empty() ? nullptr : as_table(node_).get(key);
    if (node != nullptr) fail_at(file(), *node, message);
    if (line() > 0) throw InputError(file(), line(), message);
    throw InputError(file(), message);
}

std::optional<double> TomlTable::number(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return std::nullopt;
    return finite_number(file(), *node, key);
}

std::optional<std::int64_t> TomlTable::integer(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_integer()) {
        fail_at(file(), *node,
                fmt::format("{} must be a whole number, found {}", key, describe(*node)));
    }
    return *node->value<std::int64_t>();
}

std::optional<bool> TomlTable::boolean(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_boolean()) {
        fail_at(file(), *node,
                fmt::format("{} must be true or false, found {}", key, describe(*node)));
    }
    return *node->value<bool>();
}

std::optional<std::string> TomlTable::text(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return std::nullopt;
    if (const auto* date = node->as_date())
        return fmt::format("{:04}-{:02}-{:02}", date->get().year, date->get().month,
                           date->get().day);
    if (!node->is_string()) {
        fail_at(file(), *node,
                fmt::format("{} must be a text in quotes, found {}", key, describe(*node)));
    }
    return *node->value<std::string>();
}

std::optional<std::filesystem::path> TomlTable::path(std::string_view key) const {
    const auto name = text(key);
    if (!name) return std::nullopt;
    if (name->empty()) fail(key, fmt::format("{} names no file", key));
    std::filesystem::path path = file().parent_path() / *name;
    try {
        require_within_fence(path);
    } catch (const InputError& error) {
        fail(key, error.what());
    }
    return path;
}

const std::string* TomlTable::held_file(std::string_view key) const {
    const auto name = text(key);
    if (!name) return nullptr;
    const auto found = content_->held.find(*name);
    return found == content_->held.end() ? nullptr : &found->second;
}

std::optional<glm::dvec3> TomlTable::vector(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return std::nullopt;
    const std::vector<double> row = row_of(file(), *node, key, 3);
    return glm::dvec3{row[0], row[1], row[2]};
}

std::optional<std::vector<double>> TomlTable::numbers(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return std::nullopt;
    std::vector<double> values;
    for (const toml::node& entry : list_of(file(), *node, key, "numbers")) {
        values.push_back(finite_number(file(), entry, key));
    }
    return values;
}

std::optional<std::vector<std::string>> TomlTable::texts(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return std::nullopt;
    std::vector<std::string> values;
    for (const toml::node& entry : list_of(file(), *node, key, "texts")) {
        if (!entry.is_string()) {
            fail_at(file(), entry,
                    fmt::format("{} must be a list of texts, found {}", key, describe(entry)));
        }
        values.push_back(*entry.value<std::string>());
    }
    return values;
}

std::optional<std::vector<std::string>> TomlTable::words(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return std::nullopt;
    std::vector<std::string> values;
    const auto take = [&](const toml::node& entry) {
        if (entry.is_string()) {
            values.push_back(*entry.value<std::string>());
        } else if (entry.is_number()) {
            values.push_back(fmt::format("{}", finite_number(file(), entry, key)));
        } else {
            fail_at(file(), entry,
                    fmt::format("{} must be a text, a number or a list of them, found {}", key,
                                describe(entry)));
        }
    };
    if (const toml::array* list = node->as_array()) {
        for (const toml::node& entry : *list) take(entry);
    } else {
        take(*node);
    }
    return values;
}

std::optional<std::vector<std::vector<double>>> TomlTable::rows(std::string_view key,
                                                                std::size_t size) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return std::nullopt;
    std::vector<std::vector<double>> values;
    for (const toml::node& entry : list_of(file(), *node, key, "lists of numbers")) {
        values.push_back(row_of(file(), entry, key, size));
    }
    return values;
}

std::optional<std::vector<glm::dvec3>> TomlTable::vectors(std::string_view key) const {
    const auto all = rows(key, 3);
    if (!all) return std::nullopt;
    std::vector<glm::dvec3> values;
    for (const std::vector<double>& row : *all) values.emplace_back(row[0], row[1], row[2]);
    return values;
}

std::optional<TomlTable> TomlTable::table(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return std::nullopt;
    if (!node->is_table()) {
        fail_at(file(), *node, fmt::format("{} must be a table, found {}", key, describe(*node)));
    }
    TomlTable inner = *this;
    inner.node_ = node->as_table();
    inner.name_ = key;
    return inner;
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return {};
    std::vector<TomlTable> result;
    for (const toml::node& entry :
         list_of(file(), *node, key, fmt::format("tables ([[{}]])", key))) {
        if (!entry.is_table()) {
            fail_at(file(), entry,
                    fmt::format("{} must be a list of tables, found {}", key, describe(entry)));
        }
        TomlTable inner = *this;
        inner.node_ = entry.as_table();
        inner.name_ = key;
        result.push_back(inner);
    }
    return result;
}

void TomlTable::refuse_unknown(const std::vector<std::string_view>& known) const {
    for (const auto& [key, node] : as_table(node_)) {
        if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
        const auto near =
            nearest_name(key.str(), std::vector<std::string>(known.begin(), known.end()));
        fail_at(file(), node,
                fmt::format("unknown key \"{}\"{}{}", key.str(),
                            name_.empty() ? "" : " in [" + name_ + "]",
                            near ? fmt::format(", did you mean \"{}\"?", *near) : std::string()));
    }
}

}  // namespace culet
