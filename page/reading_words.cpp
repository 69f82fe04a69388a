#include "page/reading_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "page/fit_fields.h"
#include "page/html.h"

namespace culet {

namespace {

using Json = nlohmann::json;

// A tenth of the variance is five per cent of the uncertainty; a smaller gain is not worth the
// work.
constexpr double k_worth_it = 0.1;

bool is_number(const std::string& text) {
    return !text.empty() && text.find_first_not_of("+-.0123456789") == std::string::npos;
}

std::string order(const Json& help) {
    const std::string kind = text_at(help, "kind");
    if (kind == "weight") return "weigh the stone";
    if (kind == "azimuth") return "read the azimuth (the index) of " + listed(names_of(help));
    const bool length = reading_unit(kind, "mm") == "mm";
    return (length || kind == "volume" ? "measure the " : "read the ") + reading_words(help);
}

}  // namespace

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    }
    return text;
}

std::string reading_unit(const std::string& kind, const std::string& length_unit) {
    constexpr std::array k_angles{"inclination", "azimuth",  "dihedral",
                                  "parallel",    "rotation", "mirror"};
    if (std::find(k_angles.begin(), k_angles.end(), kind) != k_angles.end()) return "deg";
    if (kind == "weight") return "ct";
    if (kind == "line") return "px";
    return kind == "volume" ? "mm3" : length_unit;
}

std::string reading_words(const Json& reading) {
    const std::string kind = text_at(reading, "kind"), of = listed(names_of(reading));
    if (of.empty()) return kind;
    if (kind == "width" || kind == "table_width") {
        const std::string what = kind == "width" ? "width" : "table's width";
        return is_number(of) ? what + " at " + of + "°" : what + " along " + of;
    }
    if (kind == "dihedral") return "angle between " + of;
    if (kind == "edge" || kind == "distance" || kind == "line") return kind + " between " + of;
    return kind + " of " + of;
}

std::string next_reading_words(const Json& help) {
    const bool closes = true_at(help, "closes");
    const double reduces = std::clamp(number_at(help, "reduces").value_or(0), 0.0, 1.0);
    if (text_at(help, "kind").empty() || (!closes && reduces < k_worth_it)) return {};
    const std::string gain =
        closes ? "it would settle what no reading settles yet"
               : fmt::format("on the whole the facets would be known {:.0f} % better",
                             100 * (1 - std::sqrt(1 - reduces)));
    return as_sentence(order(help) + ": " + gain);
}

}  // namespace culet
