#include "studio/described_stone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>

#include "stone/cuts/cuts.h"
#include "stone/material/material.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

constexpr std::size_t k_longest = 200;
constexpr const char* k_number = R"((\d+(?:\.\d+)?))";

struct CutWords {
    const char *pattern, *kind;
};
// The first that is found counts: "emerald cut" before the material emerald.
constexpr CutWords k_cut_words[] = {
    {"(emerald|step)[ -]?cut|octagon|baguette", "step"},
    {"(round|standard|modern)?[ -]?brilliant([ -]?cut)?|round", "round-brilliant"},
    {"princess([ -]?cut)?", "princess"},
    {"asscher([ -]?cut)?", "asscher"},
    {"oval([ -]?cut)?", "oval"},
    {"marquise|navette", "marquise"},
    {"pear([ -]?shape(d)?)?|(tear)?drop", "pear"},
    {"trillion|trilliant|triangle", "trillion"},
    {"cushion|antique", "cushion"},
    {"heart([ -]?shape(d)?)?", "heart"},
};

// Cuts what matches out of the text. Its groups: empty where there is none.
std::optional<std::vector<std::string>> taken(std::string& text, const std::string& pattern) {
    std::smatch match;
    if (!std::regex_search(text, match, std::regex(R"((?:^|\s))" + pattern + R"((?=\s|$))")))
        return std::nullopt;
    std::vector<std::string> groups(match.begin(), match.end());
    text = match.prefix().str() + "  " + match.suffix().str();
    return groups;
}

std::string plain_words(const std::string& given) {
    std::string text = lower_case(given);
    text = std::regex_replace(text, std::regex("\xC3\x97"), " x ");
    text = std::regex_replace(text, std::regex(R"((\d),(\d))"), "$1.$2");
    text = std::regex_replace(text, std::regex(R"([,;:()])"), " ");
    // Units and the sign x stand apart.
    text = std::regex_replace(
        text, std::regex(R"((\d)\s*(mm|cts?|carats?|%|deg(rees)?|\xC2\xB0|x|by)(?=[\s\d]|$))"),
        "$1 $2 ");
    return std::regex_replace(text, std::regex(R"(\s+)"), " ");
}

bool has(const CutKind& kind, const char* parameter) {
    return std::any_of(kind.parameters.begin(), kind.parameters.end(),
                       [&](const CutParameter& p) { return p.name == parameter; });
}

void set_size(const CutKind& kind, double length, double width, DescribedStone& stone) {
    if (has(kind, "diameter")) {
        stone.values["diameter"] = (length + width) / 2;
        if (length > 1.02 * width)
            stone.notes.push_back("a round stone has one diameter: the mean is taken");
        return;
    }
    stone.values["width"] = width;
    if (has(kind, "ratio")) stone.values["ratio"] = length / width;
}

void take_size(const CutKind& kind, std::string& text, DescribedStone& stone) {
    const std::string by = std::string(k_number) + R"( ?(?:mm )?(?:x|by) ?)" + k_number;
    if (auto match = taken(text, by + R"((?: ?(?:mm )?(?:x|by) ?)" + k_number + R"()?(?: mm)?)")) {
        const double a = std::stod((*match)[1]), b = std::stod((*match)[2]);
        set_size(kind, std::max(a, b), std::min(a, b), stone);
        if (!(*match)[3].empty())
            stone.notes.push_back("the depth follows from the angles: " + (*match)[3] +
                                  " mm is not taken");
    } else if (auto one = taken(text, std::string(k_number) + " mm")) {
        const double size = std::stod((*one)[1]);
        const bool is_round = has(kind, "diameter");
        stone.values[is_round ? "diameter" : "width"] = size;
        if (!is_round) stone.notes.push_back("one length alone is the width");
    }
}

// "table 57 %", "57 % table", "crown angle 34.5".
void take_proportions(const CutKind& kind, std::string& text, DescribedStone& stone) {
    for (const CutParameter& parameter : kind.parameters) {
        std::string name = parameter.name;
        std::replace(name.begin(), name.end(), '-', ' ');
        std::string words = name;
        for (const char* const end : {" angle", " height", " depth"}) {
            if (name.ends_with(end))
                words = name.substr(0, name.size() - std::string(end).size()) + "(?:" + end + ")?";
        }
        const std::string unit = R"((?: (?:%|deg|degrees|\xC2\xB0))?)";
        auto match = taken(text, words + " " + k_number + unit);
        if (!match) match = taken(text, std::string(k_number) + unit + " " + words);
        if (match) stone.values[parameter.name] = std::stod((*match)[1]);
    }
}

void take_material(std::string& text, DescribedStone& stone) {
    const std::string words(trimmed(text));
    if (words.empty()) return;
    try {
        stone.material = catalogue_material(words).id;
    } catch (const InputError&) {
        const std::vector<std::string> like = catalogue_names_like(words);
        const std::string first = words.substr(0, words.find(' '));
        const auto named = [&](const std::string& name) {
            return name.find(first) != std::string::npos ||
                   lower_case(catalogue_material(name).usual_colour).find(first) !=
                       std::string::npos;
        };
        if (like.empty() || !named(like.front())) {
            stone.notes.push_back("not understood: " + words);
            return;
        }
        stone.material = like.front();
        if (like.size() > 1)
            stone.notes.push_back(fmt::format("{}: {} is taken; there are {} too", words,
                                              like.front(),
                                              fmt::join(like.begin() + 1, like.end(), ", ")));
    }
    text.clear();
}

void take_weight(double carats, DescribedStone& stone) {
    if (stone.material.empty()) {
        stone.notes.push_back("a weight gives a size only with a material: name one");
        return;
    }
    const Solid solid = make_cut(stone.kind, stone.values);
    const auto density = catalogue_material(stone.material).density_g_cm3;
    if (!density) return;
    const double size = std::cbrt(carats / carat(volume(solid), *density));
    const CutKind& kind = cut_kind(stone.kind);
    const char* const length = has(kind, "diameter") ? "diameter" : "width";
    for (const CutParameter& parameter : kind.parameters) {
        if (parameter.name != length) continue;
        const auto given = stone.values.find(length);
        const double now = given == stone.values.end() ? parameter.value : given->second;
        stone.values[length] = std::round(1000 * size * now) / 1000;
    }
}

}  // namespace

DescribedStone described_stone(const std::string& given) {
    if (given.size() > k_longest)
        throw InputError("say it in fewer words: \"9 x 7 oval, tourmaline\"");
    std::string text = plain_words(given);
    DescribedStone stone;
    for (const CutWords& words : k_cut_words) {
        if (stone.kind.empty() && taken(text, "(?:" + std::string(words.pattern) + ")"))
            stone.kind = words.kind;
    }
    const bool named = !stone.kind.empty();
    if (!named) stone.kind = "round-brilliant";
    const CutKind& kind = cut_kind(stone.kind);
    const auto weight = taken(text, std::string(k_number) + R"( (?:cts?|carats?))");
    const double carats = weight ? std::stod((*weight)[1]) : 0;
    take_size(kind, text, stone);
    take_proportions(kind, text, stone);
    while (taken(text, "(?:an?|the|of|in|with|cut|stone)")) {
    }
    text = std::regex_replace(text, std::regex(R"(\s+)"), " ");
    take_material(text, stone);
    if (weight) take_weight(carats, stone);
    if (!named && stone.values.empty() && stone.material.empty())
        throw InputError(
            "not understood: say a cut, its size, a material, as in \"9 x 7 oval, "
            "tourmaline\"");
    if (!named) stone.notes.emplace_back("no cut is named: a round brilliant");
    make_cut(stone.kind, stone.values);  // throws where the proportions cannot be
    return stone;
}

}  // namespace culet
