#pragma once
// What a fit report says about facets and readings. Private to the folder: shows JSON.

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "page/json_fields.h"

namespace culet {

/// Names of a reading's facets: "of" is an array, or one string with `/` between names.
std::vector<std::string> names_of(const nlohmann::json& reading);

/// The worst reading of a facet.
struct Worst {
    double normalized = 0;
    std::string reading;  ///< id; empty: no reading involves the facet
    int count = 0;
    bool suspect = false;
};
std::vector<Worst> worst_readings(const nlohmann::json& fit,
                                  const std::vector<std::string>& facets);

std::set<std::string> suspects_of(const nlohmann::json& fit);

/// Uncertainty of the normal, degrees; level facets have no azimuth. Empty: unknown.
std::optional<double> direction_sigma(const nlohmann::json& facet);

/// The entry of this name in one of the report's lists.
const nlohmann::json* named_in(const nlohmann::json& list, const std::string& name);
const nlohmann::json* facet_in(const nlohmann::json& fit, const std::string& name);

/// A proportion with its sigma and unit.
std::string proportion_text(const nlohmann::json& proportion);
/// As laboratories round it, "GIA 34.5, AGS 34.5"; empty where they do not.
std::string rounded_text(const nlohmann::json& proportion);

}  // namespace culet
