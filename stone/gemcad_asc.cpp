// GemCad .asc: records of a keyword and words; a line that begins with no keyword goes on with the
// tier before it. Lines that begin with `;` or `#` are comments.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "stone/cut_planes.h"
#include "stone/errors.h"
#include "stone/output_file.h"
#include "stone/text_decoding.h"
#include "stone/text_scan.h"

namespace culet {

namespace {

class AscParser {
public:
    AscParser(std::string_view text, const std::filesystem::path& file)
        : lines_(text), file_(file) {}

    void parse() {
        bool any = false;
        while (const auto line = lines_.next()) {
            const std::string_view content = trimmed(*line);
            if (content.empty() || content[0] == ';' || content[0] == '#') continue;
            if (!any && !lower_case(std::string(content)).starts_with("gemcad")) {
                throw InputError(
                    file_, lines_.line(),
                    fmt::format("is no GemCad design: one begins with GemCad, found '{}'",
                                shown(content)));
            }
            if (any) read(content);
            any = true;
        }
        if (!any) throw InputError(file_, "is empty");
        end_tier();
        if (!has_gear_) suppose_gear();
    }

    ReadCut cut;
    std::vector<CutPlane> planes;

private:
    void read(std::string_view line) {
        const std::vector<std::string_view> words = words_of(line);
        const std::string_view keyword = words[0];
        const std::string_view rest = trimmed(line.substr(keyword.size()));
        const std::span<const std::string_view> values(words.begin() + 1, words.end());
        if (goes_on_with_instruction(words)) return;
        if (keyword == "H") {
            cut.sheet.headings.emplace_back(rest);
        } else if (keyword == "F") {
            cut.sheet.footnotes.emplace_back(rest);
        } else if (keyword == "I") {
            cut.sheet.refractive_index = number(values, 0, "the refractive index after I");
        } else if (keyword == "y") {
            read_symmetry(values);
        } else if (keyword == "a") {
            read_tier(values);
        } else if (keyword == "g") {
            read_gear(values);
        } else if (keyword.size() > 1 && keyword[0] == 'g' && number_in(keyword.substr(1))) {
            // `g96 0.0`
            std::vector<std::string_view> split = words;
            split[0] = keyword.substr(1);
            read_gear(split);
        } else if (keyword == "p" && !awaits_name_) {
            throw InputError(file_, lines_.line(),
                             "a preform (p) is not read: take the line out if the preform is cut "
                             "away, or else give its facets as tiers (a)");
        } else if (in_tier_) {
            read_settings(words);
        } else if (number_in(keyword)) {
            // A gear line that has lost its g.
            read_gear(words);
        } else if (keyword != "GemCad") {
            throw InputError(
                file_, lines_.line(),
                fmt::format("'{}' begins no record: expected g, y, I, H, F or a", shown(keyword)));
        }
    }

    /// An instruction may run over lines, and the next may begin with a word that is a keyword: it
    /// is a record only where the record's number follows. Indices cannot stand there.
    bool goes_on_with_instruction(const std::vector<std::string_view>& words) const {
        if (!in_tier_ || !instruction_) return false;
        const std::string_view keyword = words[0];
        if (keyword == "H" || keyword == "F") return false;
        if (keyword == "a" || keyword == "g" || keyword == "y" || keyword == "I")
            return words.size() < 2 || !number_in(words[1]);
        if (std::all_of(words.begin(), words.end(), number_in)) {
            throw InputError(file_, lines_.line(),
                             "indices stand behind an instruction (G), which ends a tier: put them "
                             "before it");
        }
        return true;
    }

    double number(std::span<const std::string_view> values, std::size_t i, const char* what) {
        const auto value = i < values.size() ? number_in(values[i]) : std::nullopt;
        if (!value) {
            throw InputError(file_, lines_.line(),
                             fmt::format("expected {}, found {}", what,
                                         i < values.size() ? "'" + shown(values[i]) + "'"
                                                           : "the end of the line"));
        }
        return *value;
    }

    void read_gear(std::span<const std::string_view> values) {
        // Tiers before it would have been laid out on another gear.
        if (tier_number_ > 0) {
            throw InputError(file_, lines_.line(), "the gear must stand before the first tier");
        }
        has_gear_ = true;
        cut.sheet.gear = number(values, 0, "the count of the gear's teeth");
        if (!(std::abs(cut.sheet.gear) >= 1 && std::abs(cut.sheet.gear) <= 1e6) ||
            cut.sheet.gear != std::floor(cut.sheet.gear)) {
            throw InputError(file_, lines_.line(),
                             fmt::format("a gear of {} teeth cannot be: write a whole number, such "
                                         "as 96",
                                         cut.sheet.gear));
        }
        cut.sheet.gear_offset =
            values.size() > 1 ? number(values, 1, "the gear's offset in teeth") : 0;
        if (!(std::abs(cut.sheet.gear_offset) <= 1e6)) {
            throw InputError(file_, lines_.line(), "the gear's offset is beyond all teeth");
        }
    }

    void read_symmetry(std::span<const std::string_view> values) {
        const double order = number(values, 0, "the order of symmetry after y");
        cut.sheet.symmetry = order >= 1 && order <= 1e6 ? static_cast<int>(order) : 1;
        cut.sheet.mirror = values.size() > 1 && (values[1] == "y" || values[1] == "Y");
    }

    void read_tier(std::span<const std::string_view> values) {
        end_tier();
        const double angle = number(values, 0, "an angle in degrees after a");
        const double distance = number(values, 1, "a distance after the angle");
        if (!(std::abs(angle) <= 90)) {
            throw InputError(file_, lines_.line(),
                             fmt::format("an angle of {} degrees is outside -90..90", angle));
        }
        if (distance < 0 && angle != 0) {
            throw InputError(file_, lines_.line(),
                             fmt::format("a distance of {} cannot be: the pavilion is told by a "
                                         "negative angle, and distances by their size",
                                         distance));
        }
        tier_ = {std::abs(angle), std::signbit(angle) || (angle == 0 && std::signbit(distance)),
                 std::abs(distance), 0};
        ++tier_number_;
        tier_line_ = lines_.line();
        in_tier_ = true;
        read_settings(values.subspan(2));
    }

    /// A horizontal facet has no index, or any: its tier may go without.
    void end_tier() {
        if (!in_tier_) return;
        const bool has_facet = !planes.empty() && planes.back().tier == tier_number_;
        if (!has_facet && tier_.angle_deg != 0) {
            throw InputError(file_, tier_line_,
                             fmt::format("the tier at {}{} degrees has no index: give those of its "
                                         "facets behind the distance",
                                         tier_.pavilion ? "-" : "", tier_.angle_deg));
        }
        if (!has_facet) add_facet(0);
        in_tier_ = awaits_name_ = instruction_ = false;
    }

    void read_settings(std::span<const std::string_view> words) {
        for (const std::string_view word : words) {
            if (instruction_) return;
            if (awaits_name_) {
                awaits_name_ = false;
                const bool has_facet = !planes.empty() && planes.back().tier == tier_number_;
                (has_facet ? planes.back().name : name_) = word;
            } else if (word == "n") {
                awaits_name_ = true;
            } else if (word == "G") {
                instruction_ = true;
            } else if (const auto index = number_in(word); index && std::abs(*index) <= 1e9) {
                add_facet(*index);
            } else {
                throw InputError(
                    file_, lines_.line(),
                    fmt::format("expected an index, 'n NAME' or 'G', found '{}'", shown(word)));
            }
        }
    }

    void add_facet(double index) {
        tier_.index = index;
        planes.push_back({plane_of(tier_, cut.sheet), std::exchange(name_, {}),
                          fmt::format("tier {} ({}{} degrees), index {}", tier_number_,
                                      tier_.pavilion ? "-" : "", tier_.angle_deg, index),
                          tier_number_});
        settings_.push_back(tier_);
    }

    /// The gear that the design does not state: 96 (GemCad's own), unless the tiers fail to repeat
    /// about its axis and do so on one other gear of the trade alone.
    void suppose_gear() {
        constexpr double k_usual = 96;
        constexpr std::size_t k_most_facets = 1000;  // of whom all pairs are looked at
        std::vector<double> fitting;
        if (planes.size() <= k_most_facets && !repeats_on(k_usual)) {
            for (const double gear : {32, 36, 40, 48, 60, 64, 72, 77, 80, 84, 88, 90, 99, 100, 108,
                                      112, 120, 128, 144}) {
                if (repeats_on(gear)) fitting.push_back(gear);
            }
        }
        cut.sheet.gear = fitting.size() == 1 ? fitting[0] : k_usual;
        cut.sheet.gear_supposed = true;
        for (std::size_t i = 0; i < planes.size(); ++i)
            planes[i].plane = plane_of(settings_[i], cut.sheet);
        cut.notes.push_back(fmt::format(
            "the gear is not stated: {} teeth are supposed{}; if that is wrong, write a line such "
            "as \"g 96 0.0\" behind the first",
            cut.sheet.gear,
            fitting.size() == 1
                ? fmt::format(", on which the indices repeat as the symmetry asks, not 96")
                : ""));
    }

    /// True when a turn by the design's symmetry (where it states none, by any part of a turn from
    /// a half to a sixteenth) takes the facets of every tier to one another on a wheel of `gear`
    /// teeth, and no index is beyond it.
    bool repeats_on(double gear) const {
        const int stated = cut.sheet.symmetry;
        for (int order = stated > 1 ? stated : 2; order <= (stated > 1 ? stated : 16); ++order) {
            bool all = true;
            for (std::size_t i = 0; all && i < settings_.size(); ++i) {
                const CutSetting& one = settings_[i];
                if (one.angle_deg == 0) continue;
                all = one.index <= gear;
                bool found = false;
                for (std::size_t k = 0; all && !found && k < settings_.size(); ++k) {
                    const double apart = settings_[k].index - one.index - gear / order;
                    found = planes[k].tier == planes[i].tier &&
                            std::abs(std::remainder(apart, gear)) < k_same_index;
                }
                all = all && found;
            }
            if (all) return true;
        }
        return false;
    }

    static constexpr double k_same_index = 0.01;  ///< of a tooth; files give two decimals or more

    LineReader lines_;
    const std::filesystem::path& file_;
    CutSetting tier_;
    std::vector<CutSetting> settings_;  ///< of the planes
    std::string name_;                  ///< given before the tier's first index
    int tier_number_ = 0;
    long tier_line_ = 0;
    bool has_gear_ = false, in_tier_ = false, awaits_name_ = false, instruction_ = false;
};

}  // namespace

ReadCut parse_gemcad_asc(std::string_view bytes, const CutReading& how,
                         const std::filesystem::path& file) {
    const std::string text = decoded_text(bytes, file);
    AscParser parser(text, file);
    parser.parse();
    build_solid(parser.cut, parser.planes, how, file);
    return std::move(parser.cut);
}

ReadCut read_gemcad_asc(const std::filesystem::path& file, const CutReading& how) {
    return parse_gemcad_asc(read_text(file, std::size_t{16} << 20), how, file);
}

}  // namespace culet
