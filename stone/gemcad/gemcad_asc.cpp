// GemCad .asc: records of a keyword and words. A line that does not begin with a keyword continues
// the tier before it. Lines that begin with `;` or `#` are comments.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "stone/design/repeating_gear.h"
#include "stone/gemcad/cut_planes.h"
#include "stone/text/errors.h"
#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

class AscParser {
public:
    /// In a mesh's lines, `N NAME` gives the name of a facet that is not called by its label, and
    /// of a .gcs `S KEY VALUE` its words, `R` a tier's frosting, `X` that it is hidden, `Y` a
    /// guide.
    AscParser(std::string_view text, const std::filesystem::path& file, bool of_a_mesh = false)
        : lines_(text), file_(file), of_a_mesh_(of_a_mesh) {}

    void parse() {
        bool any = false;
        while (const auto line = lines_.next()) {
            const std::string_view content = trimmed(*line);
            if (content.empty() || content[0] == ';' || content[0] == '#') continue;
            if (!any && !lower_case(std::string(content)).starts_with("gemcad")) {
                throw InputError(
                    file_, lines_.line(),
                    fmt::format("is not a GemCad design: one begins with GemCad, found '{}'",
                                shown(content)));
            }
            if (any) read(content);
            any = true;
        }
        if (!any) throw InputError(file_, "is empty");
        end_tier();
        if (!has_gear_) suppose_gear();
    }

    ReadCut cut;  // collects the notes
    Design design;
    std::vector<CutPlane> planes;

private:
    void read(std::string_view line) {
        const std::vector<std::string_view> words = words_of(line);
        const std::string_view keyword = words[0];
        const std::string_view rest = trimmed(line.substr(keyword.size()));
        const auto values = std::span<const std::string_view>(words).subspan(1);
        if (goes_on_with_instruction(words)) return instruct(line);
        if (keyword == "H") {
            design.headings.emplace_back(rest);
        } else if (keyword == "F") {
            design.footnotes.emplace_back(rest);
        } else if (keyword == "I") {
            design.refractive_index = number(values, 0, "the refractive index after I");
        } else if (keyword == "y") {
            read_symmetry(values);
        } else if (keyword == "S" && of_a_mesh_ && words.size() > 1) {
            design.studio[std::string(words[1])] =
                trimmed(rest.substr(std::min(rest.size(), words[1].size())));
        } else if (keyword == "a") {
            read_tier(values, line);
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
            read_settings(words, line);
        } else if (number_in(keyword)) {
            // A gear line without its g.
            read_gear(words);
        } else if (keyword != "GemCad") {
            throw InputError(
                file_, lines_.line(),
                fmt::format("'{}' begins no record: expected g, y, I, H, F or a", shown(keyword)));
        }
    }

    /// An instruction may take several lines, and one may begin with a keyword's letter. It is a
    /// record only if the record's number follows, since indices cannot stand there.
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
        // Earlier tiers would have been computed with another gear.
        if (tier_number_ > 0) {
            throw InputError(file_, lines_.line(), "the gear must stand before the first tier");
        }
        has_gear_ = true;
        design.gear = number(values, 0, "the count of the gear's teeth");
        if (!(std::abs(design.gear) >= 1 && std::abs(design.gear) <= 1e6) ||
            design.gear != std::floor(design.gear)) {
            throw InputError(
                file_, lines_.line(),
                fmt::format("a gear cannot have {} teeth: write a whole number, such as 96",
                            design.gear));
        }
        design.gear_offset =
            values.size() > 1 ? number(values, 1, "the gear's offset in teeth") : 0;
        if (!(std::abs(design.gear_offset) <= 1e6)) {
            throw InputError(file_, lines_.line(), "the gear's offset is beyond all teeth");
        }
    }

    void read_symmetry(std::span<const std::string_view> values) {
        const double order = number(values, 0, "the order of symmetry after y");
        design.symmetry = order >= 1 && order <= 1e6 ? static_cast<int>(order) : 1;
        design.mirror = values.size() > 1 && (values[1] == "y" || values[1] == "Y");
    }

    void read_tier(std::span<const std::string_view> values, std::string_view line) {
        end_tier();
        const double angle = number(values, 0, "an angle in degrees after a");
        const double distance = number(values, 1, "a distance after the angle");
        if (!(std::abs(angle) <= 90)) {
            throw InputError(file_, lines_.line(),
                             fmt::format("an angle of {} degrees is outside -90..90", angle));
        }
        if (distance < 0 && angle != 0) {
            throw InputError(
                file_, lines_.line(),
                fmt::format(
                    "a distance cannot be {}: give its size, and for the pavilion a negative angle",
                    distance));
        }
        tier_ = {std::abs(angle), std::signbit(angle) || (angle == 0 && std::signbit(distance)),
                 std::abs(distance), 0};
        ++tier_number_;
        design.tiers.push_back({tier_, {}, {}});
        tier_line_ = lines_.line();
        in_tier_ = true;
        read_settings(values.subspan(2), line);
    }

    /// A horizontal facet needs no index.
    void end_tier() {
        if (!in_tier_) return;
        const bool has_facet = !design.tiers.back().facets.empty();
        if (!has_facet && tier_.angle_deg != 0) {
            throw InputError(file_, tier_line_,
                             fmt::format("the tier at {}{} degrees has no index: give those of its "
                                         "facets behind the distance",
                                         tier_.pavilion ? "-" : "", tier_.angle_deg));
        }
        if (!has_facet) add_facet(0);
        in_tier_ = awaits_name_ = instruction_ = false;
    }

    void read_settings(std::span<const std::string_view> words, std::string_view line) {
        for (const std::string_view word : words) {
            if (awaits_name_) {
                awaits_name_ = false;
                std::vector<DesignFacet>& facets = design.tiers.back().facets;
                if (facets.empty()) {
                    name_ = word;
                } else {
                    facets.back().label = planes.back().name = word;
                }
            } else if (awaits_facet_) {
                awaits_facet_ = false, awaits_frosting_ = false;
                if (!design.tiers.back().facets.empty())
                    design.tiers.back().facets.back().facet = word;
            } else if (awaits_frosting_) {
                awaits_frosting_ = false;
                design.tiers.back().frosting = number_in(word).value_or(0);
            } else if (of_a_mesh_ && (word == "R" || word == "X" || word == "Y")) {
                awaits_frosting_ = word == "R";
                design.tiers.back().hidden |= word == "X";
                design.tiers.back().guide |= word == "Y";
            } else if (word == "n") {
                awaits_name_ = true;
            } else if (word == "N" && of_a_mesh_) {
                awaits_facet_ = true;
            } else if (word == "G") {
                instruction_ = true;
                return instruct(line.substr(std::size_t(word.data() + 1 - line.data())));
            } else if (const auto index = number_in(word); index && std::abs(*index) <= 1e9) {
                add_facet(*index);
            } else {
                throw InputError(
                    file_, lines_.line(),
                    fmt::format("expected an index, 'n NAME' or 'G', found '{}'", shown(word)));
            }
        }
    }

    void instruct(std::string_view words) {
        std::string& text = design.tiers.back().instruction;
        const std::string_view more = trimmed(words);
        if (!text.empty() && !more.empty()) text += ' ';
        text += more;
    }

    void add_facet(double index) {
        tier_.index = index;
        DesignTier& tier = design.tiers.back();
        planes.push_back({plane_of(tier_, design), name_,
                          fmt::format("tier {} ({}{} degrees), index {}", tier_number_,
                                      tier_.pavilion ? "-" : "", tier_.angle_deg, index),
                          tier_number_ - 1, static_cast<int>(tier.facets.size())});
        tier.facets.push_back({index, std::exchange(name_, {}), {}});
    }

    void suppose_gear() {
        const std::optional<double> repeating = repeating_gear(design);
        design.gear = repeating.value_or(k_usual_gear);
        design.gear_supposed = true;
        for (CutPlane& plane : planes) {
            const DesignTier& tier = design.tiers[std::size_t(plane.tier)];
            CutSetting setting = tier.setting;
            setting.index = tier.facets[std::size_t(plane.facet)].index;
            plane.plane = plane_of(setting, design);
        }
        cut.notes.push_back(fmt::format(
            "the gear is not stated: {} teeth are assumed{}; if that is wrong, write a line such "
            "as \"g 96 0.0\" behind the first",
            design.gear,
            repeating ? ", on which the indices repeat as the symmetry asks, not 96" : ""));
    }

    LineReader lines_;
    const std::filesystem::path& file_;
    const bool of_a_mesh_;
    CutSetting tier_;
    std::string name_;  ///< given before the tier's first index
    int tier_number_ = 0;
    long tier_line_ = 0;
    bool has_gear_ = false, in_tier_ = false, awaits_name_ = false, instruction_ = false,
         awaits_facet_ = false, awaits_frosting_ = false;
};

}  // namespace

ReadCut parse_gemcad_asc(std::string_view bytes, const CutReading& how,
                         const std::filesystem::path& file) {
    const std::string text = decoded_text(bytes, file);
    AscParser parser(text, file);
    parser.parse();
    build_solid(parser.cut, std::move(parser.design), parser.planes, how, file);
    return std::move(parser.cut);
}

Design design_in(std::string_view text) {
    const std::filesystem::path file = "design";
    AscParser parser(text, file, true);
    parser.parse();
    for (DesignTier& tier : parser.design.tiers) {
        for (DesignFacet& facet : tier.facets) {
            if (facet.facet.empty() && !tier.hidden) facet.facet = facet.label;
        }
    }
    return std::move(parser.design);
}

}  // namespace culet
