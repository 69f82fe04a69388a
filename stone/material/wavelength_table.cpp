#include "stone/material/wavelength_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <utility>

#include "stone/text/csv.h"
#include "stone/text/errors.h"
#include "stone/text/text_scan.h"
#include "stone/text/written_number.h"

namespace culet {

namespace {

constexpr double k_visible_from_nm = 380, k_visible_to_nm = 780;

struct WavelengthUnit {
    const char* name;
    double nm;
    std::initializer_list<std::string_view> words;  ///< in headers, in lower case
};

// In the order in which they are tried.
const WavelengthUnit k_wavelength_units[] = {
    {"nm", 1, {"nm", "nanomet"}},
    {"micrometres", 1000, {"\u00b5m", "\u03bcm", "um", "micron", "micromet"}},
    {"Angstrom",
     0.1,
     {"\u00e5", "\u00c5", "\u212b", "angstrom", "\u00e5ngstr", "\u00c5ngstr", "a"}},
};

bool holds_any(const std::string& text, std::initializer_list<std::string_view> parts) {
    return std::any_of(parts.begin(), parts.end(),
                       [&](std::string_view part) { return text.find(part) != std::string::npos; });
}

// True when a word after the first (a column may be called `a`), or the only word, is one of
// `units` or begins with a spelt-out one. `wl_um` and `wavelength (nm)` have two words.
bool names_unit(std::string header, std::initializer_list<std::string_view> units) {
    constexpr std::size_t k_longest_sign = 3;
    for (char& c : header) {
        const bool letter = (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80;
        if (!letter) c = ' ';
    }
    const std::vector<std::string_view> words = words_of(header);
    for (std::size_t i = 0; i < words.size(); ++i) {
        for (const std::string_view unit : units) {
            if (unit.size() > k_longest_sign ? words[i].starts_with(unit)
                                             : words[i] == unit && (i > 0 || unit != "a"))
                return true;
        }
    }
    return false;
}

// With blanks between columns, a row is one field.
std::vector<std::string> cells_of(const CsvRow& row) {
    std::vector<std::string> cells;
    const bool by_blanks = row.fields.size() == 1;
    if (by_blanks) {
        for (const std::string_view word : words_of(row.fields[0])) cells.emplace_back(word);
    } else {
        cells = row.fields;
    }
    while (!cells.empty() && cells.back().empty()) cells.pop_back();
    return cells;
}

class WavelengthTable {
public:
    WavelengthTable(const std::filesystem::path& file, const char* quantity)
        : file_(file), quantity_(quantity) {}

    Spectrum read(std::vector<std::string>& notes) {
        const CsvTable table = read_csv(file_);
        for (const CsvRow& row : table.rows) read_row(row, table.separator == ',');
        if (points_.empty()) {
            throw InputError(file_, fmt::format("holds no numbers: expected lines of a wavelength "
                                                "in nm and a {}",
                                                quantity_));
        }
        std::stable_sort(points_.begin(), points_.end(), [](const Point& a, const Point& b) {
            return a.wavelength < b.wavelength;
        });
        for (std::size_t i = 1; i < points_.size(); ++i) {
            if (points_[i].wavelength > points_[i - 1].wavelength) continue;
            throw InputError(file_, std::max(points_[i].line, points_[i - 1].line),
                             fmt::format("the wavelength {} appears twice", points_[i].wavelength));
        }
        const WavelengthUnit& unit = unit_of(notes);
        const double factor = value_factor(notes);
        std::vector<double> nm, values;
        for (const Point& point : points_) {
            nm.push_back(point.wavelength * unit.nm);
            values.push_back(point.value * factor);
        }
        return Spectrum(nm, values);
    }

private:
    struct Point {
        double wavelength, value;
        long line;
    };

    void read_row(const CsvRow& row, bool comma_separates) {
        const std::vector<std::string> cells = cells_of(row);
        const WrittenNumber wavelength = written_number(cells[0], comma_separates);
        if (!wavelength.problem.empty()) {
            if (header_.empty() && points_.empty()) {
                // With blanks between columns, the unit is separate from the name.
                for (const std::string& cell : cells) {
                    if (!header_.empty() && (cell[0] == '(' || cell[0] == '[')) {
                        header_.back() += ' ' + cell;
                    } else {
                        header_.push_back(cell);
                    }
                }
                return;
            }
            throw InputError(file_, row.line,
                             fmt::format("expected a wavelength, found '{}'{}", shown(cells[0]),
                                         points_.empty() ? ""
                                                         : ": of two tables in one file, keep that "
                                                           "of the " +
                                                               std::string(quantity_)));
        }
        if (!wavelength.unit.word.empty()) {
            throw InputError(file_, row.line,
                             fmt::format("'{}': write the wavelength's unit in the header, wl_um,n",
                                         shown(cells[0])));
        }
        if (cells.size() != 2) {
            throw InputError(file_, row.line,
                             fmt::format("expected two columns, wavelength and {}, found {}: take "
                                         "the others out",
                                         quantity_, cells.size()));
        }
        const WrittenNumber value = written_number(cells[1], comma_separates);
        if (!value.problem.empty() || !value.unit.word.empty()) {
            throw InputError(file_, row.line,
                             value.problem.empty()
                                 ? fmt::format("'{}' is not a number alone", shown(cells[1]))
                                 : fmt::format("{} {}", quantity_, value.problem));
        }
        points_.push_back({wavelength.value, value.value, row.line});
    }

    bool covers_light(double from_nm, double to_nm, double nm) const {
        return points_.front().wavelength * nm <= to_nm &&
               points_.back().wavelength * nm >= from_nm;
    }
    bool is_visible(const WavelengthUnit& unit) const {
        return covers_light(k_visible_from_nm, k_visible_to_nm, unit.nm);
    }

    const WavelengthUnit& unit_of(std::vector<std::string>& notes) const {
        const std::string range =
            fmt::format("{} to {}", points_.front().wavelength, points_.back().wavelength);
        const std::string named = header_.empty() ? std::string() : lower_case(header_[0]);
        if (holds_any(named, {"cm-1", "cm^-1", "1/cm", "wavenumber"}) ||
            names_unit(named, {"ev", "hz", "thz"})) {
            throw InputError(file_, fmt::format("its first column is '{}': expected wavelengths "
                                                "in nm",
                                                shown(header_[0])));
        }
        for (const WavelengthUnit& unit : k_wavelength_units) {
            if (!names_unit(named, unit.words)) continue;
            if (is_visible(unit)) return unit;
            throw InputError(file_, fmt::format("wavelengths from {} {} are not visible light: is "
                                                "the unit in the header right?",
                                                range, unit.name));
        }
        const WavelengthUnit* found = nullptr;
        for (const WavelengthUnit& unit : k_wavelength_units) {
            if (found == nullptr && is_visible(unit)) found = &unit;
        }
        // Numbers in the thousands may be wavenumbers per centimetre.
        const double first = points_.front().wavelength, last = points_.back().wavelength;
        const bool waves_per_cm = first <= 1e7 / k_visible_from_nm && last >= 1e7 / k_visible_to_nm;
        if (found == nullptr || (found->nm < 1 && waves_per_cm)) {
            throw InputError(file_,
                             fmt::format("wavelengths from {} {}: write them in nm (visible light "
                                         "is 380 to 780)",
                                         range,
                                         found == nullptr ? "are not visible light in any unit"
                                                          : "may be Angstrom or wave numbers"));
        }
        if (found->nm != 1) {
            notes.push_back(fmt::format("{}: wavelengths from {} are taken as {}",
                                        file_.filename().string(), range, found->name));
        }
        return *found;
    }

    double value_factor(std::vector<std::string>& notes) const {
        if (header_.size() < 2 ||
            !holds_any(lower_case(header_[1]),
                       {"1/cm", "cm-1", "cm^-1", "/cm", "per cm", "cm\u207b\u00b9"}))
            return 1;
        notes.push_back(fmt::format("{}: values per cm (by its header) were made values per mm",
                                    file_.filename().string()));
        return 0.1;
    }

    const std::filesystem::path& file_;
    const char* quantity_;
    std::vector<std::string> header_;
    std::vector<Point> points_;
};

}  // namespace

Spectrum read_wavelength_table(const std::filesystem::path& file, const char* quantity,
                               std::vector<std::string>& notes) {
    return WavelengthTable(file, quantity).read(notes);
}

}  // namespace culet
