// The figures under the verdict on a fit.

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "page/fit_fields.h"
#include "page/fit_page.h"
#include "page/parts.h"
#include "page/quantity.h"

namespace culet {

namespace {

using Json = nlohmann::json;

/// A row for several facets gives readings `r16.S1`, `r16.S2`, ...; a user's own id is one row.
std::size_t rows_of(const Json& readings) {
    std::set<std::string> rows;
    for (const Json& reading : readings) {
        const std::string id = text_at(reading, "id");
        const std::string row = id.substr(0, id.find('.'));
        const bool own = row.size() < 2 || row[0] != 'r' ||
                         row.find_first_not_of("0123456789", 1) != std::string::npos;
        rows.insert(own ? id : row);
    }
    return rows.size();
}

/// Source of the prior that replaced missing readings; empty: none.
std::string prior_source(const Json& fit) {
    const auto prior = fit.find("prior");
    const std::string source = prior == fit.end() ? "" : text_at(*prior, "source");
    return source == "none" ? "" : source;
}

std::string readings_tile(const Json& fit) {
    const Json& readings = array_at(fit, "readings");
    if (readings.empty()) return {};
    const std::size_t suspects = suspects_of(fit).size();
    const auto unchecked = std::count_if(readings.begin(), readings.end(), [](const Json& reading) {
        const auto redundancy = number_at(reading, "redundancy");
        return number_at(reading, "value") && redundancy && *redundancy < 0.01 &&
               !true_at(reading, "exact");
    });
    std::string about = suspects == 0 ? "none suspect" : fmt::format("{} suspect", suspects);
    const std::size_t rows = rows_of(readings);
    if (rows < readings.size()) about = fmt::format("from {} rows; {}", rows, about);
    // With a prior few readings check each other; each is compared with its tier instead.
    const std::string source = prior_source(fit);
    if (unchecked > 0 && source.empty()) {
        about += fmt::format("; nothing checks {} of them", unchecked);
    }
    return tile("Readings", std::to_string(readings.size()), about, suspects == 0 ? "" : "bad");
}

std::set<std::string> open_facets(const Json& fit) {
    std::set<std::string> open;
    for (const Json& one : array_at(fit, "undetermined")) open.insert(text_at(one, "facet"));
    return open;
}

std::string facets_tile(const Json& fit) {
    const Json& facets = array_at(fit, "facets");
    if (facets.empty()) return {};
    const std::string source = prior_source(fit);
    if (!source.empty()) {
        const auto read = std::count_if(facets.begin(), facets.end(), [](const Json& facet) {
            const auto from = facet.find("from_readings");
            return from != facet.end() && number_at(*from, "inclination").value_or(0) > 0.5;
        });
        return tile("Facets read", fmt::format("{} of {}", read, facets.size()),
                    source == "catalogue" ? "the rest assumed near the design"
                                          : "the rest assumed near the mesh as drawn");
    }
    const std::set<std::string> open = open_facets(fit);
    return tile("Facets", std::to_string(facets.size()),
                open.empty() ? "all held by the readings"
                             : fmt::format("{} left open by the readings", open.size()));
}

std::string sureness_tile(const Json& fit) {
    const std::set<std::string> open = open_facets(fit);
    std::vector<std::pair<double, std::string>> sigmas;
    for (const Json& facet : array_at(fit, "facets")) {
        const auto sigma = direction_sigma(facet);
        if (sigma && *sigma > 0 && !open.contains(text_at(facet, "name")))
            sigmas.emplace_back(*sigma, text_at(facet, "name"));
    }
    if (sigmas.size() < 2) return {};
    std::stable_sort(sigmas.begin(), sigmas.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    const auto shown = [](double sigma) { return "± " + to_place_of(sigma, sigma, "deg"); };
    return tile(
        "Half of the facets within", shown(sigmas[sigmas.size() / 2].first),
        fmt::format("least sure is {}, {}", sigmas.back().second, shown(sigmas.back().first)));
}

}  // namespace

std::string fit_tiles(const FitView& view) {
    const Json fit = parsed_object<Json>(view.fit_json, "the fit report for the page");
    const bool stands = text_at(fit, "status") != "not_converged";
    return readings_tile(fit) + facets_tile(fit) + (stands ? sureness_tile(fit) : "");
}

}  // namespace culet
