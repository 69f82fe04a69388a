// readings.csv, as spreadsheets and people write it.

#include "fit/readings/readings_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "fit/readings/measurement.h"
#include "fit/readings/reading_words.h"
#include "fit/readings/readings_by_row.h"
#include "stone/text/csv.h"
#include "stone/text/errors.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

bool truth(const std::filesystem::path& file, long line, const std::string& column,
           const std::string& written) {
    const std::string text = lower_case(written);
    if (text.empty() || text == "false" || text == "0" || text == "no") return false;
    if (text == "true" || text == "1" || text == "yes") return true;
    throw InputError(file, line, column + " is '" + written + "'; expected true or false");
}

enum Column { kind, of, value, sigma, exact, released, datum, side, id, note, rounding, count };
constexpr std::array<const char*, Column::count> k_columns{
    "kind", "of", "value", "sigma", "exact", "released", "datum", "side", "id", "note", "rounding"};

// Position of each column; -1: absent.
std::array<int, Column::count> columns_of(const CsvRow& header, const std::filesystem::path& file) {
    std::array<int, Column::count> at{};
    at.fill(-1);
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
        const std::string name = lower_case(header.fields[i]);
        // Spreadsheets add empty columns at the end.
        if (name.empty()) continue;
        const auto known = std::find(k_columns.begin(), k_columns.end(), name);
        for (const char* const column : k_columns) {
            const std::string_view more = std::string_view(name).substr(
                name.starts_with(column) ? std::string_view(column).size() : name.size());
            if (more.empty() || std::isalpha(static_cast<unsigned char>(more.front())) != 0)
                continue;
            throw InputError(file, header.line,
                             fmt::format("column '{}': write {} alone; a unit stands beside each "
                                         "number (34.5 deg), or is the stone file's",
                                         header.fields[i], column));
        }
        if (known == k_columns.end()) {
            throw InputError(file, header.line,
                             "unknown column '" + header.fields[i] +
                                 "'; expected the header kind,of,value,sigma (and exact, released, "
                                 "datum, side, id, note, rounding)");
        }
        int& place = at[static_cast<std::size_t>(known - k_columns.begin())];
        if (place >= 0) {
            throw InputError(file, header.line, "column '" + header.fields[i] + "' stands twice");
        }
        place = static_cast<int>(i);
    }
    for (std::size_t c = 0; c <= Column::sigma; ++c) {
        if (at[c] < 0) {
            throw InputError(file, header.line,
                             std::string("the header lacks the column '") + k_columns[c] +
                                 "'; expected kind,of,value,sigma");
        }
    }
    return at;
}

class RowReader {
public:
    RowReader(const std::filesystem::path& file, const CsvRow& header, char separator)
        : file_(file),
          at_(columns_of(header, file)),
          width_(header.fields.size()),
          separator_(separator) {}

    WrittenReading reading(const CsvRow& row) const {
        if (row.fields.size() > width_) {
            throw InputError(
                file_, row.line,
                fmt::format("{} fields under a header of {}; {}quote a field that contains a {}",
                            row.fields.size(), width_,
                            separator_ == ',' ? "write numbers with a decimal point, and " : "",
                            separator_ == ',' ? "comma" : "separator"));
        }
        const auto field = [&](Column column) -> std::string {
            const int i = at_[column];
            return i < 0 || i >= static_cast<int>(row.fields.size()) ? std::string()
                                                                     : row.fields[i];
        };
        WrittenReading reading;
        reading.file = file_;
        reading.line = row.line;
        reading.kind = field(Column::kind);
        if (reading.kind.empty())
            throw InputError(file_, row.line, "kind is missing: write it in every row");
        reading.of = split_names(field(Column::of));
        const auto number = [&](Column column, WrittenUnit& unit) -> std::optional<double> {
            if (field(column).empty()) return std::nullopt;
            WrittenNumber found = written_number(field(column), separator_ == ',');
            if (!found.problem.empty()) {
                throw InputError(file_, row.line,
                                 fmt::format("{} {}", k_columns[column], found.problem));
            }
            unit = std::move(found.unit);
            return found.value;
        };
        reading.value = number(Column::value, reading.value_unit);
        reading.sigma = number(Column::sigma, reading.sigma_unit);
        reading.rounding = number(Column::rounding, reading.rounding_unit);
        reading.exact = truth(file_, row.line, "exact", field(Column::exact));
        reading.released = truth(file_, row.line, "released", field(Column::released));
        reading.datum = field(Column::datum);
        reading.side = field(Column::side);
        reading.id = field(Column::id);
        reading.note = field(Column::note);
        mark_blank(reading);
        return reading;
    }

private:
    const std::filesystem::path& file_;
    std::array<int, Column::count> at_;
    std::size_t width_;
    char separator_;
};

}  // namespace

namespace {

// Without `problems` the first row that is wrong throws.
std::vector<WrittenReading> read_rows(const std::filesystem::path& file,
                                      std::vector<RowProblem>* problems) {
    const auto [rows, separator] = read_csv(file);
    if (rows.empty()) {
        throw InputError(file, "no readings: expected the header kind,of,value,sigma");
    }
    if (rows.size() - 1 > k_most_readings) throw InputError(file, "more than 100000 readings");
    const RowReader reader(file, rows.front(), separator);
    std::vector<WrittenReading> readings;
    for (std::size_t r = 1; r < rows.size(); ++r) {
        try {
            readings.push_back(reader.reading(rows[r]));
        } catch (const InputError& error) {
            if (problems == nullptr) throw;
            const std::string place = fmt::format("{}:{}: ", file.string(), rows[r].line);
            const std::string what = error.what();
            problems->push_back(
                {rows[r].line, what.starts_with(place) ? what.substr(place.size()) : what});
            readings.emplace_back();
            readings.back().file = file;
            readings.back().line = rows[r].line;
            readings.back().kind = name_of(ReadingKind::inclination);
            readings.back().skipped = true;
        }
    }
    return readings;
}

}  // namespace

std::vector<WrittenReading> read_readings_csv(const std::filesystem::path& file) {
    return read_rows(file, nullptr);
}

std::vector<WrittenReading> read_readings_csv(const std::filesystem::path& file,
                                              std::vector<RowProblem>& problems) {
    return read_rows(file, &problems);
}

}  // namespace culet
