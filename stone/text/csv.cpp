#include "stone/text/csv.h"

#include <algorithm>
#include <string_view>

#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

// Blank lines, comments, and Excel's `sep=;`.
bool precedes_the_header(std::string_view line) {
    const std::string plain = lower_case(std::string(trimmed(line)));
    const std::size_t start = plain.find_first_not_of("\";,\t ");
    return start == std::string::npos || plain[start] == '#' || plain.starts_with("sep=");
}

// The header decides.
char separator_of(std::string_view text) {
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = text.substr(begin, end - begin);
        begin = end + 1;
        if (precedes_the_header(line)) continue;
        for (const char c : {';', '\t'}) {
            if (line.find(c) != std::string_view::npos) return c;
        }
        break;
    }
    return ',';
}

// RFC 4180 with any of the separators.
class CsvReader {
public:
    CsvReader(const std::filesystem::path& file, std::string_view text, char separator)
        : file_(file), text_(text), separator_(separator) {}

    std::vector<CsvRow> rows() {
        row_.line = 1;
        for (std::size_t i = 0; i < text_.size(); ++i) {
            const char c = text_[i];
            if (at_start() && c == '#') {
                i = std::min(text_.find('\n', i), text_.size());
                new_line();
                continue;
            }
            if (c == '\n') ++line_;
            if (!quoted_) {
                plain(c);
            } else if (c != '"') {
                field_ += c;
            } else if (i + 1 < text_.size() && text_[i + 1] == '"') {
                field_ += '"';
                ++i;
            } else {
                quoted_ = false;
            }
        }
        if (quoted_) throw InputError(file_, row_.line, "a quoted field is never closed");
        if (!field_.empty() || !row_.fields.empty()) end_row();
        return std::move(rows_);
    }

private:
    bool at_start() const {
        return !quoted_ && !was_quoted_ && row_.fields.empty() && trimmed(field_).empty();
    }
    void new_line() {
        ++line_;
        row_.line = line_;
        field_.clear();
    }
    void plain(char c) {
        if (c == '"' && trimmed(field_).empty() && !was_quoted_) {
            field_.clear();
            quoted_ = was_quoted_ = true;
        } else if (c == separator_) {
            end_field();
        } else if (c == '\n') {
            end_row();
        } else if (!was_quoted_) {
            field_ += c;
        } else if (c != ' ' && c != '\t') {
            throw InputError(file_, line_, "text after a closing quote; put the quote at its end");
        }
    }
    void end_field() {
        row_.fields.emplace_back(trimmed(field_));
        field_.clear();
        was_quoted_ = false;
    }
    void end_row() {
        end_field();
        const bool comment = row_.fields[0].starts_with('#');
        if (!comment && !row_.is_blank() && !lower_case(row_.fields[0]).starts_with("sep=")) {
            rows_.push_back(row_);
        }
        row_.fields.clear();
        row_.line = line_;
    }

    const std::filesystem::path& file_;
    std::string_view text_;
    char separator_;
    std::vector<CsvRow> rows_;
    CsvRow row_;
    std::string field_;
    bool quoted_ = false, was_quoted_ = false;
    long line_ = 1;
};

}  // namespace

bool CsvRow::is_blank() const {
    return std::all_of(fields.begin(), fields.end(),
                       [](const std::string& field) { return field.empty(); });
}

CsvTable read_csv(const std::filesystem::path& file) {
    const std::string text = decoded_text(read_text(file, 64u << 20), file);
    const char separator = separator_of(text);
    return {CsvReader(file, text, separator).rows(), separator};
}

}  // namespace culet
