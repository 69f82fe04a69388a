#include "refine/fit_uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/upright.h"

namespace culet {

namespace fs = std::filesystem;

namespace {

using ReportJson = nlohmann::json;

// NaN for null, which means unknown.
double number_or_nan(const ReportJson& value) {
    return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

double value_in(const ReportJson& facet, const char* key) {
    const auto found = facet.find(key);
    return number_or_nan(found == facet.end() ? ReportJson() : *found);
}

// The stone's unit of length relative to the report's.
double unit_ratio(const ReportJson& report, const Stone& stone) {
    const auto unit = report.find("unit");
    if (unit == report.end() || !unit->is_string()) return 1;
    const std::optional<LengthUnit> read = length_unit(unit->get<std::string>());
    return read ? mm_per(*read) / mm_per(stone.unit) : 1;
}

// In radians and the stone's unit. Empty where the report has none.
std::vector<double> covariance_in(const ReportJson& report, const fs::path& file,
                                  std::size_t facets, double ratio) {
    const auto found = report.find("facet_covariance");
    if (found == report.end() || !found->is_array() || found->empty()) return {};
    const std::size_t size = 3 * facets;
    const auto unit = [&](std::size_t i) { return i % 3 == 2 ? ratio : radians(1); };
    std::vector<double> covariance;
    for (const ReportJson& row : *found) {
        if (!row.is_array()) continue;
        for (const ReportJson& value : row) {
            const std::size_t at = covariance.size();
            covariance.push_back(number_or_nan(value) * unit(at / size) * unit(at % size));
        }
    }
    if (covariance.size() != size * size)
        throw InputError(file, fmt::format("its facet_covariance must have {} rows of {} numbers, "
                                           "three per facet: write the report anew",
                                           size, size));
    return covariance;
}

// Facets of another stone, or of the fit's start, differ by more; small facets read from a file are
// off by their corners' rounding.
constexpr double k_same_facet = radians(0.5);

void require_same_inclinations(const ReportJson& facets, const Stone& stone, const fs::path& file) {
    const Vec3 up = up_of(stone);
    for (const ReportJson& facet : facets) {
        const int at = find_facet(stone.solid, facet["name"].get<std::string>());
        const double read = radians(value_in(facet, "inclination"));
        if (at < 0 || !std::isfinite(read)) continue;
        const double z = glm::dot(stone.solid.facets[std::size_t(at)].plane.normal, up);
        const double here = std::acos(std::min(1.0, std::abs(z)));
        const double sigma = radians(value_in(facet, "sigma_inclination"));
        const double limit = k_same_facet + (std::isfinite(sigma) ? 5 * sigma : 0);
        if (std::abs(here - std::min(read, radians(180) - read)) < limit) continue;
        throw InputError(
            file, fmt::format("facet {} is inclined at {:.2f} degrees there and at {:.2f} in the "
                              "stone: give the mesh that this fit wrote (culet fit -o)",
                              facet["name"].get<std::string>(), degrees(read), degrees(here)));
    }
}

}  // namespace

StoneUncertainty uncertainty_of(const FitResult& result) {
    std::vector<std::string> names;
    std::vector<FacetUncertainty> sigmas;
    for (const FittedFacet& facet : result.facets) {
        names.push_back(facet.name);
        sigmas.push_back({facet.sigma_inclination, facet.sigma_azimuth, facet.sigma_offset});
    }
    return uncertainty_for(result.solid, names, sigmas, result.facet_covariance);
}

StoneUncertainty uncertainty_in(const fs::path& report, const Stone& stone) {
    const ReportJson json = ReportJson::parse(read_text(report), nullptr, false);
    if (!json.is_object() || !json.contains("facets") || !json["facets"].is_array())
        throw InputError(report, "is not a report of culet fit (--report FIT.json writes one)");
    const double ratio = unit_ratio(json, stone);
    std::vector<std::string> names;
    std::vector<FacetUncertainty> sigmas;
    for (const ReportJson& facet : json["facets"]) {
        const auto name = facet.is_object() ? facet.find("name") : facet.end();
        if (name == facet.end() || !name->is_string())
            throw InputError(report, "has a facet without a name: write the report anew");
        names.push_back(name->get<std::string>());
        sigmas.push_back({radians(value_in(facet, "sigma_inclination")),
                          radians(value_in(facet, "sigma_azimuth")),
                          ratio * value_in(facet, "sigma_offset")});
    }
    require_same_inclinations(json["facets"], stone, report);
    const std::vector<double> covariance = covariance_in(json, report, names.size(), ratio);
    try {
        return uncertainty_for(stone.solid, names, sigmas, covariance);
    } catch (const InputError& error) {
        throw InputError(report, error.what());
    }
}

}  // namespace culet
