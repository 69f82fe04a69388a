// GemCad .asc: records of a keyword and words; a line that begins with no keyword goes on with the
// tier before it.

#include <fmt/format.h>

#include <cmath>

#include "stone/cut_planes.h"
#include "stone/errors.h"
#include "stone/output_file.h"
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
            if (content.empty()) continue;
            if (!any && !content.starts_with("GemCad")) {
                throw InputError(
                    file_, lines_.line(),
                    fmt::format("a GemCad design begins with GemCad, found '{}'", shown(content)));
            }
            if (any) read(content);
            any = true;
        }
        if (!any) throw InputError(file_, "is empty");
    }

    ReadCut cut;
    std::vector<CutPlane> planes;

private:
    void read(std::string_view line) {
        const std::vector<std::string_view> words = words_of(line);
        const std::string_view keyword = words[0];
        const std::string_view rest = trimmed(line.substr(keyword.size()));
        const std::span<const std::string_view> values(words.begin() + 1, words.end());
        if (keyword == "H") {
            cut.sheet.headings.push_back(utf8_from_windows1252(rest));
        } else if (keyword == "F") {
            cut.sheet.footnotes.push_back(utf8_from_windows1252(rest));
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

    double number(std::span<const std::string_view> values, std::size_t i, const char* what) {
        const auto value = i < values.size() ? number_in(values[i]) : std::nullopt;
        if (!value) {
            throw InputError(
                file_, lines_.line(),
                fmt::format("expected {}, found '{}'", what,
                            i < values.size() ? shown(values[i]) : "the end of the line"));
        }
        return *value;
    }

    void read_gear(std::span<const std::string_view> values) {
        // Tiers before it would have been laid out on another gear.
        if (!planes.empty()) {
            throw InputError(file_, lines_.line(), "the gear must stand before the first tier");
        }
        cut.sheet.gear = number(values, 0, "the count of the gear's teeth");
        if (!(std::abs(cut.sheet.gear) >= 1 && std::abs(cut.sheet.gear) <= 1e6)) {
            throw InputError(file_, lines_.line(),
                             fmt::format("a gear of {} teeth cannot be", cut.sheet.gear));
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
        const double angle = number(values, 0, "an angle in degrees after a");
        const double distance = number(values, 1, "a distance after the angle");
        if (!(std::abs(angle) <= 90)) {
            throw InputError(file_, lines_.line(),
                             fmt::format("an angle of {} degrees is outside -90..90", angle));
        }
        tier_ = {std::abs(angle), std::signbit(angle) || (angle == 0 && std::signbit(distance)),
                 std::abs(distance), 0};
        ++tier_number_;
        in_tier_ = true;
        awaits_name_ = instruction_ = false;
        read_settings(values.subspan(2));
    }

    void read_settings(std::span<const std::string_view> words) {
        for (const std::string_view word : words) {
            if (instruction_) return;
            if (awaits_name_) {
                awaits_name_ = false;
                if (tier_of_last_ != tier_number_) {
                    throw InputError(file_, lines_.line(),
                                     fmt::format("the name '{}' follows no index", shown(word)));
                }
                planes.back().name = utf8_from_windows1252(word);
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
        tier_of_last_ = tier_number_;
        planes.push_back({plane_of(tier_, cut.sheet), "",
                          fmt::format("tier {} ({}{} degrees), index {}", tier_number_,
                                      tier_.pavilion ? "-" : "", tier_.angle_deg, index),
                          tier_number_});
    }

    LineReader lines_;
    const std::filesystem::path& file_;
    CutSetting tier_;
    int tier_number_ = 0, tier_of_last_ = 0;
    bool in_tier_ = false, awaits_name_ = false, instruction_ = false;
};

}  // namespace

ReadCut parse_gemcad_asc(std::string_view text, const CutReading& how,
                         const std::filesystem::path& file) {
    AscParser parser(text, file);
    parser.parse();
    build_solid(parser.cut, parser.planes, how, file);
    return std::move(parser.cut);
}

ReadCut read_gemcad_asc(const std::filesystem::path& file, const CutReading& how) {
    return parse_gemcad_asc(read_text(file, std::size_t{16} << 20), how, file);
}

}  // namespace culet
