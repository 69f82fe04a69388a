#pragma once
// What a fit report says about each facet, for programs.

#include <optional>
#include <string>
#include <vector>

namespace culet {

/// Degrees; empty: unknown.
struct FacetFacts {
    std::optional<double> inclination_deg, azimuth_deg;
    std::optional<double> inclination_sigma_deg, azimuth_sigma_deg;
    std::optional<double> direction_sigma_deg;  ///< uncertainty of the normal
    std::optional<double> residual;             ///< of its worst reading, in standard uncertainties
    std::string reading;  ///< id of the worst; empty: no reading involves the facet
    int readings = 0;
    bool suspect = false;
    bool determined = true;
};

/// One entry per name, in order. `fit_json` is a report of `culet fit`. Throws InputError when it
/// is not a JSON object or has none of the facets.
std::vector<FacetFacts> facet_facts(const std::vector<std::string>& facets,
                                    const std::string& fit_json);

}  // namespace culet
