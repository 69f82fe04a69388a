#include "fit/measurement.h"

#include <array>
#include <charconv>
#include <cmath>

#include "stone/errors.h"
#include "stone/output_file.h"
#include "stone/toml_file.h"

namespace culet {

namespace {

constexpr std::array<const char*, 15> k_kind_names{
    "inclination", "azimuth",  "dihedral",    "distance", "edge",
    "width",       "depth",    "table_width", "volume",   "weight",
    "meet",        "parallel", "coplanar",    "rotation", "mirror"};

// A stone file with more readings than this is no stone file.
constexpr std::size_t k_most_readings = 100000;

std::string trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

// Splits at '/', but not inside the brackets of mean(A/B).
std::vector<std::string> split_names(std::string_view text) {
    std::vector<std::string> names;
    int depth = 0;
    std::string name;
    for (char c : text) {
        if (c == '(') ++depth;
        if (c == ')') --depth;
        if (c == '/' && depth <= 0) {
            names.push_back(trimmed(name));
            name.clear();
        } else {
            name += c;
        }
    }
    names.push_back(trimmed(name));
    if (names.size() == 1 && names[0].empty()) names.clear();
    return names;
}

struct CsvRow {
    std::vector<std::string> fields;
    long line = 0;
};

// RFC 4180: fields may be quoted, a quote inside is doubled, a quoted field may run over lines.
std::vector<CsvRow> csv_rows(const std::filesystem::path& file, const std::string& text) {
    std::vector<CsvRow> rows;
    CsvRow row;
    std::string field;
    bool quoted = false, was_quoted = false;
    long line = 1;
    row.line = 1;
    const auto end_field = [&] {
        row.fields.push_back(was_quoted ? field : trimmed(field));
        field.clear();
        was_quoted = false;
    };
    const auto end_row = [&] {
        end_field();
        const bool blank = row.fields.size() == 1 && row.fields[0].empty();
        if (!blank && row.fields[0].substr(0, 1) != "#") rows.push_back(row);
        row.fields.clear();
        row.line = line;
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '\0') throw InputError(file, line, "a zero byte: this is not a text file");
        if (c == '\n') ++line;
        if (quoted) {
            if (c != '"') {
                field += c;
            } else if (i + 1 < text.size() && text[i + 1] == '"') {
                field += '"';
                ++i;
            } else {
                quoted = false;
            }
        } else if (c == '"' && trimmed(field).empty() && !was_quoted) {
            field.clear();
            quoted = was_quoted = true;
        } else if (c == ',') {
            end_field();
        } else if (c == '\n') {
            end_row();
        } else if (!was_quoted) {
            field += c;
        } else if (c != ' ' && c != '\t' && c != '\r') {
            throw InputError(file, line, "text after a closing quote; put the quote at its end");
        }
    }
    if (quoted) throw InputError(file, row.line, "a quoted field is never closed");
    if (!field.empty() || !row.fields.empty()) end_row();
    return rows;
}

double number(const std::filesystem::path& file, long line, const std::string& column,
              const std::string& text) {
    double value = 0;
    const char* begin = text.data();
    if (*begin == '+') ++begin;
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        throw InputError(file, line,
                         column + " is '" + text + "'; expected a finite number such as 34.5");
    }
    return value;
}

bool truth(const std::filesystem::path& file, long line, const std::string& column,
           const std::string& text) {
    if (text.empty() || text == "false" || text == "0" || text == "no") return false;
    if (text == "true" || text == "1" || text == "yes") return true;
    throw InputError(file, line, column + " is '" + text + "'; expected true or false");
}

WrittenReading reading_of_table(const TomlTable& table) {
    table.refuse_unknown(
        {"kind", "of", "value", "sigma", "exact", "released", "datum", "id", "note", "rounding"});
    WrittenReading reading;
    reading.file = table.file();
    reading.line = table.line();
    if (!table.has("kind")) table.fail("", "a reading without `kind`");
    reading.kind = *table.text("kind");
    // `of` may be one text with slashes, a number (an azimuth) or a list of either.
    for (const std::string& word : table.words("of").value_or(std::vector<std::string>{})) {
        for (std::string& name : split_names(word)) reading.of.push_back(std::move(name));
    }
    reading.value = table.number("value");
    reading.sigma = table.number("sigma");
    reading.rounding = table.number("rounding");
    reading.exact = table.boolean("exact").value_or(false);
    reading.released = table.boolean("released").value_or(false);
    reading.datum = table.text("datum").value_or(std::string());
    reading.id = table.text("id").value_or(std::string());
    reading.note = table.text("note").value_or(std::string());
    return reading;
}

}  // namespace

const char* name_of(ReadingKind kind) {
    return k_kind_names[static_cast<std::size_t>(kind)];
}

std::optional<ReadingKind> reading_kind(std::string_view name) {
    for (std::size_t i = 0; i < k_kind_names.size(); ++i) {
        if (name == k_kind_names[i]) return static_cast<ReadingKind>(i);
    }
    return std::nullopt;
}

bool is_relation(ReadingKind kind) {
    return kind == ReadingKind::meet || kind == ReadingKind::parallel ||
           kind == ReadingKind::coplanar || kind == ReadingKind::rotation ||
           kind == ReadingKind::mirror;
}

bool is_angle(ReadingKind kind) {
    return kind == ReadingKind::inclination || kind == ReadingKind::azimuth ||
           kind == ReadingKind::dihedral;
}

std::vector<WrittenReading> read_readings_csv(const std::filesystem::path& file) {
    const std::string text = read_text(file, 64u << 20);
    // Spreadsheets put a byte order mark first.
    const bool marked = text.substr(0, 3) == "\xEF\xBB\xBF";
    const std::vector<CsvRow> rows = csv_rows(file, marked ? text.substr(3) : text);
    if (rows.empty()) {
        throw InputError(file, "no readings: expected the header kind,of,value,sigma");
    }
    const std::vector<std::string>& header = rows.front().fields;
    static constexpr std::array<const char*, 10> columns{
        "kind", "of", "value", "sigma", "exact", "released", "datum", "id", "note", "rounding"};
    std::array<int, 10> at{};
    at.fill(-1);
    for (std::size_t i = 0; i < header.size(); ++i) {
        bool known = false;
        for (std::size_t c = 0; c < columns.size(); ++c) {
            if (header[i] != columns[c]) continue;
            if (at[c] >= 0) {
                throw InputError(file, rows.front().line,
                                 "column '" + header[i] + "' stands twice");
            }
            at[c] = static_cast<int>(i);
            known = true;
        }
        if (!known) {
            throw InputError(file, rows.front().line,
                             "unknown column '" + header[i] +
                                 "'; expected the header kind,of,value,sigma (and exact, released, "
                                 "datum, id, note, rounding)");
        }
    }
    for (std::size_t c = 0; c < 4; ++c) {
        if (at[c] < 0) {
            throw InputError(file, rows.front().line,
                             std::string("the header lacks the column '") + columns[c] +
                                 "'; expected kind,of,value,sigma");
        }
    }
    if (rows.size() - 1 > k_most_readings) throw InputError(file, "more than 100000 readings");

    std::vector<WrittenReading> readings;
    for (std::size_t r = 1; r < rows.size(); ++r) {
        const CsvRow& row = rows[r];
        if (row.fields.size() > header.size()) {
            throw InputError(file, row.line,
                             std::to_string(row.fields.size()) + " fields under a header of " +
                                 std::to_string(header.size()) +
                                 "; write numbers with a decimal point, and quote a field that "
                                 "contains a comma");
        }
        const auto field = [&](std::size_t column) -> std::string {
            const int i = at[column];
            return i < 0 || i >= static_cast<int>(row.fields.size()) ? std::string()
                                                                     : row.fields[i];
        };
        WrittenReading reading;
        reading.file = file;
        reading.line = row.line;
        reading.kind = field(0);
        reading.of = split_names(field(1));
        if (!field(2).empty()) reading.value = number(file, row.line, "value", field(2));
        if (!field(3).empty()) reading.sigma = number(file, row.line, "sigma", field(3));
        reading.exact = truth(file, row.line, "exact", field(4));
        reading.released = truth(file, row.line, "released", field(5));
        reading.datum = field(6);
        reading.id = field(7);
        reading.note = field(8);
        if (!field(9).empty()) reading.rounding = number(file, row.line, "rounding", field(9));
        readings.push_back(std::move(reading));
    }
    return readings;
}

std::vector<WrittenReading> read_readings(const std::filesystem::path& stone_file,
                                          const std::vector<std::string>& overrides) {
    const TomlTable root = read_toml(stone_file, overrides);
    std::vector<WrittenReading> readings;
    const auto tables = root.tables("reading");
    if (tables.size() > k_most_readings) {
        throw InputError(stone_file, "more than 100000 readings");
    }
    for (const TomlTable& table : tables) readings.push_back(reading_of_table(table));
    const auto stone = root.table("stone");
    const auto csv = stone ? stone->path("readings") : std::nullopt;
    if (csv) {
        for (WrittenReading& reading : read_readings_csv(*csv)) {
            readings.push_back(std::move(reading));
        }
    }
    return readings;
}

}  // namespace culet
