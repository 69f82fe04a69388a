// Puts a cutting list into words.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stone/design/cutting_list.h"

namespace culet {

namespace {

std::string joined(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

}  // namespace

const char* name_of(StonePart part) {
    switch (part) {
        case StonePart::table:
            return "table";
        case StonePart::crown:
            return "crown";
        case StonePart::girdle:
            return "girdle";
        case StonePart::pavilion:
            return "pavilion";
        case StonePart::culet:
            break;
    }
    return "culet";
}

std::string depth_words(const CuttingStep& step, const std::string& unit, double width) {
    const CutDepth& depth = step.depth;
    const std::string length = unit.empty() ? fmt::format("{:.4f} W", depth.length / width)
                                            : fmt::format("{:.2f} {}", depth.length, unit);
    std::string words;
    switch (depth.to) {
        case CutDepth::To::meet:
            words = "meet " + joined(depth.at);
            break;
        case CutDepth::To::pair:
            words = "meet its neighbour on " + joined(depth.at);
            break;
        case CutDepth::To::point:
            words = "centre point " + length + " from the girdle";
            break;
        case CutDepth::To::width:
            words = "width " + length;
            break;
        case CutDepth::To::height:
            words = "height " + length;
            break;
        case CutDepth::To::leave:
            words = "leave " + length + " of " + joined(depth.at);
            break;
        case CutDepth::To::distance:
            words = length + " from the middle";
            break;
        case CutDepth::To::none:
            words = "cut away later";
            break;
    }
    if (step.instruction.empty()) return words;
    const bool said = depth.to == CutDepth::To::meet || depth.to == CutDepth::To::pair;
    std::string own = step.instruction;
    if (own.ends_with('.')) own.pop_back();
    return said ? step.instruction : own + "; " + words;
}

namespace {

bool any_index(const CuttingStep& step) {
    return step.part == StonePart::table || step.part == StonePart::culet;
}

std::string setting_words(const IndexSetting& own, const char* between, int digits) {
    std::string text;
    for (std::size_t i = 0; i < own.teeth.size(); ++i) {
        const IndexSetting::Tooth& tooth = own.teeth[i];
        const bool apart = i > 0 && (tooth.own_deg > 0 || own.teeth[i - 1].own_deg > 0);
        text += fmt::format("{}{:0{}}", i == 0 ? "" : apart ? ", " : between, tooth.tooth, digits);
        if (tooth.own_deg > 0) text += fmt::format(" at {:.1f}", tooth.own_deg);
    }
    if (own.cheater != 0) text += fmt::format(" (cheater {:+.2f})", own.cheater);
    return text;
}

}  // namespace

std::string index_words(const CuttingStep& step) {
    if (any_index(step)) return "any";
    std::string text;
    for (const IndexSetting& own : step.settings)
        text += (text.empty() ? "" : ", ") + setting_words(own, " ", 1);
    return text;
}

std::string printed_indices(const CuttingStep& step, double gear) {
    if (any_index(step)) return "any";
    const int last = int(std::lround(gear)), digits = int(std::to_string(last).size());
    std::string text;
    for (IndexSetting own : step.settings) {
        std::stable_partition(
            own.teeth.begin(), own.teeth.end(),
            [&](const IndexSetting::Tooth& tooth) { return tooth.tooth == last; });
        text += (text.empty() ? "" : ", ") + setting_words(own, "-", digits);
    }
    return text;
}

std::string facet_count_words(const Solid& solid) {
    const int table = table_facet(solid, {0, 0, 1});
    std::size_t girdle = 0;
    for (std::size_t f = 0; f < solid.facets.size(); ++f)
        girdle += part_of(solid, static_cast<int>(f), table, {0, 0, 1}) == StonePart::girdle;
    return fmt::format("{} + {}", solid.facets.size() - girdle, girdle);
}

}  // namespace culet
