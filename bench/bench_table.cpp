#include "bench/bench_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr int k_first_column = 34, k_least_width = 9;

int width_of(const std::string& column) {
    return std::max(k_least_width, static_cast<int>(column.size()));
}

nlohmann::ordered_json value_of(const std::string& text) {
    if (text.empty()) return nullptr;
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (*end == 0) return number;
    return text;
}

}  // namespace

struct BenchTables::Content {
    nlohmann::ordered_json sections = nlohmann::ordered_json::array();
    std::vector<std::string> columns;
};

BenchTables::BenchTables() : content_(std::make_unique<Content>()) {}
BenchTables::~BenchTables() = default;

void BenchTables::section(const std::string& name, const std::string& remark,
                          const std::vector<std::string>& columns) {
    content_->columns = columns;
    content_->sections.push_back({{"name", name},
                                  {"about", remark},
                                  {"lines", nlohmann::ordered_json::array()},
                                  {"remarks", nlohmann::ordered_json::array()}});
    std::cout << fmt::format("\n## {}\n{}\n{:<{}}", name, remark, "", k_first_column);
    for (const std::string& column : columns)
        std::cout << fmt::format(" {:>{}}", column, width_of(column));
    std::cout << "\n" << std::flush;
}

void BenchTables::line(const std::string& what, const std::vector<std::string>& values) {
    check(values.size() == content_->columns.size(), "a value for every column");
    nlohmann::ordered_json line{{"what", what}};
    std::cout << fmt::format("{:<{}}", what, k_first_column);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::string& column = content_->columns[i];
        std::cout << fmt::format(" {:>{}}", values[i], width_of(column));
        line[column] = value_of(values[i]);
    }
    std::cout << "\n" << std::flush;
    content_->sections.back()["lines"].push_back(line);
}

void BenchTables::remark(const std::string& text) {
    std::cout << text << "\n" << std::flush;
    content_->sections.back()["remarks"].push_back(text);
}

std::string BenchTables::json(const std::vector<std::pair<std::string, std::string>>& head) const {
    nlohmann::ordered_json whole;
    for (const auto& [key, text] : head) whole[key] = value_of(text);
    whole["sections"] = content_->sections;
    return whole.dump(1) + "\n";
}

}  // namespace culet
