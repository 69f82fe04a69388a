#include "page/fit_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "page/quantity.h"

namespace culet {

namespace {

using Json = nlohmann::json;

/// `*` in `pattern` stands for any run of characters; mean(), min(), max() around it are ignored.
bool names_facet(std::string pattern, const std::string& name) {
    for (const char* wrapper : {"mean(", "min(", "max("}) {
        if (pattern.starts_with(wrapper) && pattern.ends_with(")")) {
            pattern = pattern.substr(std::string(wrapper).size());
            pattern.pop_back();
        }
    }
    // Backtracks to the last star only: linear in practice, no recursion.
    std::size_t p = 0, n = 0, star = std::string::npos, back = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            back = n;
        } else if (p < pattern.size() && pattern[p] == name[n]) {
            ++p;
            ++n;
        } else if (star != std::string::npos) {
            p = star + 1;
            n = ++back;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

}  // namespace

std::vector<std::string> names_of(const Json& reading) {
    std::vector<std::string> names;
    const auto found = reading.find("of");
    if (found == reading.end()) return names;
    if (found->is_array()) {
        for (const Json& name : *found) {
            if (name.is_string()) names.push_back(name.get<std::string>());
        }
    } else if (found->is_string()) {
        std::string all = found->get<std::string>();
        for (std::size_t at = 0; at <= all.size();) {
            const std::size_t end = std::min(all.find('/', at), all.size());
            names.push_back(all.substr(at, end - at));
            at = end + 1;
        }
    }
    return names;
}

std::vector<Worst> worst_readings(const Json& fit, const std::vector<std::string>& facets) {
    std::vector<Worst> worst(facets.size());
    const std::set<std::string> suspects = suspects_of(fit);
    for (const Json& reading : array_at(fit, "readings")) {
        const auto normalized = number_at(reading, "normalized");
        if (!normalized) continue;
        const auto names = names_of(reading);
        for (std::size_t f = 0; f < facets.size(); ++f) {
            const bool speaks = std::any_of(names.begin(), names.end(), [&](const auto& name) {
                return names_facet(name, facets[f]);
            });
            if (!speaks) continue;
            ++worst[f].count;
            worst[f].suspect = worst[f].suspect || true_at(reading, "suspect") ||
                               suspects.contains(text_at(reading, "id"));
            if (worst[f].reading.empty() || std::abs(*normalized) > std::abs(worst[f].normalized)) {
                worst[f].normalized = *normalized;
                worst[f].reading = text_at(reading, "id");
            }
        }
    }
    return worst;
}

std::set<std::string> suspects_of(const Json& fit) {
    std::set<std::string> suspects;
    for (const Json& suspect : array_at(fit, "suspects")) {
        if (suspect.is_string()) suspects.insert(suspect.get<std::string>());
        if (suspect.is_object()) suspects.insert(text_at(suspect, "id"));
    }
    return suspects;
}

std::optional<double> direction_sigma(const Json& facet) {
    const auto tilt = number_at(facet, "sigma_inclination");
    if (!tilt) return std::nullopt;
    const double level =
        std::sin(number_at(facet, "inclination").value_or(0) * std::numbers::pi / 180);
    return std::hypot(*tilt, level * number_at(facet, "sigma_azimuth").value_or(0));
}

const Json* named_in(const Json& list, const std::string& name) {
    for (const Json& one : list) {
        if (text_at(one, "name") == name) return &one;
    }
    return nullptr;
}

const Json* facet_in(const Json& fit, const std::string& name) {
    return named_in(array_at(fit, "facets"), name);
}

std::string proportion_text(const Json& p) {
    return quantity(number_at(p, "value"), number_at(p, "sigma"), text_at(p, "unit"));
}

std::string rounded_text(const Json& p) {
    const auto gia = number_at(p, "gia"), ags = number_at(p, "ags");
    std::string text;
    if (gia) text += fmt::format("GIA {:g}", *gia);
    if (ags) text += fmt::format("{}AGS {:.1f}", text.empty() ? "" : ", ", *ags);
    return text;
}

}  // namespace culet
