#pragma once
// The parameters of a study: one table of parameters.toml. Remembers which were used.

#include <string>
#include <utility>
#include <vector>

#include "stone/text/toml_file.h"

namespace culet {

class Parameters {
public:
    explicit Parameters(TomlTable table) : table_(std::move(table)) {}

    /// Each throws InputError where the key is missing or has another type.
    double number(const std::string& key);
    int count(const std::string& key);  ///< at least 1
    std::vector<double> numbers(const std::string& key);
    std::vector<std::string> texts(const std::string& key);
    /// A path relative to the file's folder.
    std::filesystem::path path(const std::string& key);

    /// Key and value, in the order of first use.
    const std::vector<std::vector<std::string>>& used() const { return used_; }

private:
    template <class Value>
    Value needed(const std::string& key, std::optional<Value> value, const std::string& text);

    TomlTable table_;
    std::vector<std::vector<std::string>> used_;
};

}  // namespace culet
