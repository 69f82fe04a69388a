#include "bench/studies/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace culet {

template <class Value>
Value Parameters::needed(const std::string& key, std::optional<Value> value,
                         const std::string& text) {
    if (!value) table_.fail(key, "is missing");
    const bool known = std::any_of(used_.begin(), used_.end(),
                                   [&](const auto& row) { return row.front() == key; });
    if (!known) used_.push_back({key, text});
    return *value;
}

double Parameters::number(const std::string& key) {
    const auto value = table_.number(key);
    return needed(key, value, value ? fmt::format("{}", *value) : "");
}

int Parameters::count(const std::string& key) {
    const auto value = table_.integer(key);
    if (value && (*value < 1 || *value > 1'000'000)) table_.fail(key, "must be 1 to 1000000");
    return static_cast<int>(needed(key, value, value ? fmt::format("{}", *value) : ""));
}

std::vector<double> Parameters::numbers(const std::string& key) {
    const auto value = table_.numbers(key);
    return needed(key, value, value ? fmt::format("{}", fmt::join(*value, ", ")) : "");
}

std::vector<std::string> Parameters::texts(const std::string& key) {
    const auto value = table_.texts(key);
    return needed(key, value, value ? fmt::format("{}", fmt::join(*value, ", ")) : "");
}

std::filesystem::path Parameters::path(const std::string& key) {
    return needed(key, table_.path(key), table_.text(key).value_or(""));
}

}  // namespace culet
