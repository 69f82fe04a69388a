#include "studio/readings_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "stone/text/csv.h"
#include "stone/text/errors.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

constexpr std::size_t k_longest_cell = 400, k_most_rows = 5000;

std::string plain(std::string text) {
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
    }
    return std::string(trimmed(text));
}

// Lines that a row covers: a quoted field may hold line breaks.
std::size_t lines_covered(const std::vector<std::string>& lines, std::size_t first) {
    long quotes = 0;
    for (std::size_t at = first; at < lines.size(); ++at) {
        quotes += std::count(lines[at].begin(), lines[at].end(), '"');
        if (quotes % 2 == 0) return at - first + 1;
    }
    return 1;
}

}  // namespace

ReadingsTable::ReadingsTable(const std::filesystem::path& file, const std::string& text) {
    LineReader reader(text);
    while (const auto line = reader.next()) lines_.emplace_back(*line);
    const CsvTable table = read_csv(file);
    if (table.rows.empty())
        throw InputError(file, "no readings: expected the header kind,of,value,sigma");
    if (table.rows.size() > k_most_rows)
        throw InputError(file, fmt::format("has more than {} rows, too many for a table on a "
                                           "screen: culet fit reads it",
                                           k_most_rows));
    separator_ = table.separator;
    for (const std::string& name : table.rows.front().fields) columns_.push_back(lower_case(name));
    for (std::size_t r = 1; r < table.rows.size(); ++r) {
        Row row{table.rows[r].fields, table.rows[r].line};
        if (row.line < 1 || std::size_t(row.line) > lines_.size())
            throw InputError(file, "was changed while it was read: read it again");
        row.cells.resize(std::max(columns_.size(), row.cells.size()));
        rows_.push_back(std::move(row));
    }
}

std::string ReadingsTable::line_of(const std::vector<std::string>& cells) const {
    std::string line;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        if (c > 0) line += separator_;
        const std::string& cell = cells[c];
        const bool quoted = cell.find(separator_) != std::string::npos ||
                            cell.find('"') != std::string::npos || cell.starts_with('#');
        if (!quoted) {
            line += cell;
            continue;
        }
        line += '"';
        for (const char letter : cell) line += letter == '"' ? "\"\"" : std::string(1, letter);
        line += '"';
    }
    return line;
}

std::string ReadingsTable::joined(const std::vector<std::string>& lines) const {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

std::string ReadingsTable::edited(const std::vector<Edit>& edits) const {
    std::vector<std::vector<std::string>> cells;
    for (const Row& row : rows_) cells.push_back(row.cells);
    std::map<std::size_t, bool> touched;
    for (const Edit& edit : edits) {
        const auto column = std::find(columns_.begin(), columns_.end(), edit.column);
        if (column == columns_.end())
            throw InputError(fmt::format("the table has no column \"{}\"", shown(edit.column)));
        if (edit.row > cells.size() || edit.row >= k_most_rows)
            throw InputError(fmt::format("the table has no row {}", edit.row + 1));
        if (edit.text.size() > k_longest_cell)
            throw InputError(fmt::format("a cell holds at most {} characters", k_longest_cell));
        if (edit.row == cells.size()) cells.emplace_back(columns_.size());
        cells[edit.row][std::size_t(column - columns_.begin())] = plain(edit.text);
        touched[edit.row] = true;
    }
    std::vector<std::string> lines = lines_;
    // From the last to the first, so that line numbers before an edit stay right.
    for (auto at = touched.rbegin(); at != touched.rend(); ++at) {
        const std::string line = line_of(cells[at->first]);
        if (at->first >= rows_.size()) continue;
        const auto first = std::size_t(rows_[at->first].line - 1);
        const auto place = lines.begin() + std::ptrdiff_t(first);
        *place = line;
        lines.erase(place + 1, place + std::ptrdiff_t(lines_covered(lines_, first)));
    }
    for (std::size_t r = rows_.size(); r < cells.size(); ++r) lines.push_back(line_of(cells[r]));
    return joined(lines);
}

std::string ReadingsTable::without_row(std::size_t row) const {
    if (row >= rows_.size()) throw InputError(fmt::format("the table has no row {}", row + 1));
    std::vector<std::string> lines = lines_;
    const auto first = std::size_t(rows_[row].line - 1);
    const auto place = lines.begin() + std::ptrdiff_t(first);
    lines.erase(place, place + std::ptrdiff_t(lines_covered(lines_, first)));
    return joined(lines);
}

}  // namespace culet
