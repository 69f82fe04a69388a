#include "stone/toml_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "stone/errors.h"
#include "stone/output_file.h"
#include "stone/text_decoding.h"
#include "stone/toml_advice.h"
#include "stone/toml_keys.h"

namespace culet {

struct TomlTable::Content {
    std::filesystem::path file;
    toml::table root;
    HeldFiles held;
};

namespace {

constexpr std::size_t k_limit_bytes = 64u << 20;

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

Vec3 vector_of(const std::filesystem::path& file, const toml::node& node, std::string_view key) {
    const toml::array& list = list_of(file, node, key, "three numbers");
    if (list.size() != 3) {
        fail_at(file, node, fmt::format("{} must have three numbers, found {}", key, list.size()));
    }
    return {finite_number(file, list[0], key), finite_number(file, list[1], key),
            finite_number(file, list[2], key)};
}

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

// Tables within tables are taken apart by recursion; toml++ bounds values in values (256) but not
// the parts of dotted keys.
constexpr std::size_t k_most_key_parts = 16;

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
                    fmt::format("--set {}: \"{}\" is no entry of a list of {} (counted from 0)",
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

// Line `number` of a text, counted from 1.
std::string_view line_of_text(std::string_view text, long number) {
    for (; number > 1; --number) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return {};
        text.remove_prefix(end + 1);
    }
    return text.substr(0, text.find('\n'));
}

toml::table parsed_text(std::string_view text, const std::filesystem::path& file,
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
                         fmt::format("is no TOML: {}{}", error.description(),
                                     advice.empty() ? "" : "; " + advice));
    }
    for (const std::string& setting : overrides) apply_override(root, setting);
    return root;
}

toml::table parsed(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return parsed_text(decoded_text(read_text(file, k_limit_bytes), file), file, overrides);
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

std::string formatted(const toml::table& root) {
    std::ostringstream text;
    text << toml::toml_formatter{root} << "\n";
    return text.str();
}

/// Every text below `node` that names a file in `from` names it as seen from `to`.
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

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1,
                               diagonal + static_cast<std::size_t>(a[i - 1] != b[j - 1])});
            diagonal = above;
        }
    }
    return row[b.size()];
}

std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& known) {
    std::optional<std::string> best;
    std::size_t best_distance = std::max<std::size_t>(2, word.size() / 2) + 1;
    for (const std::string& name : known) {
        const std::size_t distance = edit_distance(word, name);
        if (distance < best_distance) {
            best_distance = distance;
            best = name;
        }
    }
    return best;
}

TomlTable read_toml(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
    return read_toml_with(file, {}, overrides);
}

TomlTable read_toml_with(const std::filesystem::path& file,
                         const std::vector<std::pair<std::string, std::string>>& texts,
                         const std::vector<std::string>& overrides) {
    auto content = std::make_shared<TomlTable::Content>();
    content->file = file;
    content->root = parsed(file, {});
    for (const auto& [key, text] : texts) content->root.insert_or_assign(key, text);
    for (const std::string& setting : overrides) apply_override(content->root, setting);
    TomlTable table;
    table.node_ = &content->root;
    table.content_ = std::move(content);
    return table;
}

TomlTable toml_beside(const std::filesystem::path& file,
                      const std::vector<std::pair<std::string, std::string>>& texts,
                      const std::vector<std::string>& overrides) {
    auto content = std::make_shared<TomlTable::Content>();
    content->file = file;
    for (const auto& [key, text] : texts) content->root.insert_or_assign(key, text);
    for (const std::string& setting : overrides) apply_override(content->root, setting);
    TomlTable table;
    table.node_ = &content->root;
    table.content_ = std::move(content);
    return table;
}

TomlTable toml_of_text(std::string_view text, const std::filesystem::path& name,
                       const std::vector<std::string>& overrides, HeldFiles files) {
    auto content = std::make_shared<TomlTable::Content>();
    content->file = name;
    content->root = parsed_text(text, name, overrides);
    content->held = std::move(files);
    TomlTable table;
    table.node_ = &content->root;
    table.content_ = std::move(content);
    return table;
}

std::string rewritten_toml(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides,
                           const std::vector<std::string>& without,
                           const std::filesystem::path& folder) {
    toml::table root = parsed(file, overrides);
    erase_keys(root, without);
    move_paths(root, file.parent_path(), folder);
    return formatted(root);
}

std::string rewritten_text(std::string_view text, const std::filesystem::path& name,
                           const std::vector<std::string>& overrides,
                           const std::vector<std::string>& without) {
    toml::table root = parsed_text(text, name, overrides);
    erase_keys(root, without);
    return formatted(root);
}

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
    return file().parent_path() / *name;
}

const std::string* TomlTable::held_file(std::string_view key) const {
    const auto name = text(key);
    if (!name) return nullptr;
    const auto found = content_->held.find(*name);
    return found == content_->held.end() ? nullptr : &found->second;
}

std::optional<Vec3> TomlTable::vector(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return std::nullopt;
    return vector_of(file(), *node, key);
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

std::optional<std::vector<Vec3>> TomlTable::vectors(std::string_view key) const {
    const toml::node* node = as_table(node_).get(key);
    if (node == nullptr) return std::nullopt;
    std::vector<Vec3> values;
    for (const toml::node& entry : list_of(file(), *node, key, "vectors")) {
        values.push_back(vector_of(file(), entry, key));
    }
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
