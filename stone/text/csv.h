#pragma once
// Reads tables as spreadsheets and people write them.

#include <filesystem>
#include <string>
#include <vector>

namespace culet {

struct CsvRow {
    std::vector<std::string> fields;  ///< without blanks at both ends
    long line = 0;                    ///< where the row begins, from 1

    bool is_blank() const;
};

struct CsvTable {
    std::vector<CsvRow> rows;  ///< the header first; without blank rows and comments (#)
    char separator = ',';      ///< comma, semicolon or tab, as in the header
};

/// RFC 4180 with any of the separators: fields may be quoted, a quote inside is doubled, quoted
/// fields may contain line breaks. Excel's `sep=;` is skipped. Throws InputError if the file is
/// unreadable, over 64 MB, not text (text_decoding.h), or ends in a quoted field.
CsvTable read_csv(const std::filesystem::path& file);

}  // namespace culet
