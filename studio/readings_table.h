#pragma once
// A readings.csv as a table to edit. What is not edited stays as it is written, comments too.

#include <filesystem>
#include <string>
#include <vector>

namespace culet {

class ReadingsTable {
public:
    struct Row {
        std::vector<std::string> cells;  ///< one for each column
        long line = 0;                   ///< of the file, from 1
    };

    /// Throws InputError as `read_csv` does, for a file without a header, and for one whose rows
    /// are not in `text`, which is the file's as UTF-8 (text_decoding.h).
    ReadingsTable(const std::filesystem::path& file, const std::string& text);

    const std::vector<std::string>& columns() const { return columns_; }  ///< lower case
    const std::vector<Row>& rows() const { return rows_; }

    /// A change of one cell. `row` may be one past the last, which adds an empty row.
    struct Edit {
        std::size_t row = 0;
        std::string column, text;
    };
    /// The file's text with these changes, in their order. Control characters become blanks. Throws
    /// InputError for a row or column that is not there.
    std::string edited(const std::vector<Edit>& edits) const;
    std::string without_row(std::size_t row) const;

private:
    std::string line_of(const std::vector<std::string>& cells) const;
    std::string joined(const std::vector<std::string>& lines) const;

    std::vector<std::string> columns_, lines_;
    std::vector<Row> rows_;
    char separator_ = ',';
};

}  // namespace culet
