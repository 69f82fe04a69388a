#pragma once
// What a fit report says of each facet, for programs.

#include <optional>
#include <string>
#include <vector>

namespace culet {

/// Degrees; nothing: not known.
struct FacetFacts {
    std::optional<double> inclination_deg, azimuth_deg;
    std::optional<double> inclination_sigma_deg, azimuth_sigma_deg;
    std::optional<double> direction_sigma_deg;  ///< how far the normal may be off
    std::optional<double> residual;             ///< of its worst reading, in standard uncertainties
    std::string reading;  ///< id of that one; empty: no reading speaks of the facet
    int readings = 0;
    bool suspect = false;  ///< one of them is suspected
    bool determined = true;
};

/// One a name, in their order. `fit_json` is a report of `culet fit`. Throws InputError when it is
/// no JSON object, or speaks of none of the facets.
std::vector<FacetFacts> facet_facts(const std::vector<std::string>& facets,
                                    const std::string& fit_json);

}  // namespace culet
