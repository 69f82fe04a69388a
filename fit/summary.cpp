#include "fit/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "stone/units.h"

namespace culet {

namespace {

constexpr std::size_t k_named = 4;  // of a longer list the first ones are named

std::string list_of(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size() && i < k_named; ++i) {
        text += (i == 0 ? "" : ", ") + names[i];
    }
    if (names.size() > k_named) text += fmt::format(" and {} more", names.size() - k_named);
    return text;
}

bool in_degrees(ReadingKind kind) {
    return is_angle(kind) || kind == ReadingKind::parallel || kind == ReadingKind::rotation ||
           kind == ReadingKind::mirror;
}

// How far the normal may be off.
double direction_sigma(const FittedFacet& facet) {
    const double turn =
        std::isfinite(facet.sigma_azimuth) ? std::sin(facet.inclination) * facet.sigma_azimuth : 0;
    return std::hypot(facet.sigma_inclination, turn);
}

bool is_open(const FitResult& result, const std::string& facet) {
    return std::any_of(result.undetermined.begin(), result.undetermined.end(),
                       [&](const Undetermined& u) { return u.facet == facet; });
}

std::string verdict(const FitResult& result) {
    switch (result.status) {
        case FitStatus::converged:
            return fmt::format(
                "The readings agree with this stone: chi-square {:.1f}, where {:.1f} is expected "
                "and up to {:.1f} no surprise.",
                result.chi2, result.dof, result.chi2_limit);
        case FitStatus::contradictory:
            if (result.dof > 0 && result.chi2 > result.chi2_limit) {
                return fmt::format(
                    "The readings contradict each other: chi-square {:.1f}, where {:.1f} is "
                    "expected and up to {:.1f} no surprise.",
                    result.chi2, result.dof, result.chi2_limit);
            }
            return fmt::format("The readings contradict each other: {}.", result.message);
        case FitStatus::undetermined:
            return fmt::format("The readings do not suffice: {}.", result.message);
        case FitStatus::not_converged:
            break;
    }
    return fmt::format("Do not rely on this stone: {}.", result.message);
}

std::string least_sure(const FitResult& result) {
    std::vector<std::pair<double, std::string>> sigmas;
    for (const FittedFacet& facet : result.facets) {
        const double sigma = degrees(direction_sigma(facet));
        if (sigma > 0 && std::isfinite(sigma) && !is_open(result, facet.name)) {
            sigmas.emplace_back(sigma, facet.name);
        }
    }
    if (sigmas.size() < 2) return {};
    std::stable_sort(sigmas.begin(), sigmas.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::string> worst;
    for (std::size_t i = 0; i < 3 && i < sigmas.size(); ++i) {
        worst.push_back(fmt::format("{} ({:.2g} degrees)", sigmas[i].second, sigmas[i].first));
    }
    return fmt::format(
        "Least sure are {}; half of the facets are known to {:.2g} degrees or better.",
        list_of(worst), sigmas[sigmas.size() / 2].first);
}

std::string words_of(const FittedReading& r) {
    const double unit = in_degrees(r.kind) ? degrees(1) : 1;
    std::string of;
    for (const std::string& name : r.of) of += (of.empty() ? " of " : "/") + name;
    std::string text = fmt::format("{} ({}{}", r.id, name_of(r.kind), of);
    if (!is_relation(r.kind)) {
        text += fmt::format(": read {:.6g}", unit * r.value);
        // What the reading would be predicted to be had it not been taken.
        if (r.redundancy > 0.01) {
            text += fmt::format(", the others say {:.6g}",
                                unit * (r.value + r.residual / r.redundancy));
        }
    }
    return text + fmt::format(", off by {:.1f} sigma)", std::abs(r.normalized));
}

std::string doubtful(const FitResult& result) {
    std::vector<std::string> words;
    for (const std::string& id : result.suspects) {
        const auto found = std::find_if(result.readings.begin(), result.readings.end(),
                                        [&](const FittedReading& r) { return r.id == id; });
        words.push_back(found == result.readings.end() ? id : words_of(*found));
    }
    return words.empty() ? "" : fmt::format("Look again at {}.", list_of(words));
}

std::string unchecked(const FitResult& result) {
    std::vector<std::string> ids;
    for (const FittedReading& r : result.readings) {
        if (!r.exact && !is_relation(r.kind) && r.redundancy < 0.01) ids.push_back(r.id);
    }
    if (ids.empty()) return {};
    return fmt::format("Nothing checks {} of {} readings ({}): their errors would not show.",
                       ids.size(), result.readings.size(), list_of(ids));
}

std::string open_freedoms(const FitResult& result) {
    std::vector<std::string> order;
    std::map<std::string, std::vector<std::string>> freedoms;
    for (const Undetermined& u : result.undetermined) {
        if (freedoms[u.facet].empty()) order.push_back(u.facet);
        freedoms[u.facet].push_back(u.freedom);
    }
    std::vector<std::string> words;
    for (const std::string& facet : order) {
        words.push_back(fmt::format("the {} of {}", fmt::join(freedoms[facet], " and "), facet));
    }
    return words.empty() ? "" : fmt::format("Nothing measured fixes {}.", list_of(words));
}

}  // namespace

std::vector<std::string> fit_summary(const FitResult& result) {
    std::vector<std::string> sentences{verdict(result)};
    const auto add = [&](std::string sentence) {
        if (!sentence.empty()) sentences.push_back(std::move(sentence));
    };
    if (result.status != FitStatus::not_converged) add(least_sure(result));
    add(doubtful(result));
    add(open_freedoms(result));
    if (result.status != FitStatus::not_converged) add(unchecked(result));
    return sentences;
}

}  // namespace culet
