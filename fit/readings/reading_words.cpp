#include "fit/readings/reading_words.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "fit/readings/reading_kinds.h"
#include "stone/text/name_suggestions.h"
#include "stone/text/text_scan.h"
#include "stone/text/toml_file.h"

namespace culet {

namespace {

using Trade = KindWord::Trade;

struct Synonym {
    const char* word;
    KindWord means;
};

constexpr std::array<Synonym, 18> k_synonyms{{
    {"angle", {ReadingKind::inclination, Trade::none}},
    {"slope", {ReadingKind::inclination, Trade::none}},
    {"crown_angle", {ReadingKind::inclination, Trade::crown_angle}},
    {"pavilion_angle", {ReadingKind::inclination, Trade::pavilion_angle}},
    {"index", {ReadingKind::azimuth, Trade::index}},
    {"diameter", {ReadingKind::width, Trade::diameter}},
    {"height", {ReadingKind::depth, Trade::none}},
    {"total_height", {ReadingKind::depth, Trade::none}},
    {"total_depth", {ReadingKind::depth, Trade::none}},
    {"table", {ReadingKind::table_width, Trade::table}},
    {"table_size", {ReadingKind::table_width, Trade::table}},
    {"table_diameter", {ReadingKind::table_width, Trade::table}},
    {"carat", {ReadingKind::weight, Trade::none}},
    {"carats", {ReadingKind::weight, Trade::none}},
    {"carat_weight", {ReadingKind::weight, Trade::none}},
    {"ct", {ReadingKind::weight, Trade::none}},
    {"edge_length", {ReadingKind::edge, Trade::none}},
    {"dihedral_angle", {ReadingKind::dihedral, Trade::none}},
}};

std::string plain_word(std::string_view written) {
    std::string word;
    for (const char c : trimmed(written)) {
        word += c == ' ' || c == '-'
                    ? '_'
                    : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return word;
}

}  // namespace

std::vector<std::string> split_names(std::string_view text) {
    std::vector<std::string> names;
    int depth = 0;
    std::string name;
    for (const char c : text) {
        if (c == '(') ++depth;
        if (c == ')') --depth;
        if (c == '/' && depth <= 0) {
            names.emplace_back(trimmed(name));
            name.clear();
        } else {
            name += c;
        }
    }
    names.emplace_back(trimmed(name));
    if (names.size() == 1 && names[0].empty()) names.clear();
    return names;
}

std::optional<KindWord> kind_word(std::string_view written) {
    const std::string word = plain_word(written);
    if (const auto kind = reading_kind(word)) return KindWord{*kind, Trade::none};
    for (const Synonym& synonym : k_synonyms) {
        if (word == synonym.word) return synonym.means;
    }
    return std::nullopt;
}

std::optional<std::string> near_kind_word(std::string_view written) {
    const std::string word = plain_word(written.substr(0, 64));
    if (word.size() < 2) return std::nullopt;
    std::vector<std::string> known = written_kinds();
    for (const Synonym& synonym : k_synonyms) known.emplace_back(synonym.word);
    for (const std::string& name : known) {
        if (word.size() >= 3 && name.starts_with(word)) return name;
    }
    const auto near = nearest_name(word, known);
    // If more than a third of the letters differ, it is another word.
    if (near && edit_distance(word, *near) > std::max<std::size_t>(1, (word.size() + 1) / 3)) {
        return std::nullopt;
    }
    return near;
}

void mark_blank(WrittenReading& reading) {
    const auto kind = kind_word(reading.kind);
    reading.skipped =
        kind && !is_relation(kind->kind) && !reading.value && !reading.exact && !reading.released;
}

}  // namespace culet
