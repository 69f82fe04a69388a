#pragma once
// What was observed one by one, also where several readings share an equation. Private to the room:
// shows Eigen.

#include <vector>

#include "fit/model/linear.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// A reading's part, or a soft meet's, in an equation that counts. Where several readings share it,
/// `part` of them all is its own weight's root: residual_i = part (residual - off / sigma), and of
/// the hat matrix the entries of two readings are those of their equations times both parts.
struct Observation {
    Eigen::Index equation = -1;  ///< of the soft ones
    int reading = -1;            ///< or none
    double off = 0, sigma = 1, part = 1;

    /// In sigmas.
    double residual(const Linearised& linear) const;
    double leverage(const Covariance& covariance) const {
        return part * part * covariance.leverages()(equation);
    }
};

/// In the order in which they would stand if none shared an equation.
std::vector<Observation> observations_of(const Linearised& linear);

}  // namespace culet
