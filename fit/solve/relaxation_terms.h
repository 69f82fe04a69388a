#pragma once
// Terms used by more than one part of the relaxation. Private to the room.

#include <cmath>
#include <glm/geometric.hpp>

#include "fit/solve/constants.h"
#include "fit/solve/relaxation.h"

namespace culet {

// Residual (formula less value) in a stage. Lengths have a kink at zero; both sides are smoothed as
// sqrt(l^2 + s^2), so that a length below s has no preferred direction.
inline Quantity misfit_of(const Equation& e, const Shape& shape, const PenaltyScale& penalty) {
    Quantity q = e.formula(shape);
    if (e.has_kink && penalty.incidence > 0) {
        const double s = k_stage.kink_width * penalty.incidence, round = std::hypot(q.value, s);
        for (Quantity::Slope& slope : q.slopes) slope.slope *= q.value / round;
        q.value = round - std::hypot(e.value, s);
    } else {
        q.value -= e.value;
    }
    return q;
}

inline double variance_of(const Equation& e, const PenaltyScale& penalty) {
    return e.exact ? penalty.incidence * penalty.incidence
                   : e.sigma * e.sigma + penalty.readings * penalty.readings;
}

inline double off_level(const Shape& shape, const SharedContact& contact) {
    return glm::dot(contact.direction, shape.points[contact.one] - shape.points[contact.other]);
}

}  // namespace culet
