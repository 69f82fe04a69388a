#pragma once
// Tables as spreadsheets and people write them.

#include <filesystem>
#include <string>
#include <vector>

namespace culet {

struct CsvRow {
    std::vector<std::string> fields;  ///< without blanks at both ends
    long line = 0;                    ///< where it begins, from 1

    bool is_blank() const;
};

struct CsvTable {
    std::vector<CsvRow> rows;  ///< the header first; neither blank rows nor comments (#)
    char separator = ',';      ///< comma, semicolon or tab: told by the header
};

/// RFC 4180 for any of the separators: fields may be quoted, a quote inside is doubled, a quoted
/// field may run over lines. Excel's `sep=;` is passed over. Throws InputError: not
/// readable, over 64 MB, no text (text_decoding.h), a quoted field that does not end well.
CsvTable read_csv(const std::filesystem::path& file);

}  // namespace culet
