#include "stone/gemcad/gemcad_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stone/text/text_decoding.h"
#include "stone/text/text_scan.h"

namespace culet {

std::string gemcad_line(char keyword, const std::string& line) {
    std::string text = windows1252_from_utf8(line);
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    }
    return fmt::format("{} {}\n", keyword, text);
}

std::string gemcad_word(const std::string& name) {
    std::string word = windows1252_from_utf8(trimmed(name));
    for (char& c : word) {
        if (static_cast<unsigned char>(c) <= 0x20 || c == 0x7f) c = '_';
    }
    return word;
}

std::string gemcad_head(const Design& design, const std::optional<double>& refractive_index) {
    const bool whole = design.gear_offset == std::round(design.gear_offset);
    std::string out =
        fmt::format("GemCad 5.0\ng {} {}{}\ny {} {}\n", design.gear, design.gear_offset,
                    whole ? ".0" : "", design.symmetry, design.mirror ? "y" : "n");
    if (refractive_index) out += fmt::format("I {}\n", *refractive_index);
    for (const std::string& line : design.headings) out += gemcad_line('H', line);
    return out;
}

std::string gemcad_feet(const Design& design) {
    std::string out;
    for (const std::string& line : design.footnotes) out += gemcad_line('F', line);
    return out;
}

std::string design_text(const Design& design) {
    std::string out = gemcad_head(design, design.refractive_index);
    for (const auto& [key, value] : design.studio) out += gemcad_line('S', key + " " + value);
    for (const DesignTier& tier : design.tiers) {
        const CutSetting& cut = tier.setting;
        out += fmt::format("a {}{} {}", cut.pavilion ? "-" : "", cut.angle_deg,
                           std::max(0.0, cut.distance));
        for (const DesignFacet& facet : tier.facets) {
            out += fmt::format(" {}", facet.index);
            if (facet.facet.empty() && !tier.hidden) continue;
            if (!facet.label.empty()) out += " n " + gemcad_word(facet.label);
            if (!facet.facet.empty() && facet.label != facet.facet)
                out += " N " + gemcad_word(facet.facet);
        }
        if (tier.frosting > 0) out += fmt::format(" R {}", tier.frosting);
        if (tier.hidden) out += " X";
        if (tier.guide) out += " Y";
        out += tier.instruction.empty() ? "\n" : " " + gemcad_line('G', tier.instruction);
    }
    return utf8_from_windows1252(out + gemcad_feet(design));
}

}  // namespace culet
