// From readings to equations, for the corners that carry them at a given shape.

#include <algorithm>
#include <iterator>

#include "fit/model/constants.h"
#include "fit/model/symmetry_contrasts.h"
#include "fit/model/system.h"

namespace culet {

std::vector<Equation> System::equations(const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline) const {
    std::vector<Equation> all;
    // The up facet is horizontal: that is what the frame means.
    if (up_facet_ >= 0) {
        for (int k = 0; k < 2; ++k) {
            Equation e;
            e.role = Equation::Role::relation;
            e.exact = true;
            e.formula = horizontal_component(up_facet_, k);
            all.push_back(std::move(e));
        }
    }
    for (std::size_t i = 0; i < incidences_.size(); ++i) {
        const Incidence& incidence = incidences_[i];
        Equation e;
        e.incidence = static_cast<int>(i);
        e.reading = incidence.reading;
        e.role = incidence.how == MeetTreatment::released ? Equation::Role::released
                                                          : Equation::Role::incidence;
        e.exact = incidence.how == MeetTreatment::exact;
        e.sigma = incidence_sigma(incidence);
        if (e.role == Equation::Role::incidence && !e.exact && incidence.sigma == 0 &&
            estimates_meets_) {
            e.group = is_girdle(incidence.facet);
        }
        e.formula = height(incidence.facet, Corner{incidence.point, {-1, -1, -1}});
        all.push_back(std::move(e));
    }
    std::vector<Equation> of_readings = reading_equations(shape, outline);
    std::move(of_readings.begin(), of_readings.end(), std::back_inserter(all));
    return all;
}

double System::incidence_sigma(const Incidence& incidence) const {
    return incidence.how == MeetTreatment::exact      ? 0
           : incidence.how == MeetTreatment::released ? k_shapes.released_sigma
           : incidence.sigma > 0                      ? incidence.sigma
                                                      : group_sigmas_[is_girdle(incidence.facet)];
}

std::vector<std::pair<int, int>> System::hinges() const {
    std::vector<std::pair<int, int>> all;
    if (!stone_.convex) return all;
    for (std::size_t f = 0; f < solid_.facets.size(); ++f) {
        const std::vector<int>& own = solid_.facets[f].corners;
        std::vector<int> near;
        for (int corner : own) {
            for (int g : edges_.facets_of_vertex[corner]) {
                for (int c : solid_.facets[g].corners) near.push_back(c);
            }
        }
        std::sort(near.begin(), near.end());
        near.erase(std::unique(near.begin(), near.end()), near.end());
        for (int c : near) {
            if (std::find(own.begin(), own.end(), c) == own.end()) all.emplace_back(int(f), c);
        }
    }
    return all;
}

}  // namespace culet
