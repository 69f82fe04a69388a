// Lists all equations of a fit: the frame's, the incidences and those of the readings.

#include <algorithm>
#include <iterator>

#include "fit/model/equations.h"

namespace culet {

std::vector<Equation> all_equations(const FitModel& model, const Shape& shape,
                                    const std::shared_ptr<const Outline>& outline) {
    const Meets& meets = model.meets();
    const int up_facet = model.frame().up_facet();
    std::vector<Equation> all;
    // The frame is defined by the up facet being level.
    if (up_facet >= 0) {
        for (int k = 0; k < 2; ++k) {
            Equation e;
            e.role = Equation::Role::relation;
            e.exact = true;
            e.formula = horizontal_component(up_facet, k);
            all.push_back(std::move(e));
        }
    }
    for (std::size_t i = 0; i < meets.incidences.size(); ++i) {
        const Incidence& incidence = meets.incidences[i];
        Equation e;
        e.incidence = static_cast<int>(i);
        e.reading = incidence.reading;
        e.role = incidence.how == MeetTreatment::released ? Equation::Role::released
                                                          : Equation::Role::incidence;
        e.exact = incidence.how == MeetTreatment::exact;
        e.sigma = meets.sigma(incidence);
        if (meets.estimates_sigmas && incidence.has_common_sigma()) e.group = incidence.group;
        e.formula = height(incidence.facet, Corner{incidence.point, {-1, -1, -1}});
        all.push_back(std::move(e));
    }
    std::vector<Equation> of_readings = reading_equations(model, shape, outline);
    std::move(of_readings.begin(), of_readings.end(), std::back_inserter(all));
    return all;
}

}  // namespace culet
