// One equation for each facet's angle, azimuth and offset, and one for each common part of a tier.

#include "fit/model/equations.h"

namespace culet {

namespace {

Formula plane_offset(int facet) {
    return [=](const Shape& shape) {
        Quantity q{shape.offsets[std::size_t(facet)], {}};
        q.add(Quantity::By::offset, facet, 1);
        return q;
    };
}

// Returns the formula and its value at the start (0 if the formula subtracts it).
std::pair<Formula, double> formula_of(const PriorTerm& term) {
    switch (term.of) {
        case PriorTerm::Of::inclination:
            return {tilt_from_side(term.facet, term.side), term.start};
        case PriorTerm::Of::azimuth:
            return {azimuth_error(term.facet, -1, term.start), 0};
        case PriorTerm::Of::offset:
            return {plane_offset(term.facet), term.start};
        case PriorTerm::Of::level_x:
            return {horizontal_component(term.facet, 0), term.start};
        case PriorTerm::Of::level_y:
            break;
    }
    return {horizontal_component(term.facet, 1), term.start};
}

}  // namespace

std::vector<Equation> prior_equations(const PriorModel& prior) {
    std::vector<Equation> all;
    const auto sigma_of = [&](PriorLevel level) { return prior.sigmas[std::size_t(level)]; };
    const auto put = [&](Formula formula, double value, double sigma) {
        Equation e;
        e.role = Equation::Role::expected;
        e.formula = std::move(formula);
        e.value = value;
        e.sigma = sigma;
        all.push_back(std::move(e));
    };
    for (const PriorTerm& term : prior.terms) {
        const PriorLevel tier = term.is_angle() ? PriorLevel::tier_angle : PriorLevel::tier_offset;
        const PriorLevel own = term.is_angle() ? PriorLevel::facet_angle : PriorLevel::facet_offset;
        const double ratio = term.of == PriorTerm::Of::azimuth ? prior.azimuth_ratio : 1;
        auto [formula, value] = formula_of(term);
        if (term.extra < 0) {
            // Without a tier both errors add up.
            put(std::move(formula), value, ratio * std::hypot(sigma_of(tier), sigma_of(own)));
        } else {
            put(weighted_sum({{1, std::move(formula)}, {-1, extra_unknown(term.extra)}}), value,
                ratio * sigma_of(own));
        }
    }
    const auto put_common = [&](const std::vector<int>& extras, PriorLevel level, double ratio) {
        for (const int e : extras) put(extra_unknown(e), 0, ratio * sigma_of(level));
    };
    put_common(prior.angle_extras, PriorLevel::tier_angle, 1);
    put_common(prior.azimuth_extras, PriorLevel::tier_angle, prior.azimuth_ratio);
    put_common(prior.offset_extras, PriorLevel::tier_offset, 1);
    return all;
}

}  // namespace culet
