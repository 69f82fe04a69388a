#include "page/fit_facts.h"

#include <algorithm>

#include "page/fit_fields.h"
#include "stone/text/errors.h"

namespace culet {

std::vector<FacetFacts> facet_facts(const std::vector<std::string>& facets,
                                    const std::string& fit_json) {
    using Json = nlohmann::json;
    const Json fit = parsed_object<Json>(fit_json, "the fit report");
    const std::vector<Worst> worst = worst_readings(fit, facets);
    std::vector<FacetFacts> all;
    bool any = false;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        FacetFacts facts;
        if (const Json* facet = facet_in(fit, facets[f])) {
            any = true;
            facts.inclination_deg = number_at(*facet, "inclination");
            facts.azimuth_deg = number_at(*facet, "azimuth");
            facts.inclination_sigma_deg = number_at(*facet, "sigma_inclination");
            facts.azimuth_sigma_deg = number_at(*facet, "sigma_azimuth");
            facts.direction_sigma_deg = direction_sigma(*facet);
        }
        if (!worst[f].reading.empty()) facts.residual = worst[f].normalized;
        facts.reading = worst[f].reading;
        facts.readings = worst[f].count;
        facts.suspect = worst[f].suspect;
        const auto& open = array_at(fit, "undetermined");
        facts.determined = std::none_of(open.begin(), open.end(), [&](const Json& one) {
            return text_at(one, "facet") == facets[f];
        });
        all.push_back(std::move(facts));
    }
    if (!any)
        throw InputError("the fit report has none of this stone's facets: is it of another stone?");
    return all;
}

}  // namespace culet
