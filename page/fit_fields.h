#pragma once
// What a fit report says of facets and readings. Private to the room: shows JSON.

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "page/json_fields.h"

namespace culet {

/// Names that a reading speaks of: "of" is an array, or one string with `/` between names.
std::vector<std::string> names_of(const nlohmann::json& reading);

/// The worst of the readings that speak of a facet.
struct Worst {
    double normalized = 0;
    std::string reading;  ///< id; empty: no reading speaks of the facet
    int count = 0;
    bool suspect = false;  ///< one of them is suspected
};
std::vector<Worst> worst_readings(const nlohmann::json& fit,
                                  const std::vector<std::string>& facets);

std::set<std::string> suspects_of(const nlohmann::json& fit);

/// How far the normal may be off, degrees; a level facet has no azimuth. Nothing: not known.
std::optional<double> direction_sigma(const nlohmann::json& facet);

const nlohmann::json* facet_in(const nlohmann::json& fit, const std::string& name);

}  // namespace culet
