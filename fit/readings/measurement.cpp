#include "fit/readings/measurement.h"

#include <fmt/format.h>

#include <algorithm>

#include "fit/readings/reading_words.h"
#include "fit/readings/readings_by_row.h"
#include "fit/readings/readings_csv.h"
#include "fit/readings/seen_lines.h"
#include "fit/readings/silhouette_tables.h"
#include "stone/text/errors.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace {

WrittenReading reading_of_table(const TomlTable& table) {
    table.refuse_unknown({"kind", "of", "value", "sigma", "exact", "released", "datum", "side",
                          "id", "note", "rounding"});
    WrittenReading reading;
    reading.file = table.file();
    reading.line = table.line();
    if (!table.has("kind")) table.fail("", "a reading without `kind`");
    reading.kind = *table.text("kind");
    // `of` may be a text with slashes, a number (an azimuth) or a list of either.
    for (const std::string& word : table.words("of").value_or(std::vector<std::string>{})) {
        for (std::string& name : split_names(word)) reading.of.push_back(std::move(name));
    }
    const auto number = [&](const char* key, WrittenUnit& unit) -> std::optional<double> {
        // "6.52 mm"
        if (table.kind(key) != TomlTable::Kind::text) return table.number(key);
        WrittenNumber found = written_number(*table.text(key), false);
        if (!found.problem.empty()) table.fail(key, fmt::format("{} {}", key, found.problem));
        unit = std::move(found.unit);
        return found.value;
    };
    reading.value = number("value", reading.value_unit);
    reading.sigma = number("sigma", reading.sigma_unit);
    reading.rounding = number("rounding", reading.rounding_unit);
    reading.exact = table.boolean("exact").value_or(false);
    reading.released = table.boolean("released").value_or(false);
    reading.datum = table.text("datum").value_or(std::string());
    reading.side = table.text("side").value_or(std::string());
    reading.id = table.text("id").value_or(std::string());
    reading.note = table.text("note").value_or(std::string());
    return reading;
}

// Without `problems` the first row that is wrong throws.
std::vector<WrittenReading> readings_of(const TomlTable& root, std::vector<RowProblem>* problems) {
    std::vector<WrittenReading> readings;
    const auto tables = root.tables("reading");
    if (tables.size() > k_most_readings) {
        throw InputError(root.file(), "more than 100000 readings");
    }
    for (const TomlTable& table : tables) readings.push_back(reading_of_table(table));
    const auto stone = root.table("stone");
    const auto csv = stone ? stone->path("readings") : std::nullopt;
    if (csv) {
        for (WrittenReading& reading :
             problems == nullptr ? read_readings_csv(*csv) : read_readings_csv(*csv, *problems)) {
            readings.push_back(std::move(reading));
        }
    }
    for (WrittenReading& reading : read_silhouettes(root)) readings.push_back(std::move(reading));
    for (WrittenReading& reading : read_lines(root)) readings.push_back(std::move(reading));
    return readings;
}

}  // namespace

std::size_t skipped_readings(const std::vector<WrittenReading>& written) {
    return static_cast<std::size_t>(std::count_if(
        written.begin(), written.end(), [](const WrittenReading& w) { return w.skipped; }));
}

std::vector<WrittenReading> read_readings(const std::filesystem::path& stone_file,
                                          const std::vector<std::string>& overrides) {
    return readings_of(read_toml(stone_file, overrides), nullptr);
}

std::vector<WrittenReading> read_readings(const std::filesystem::path& stone_file,
                                          std::vector<RowProblem>& problems) {
    return readings_of(read_toml(stone_file), &problems);
}

}  // namespace culet
