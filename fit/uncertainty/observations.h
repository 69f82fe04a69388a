#pragma once
// Single observations, also of readings that share an equation. Private to the room: shows Eigen.

#include <vector>

#include "fit/model/linear.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// A reading's or soft meet's part in an equation. If several readings share it, `part` is the root
/// of this one's share of the weight: residual_i = part (residual - off / sigma), and the hat
/// matrix's entry for two readings is that of their equations times both parts.
struct Observation {
    Eigen::Index equation = -1;  ///< index among the soft equations
    int reading = -1;            ///< -1: none
    double off = 0, sigma = 1, part = 1;

    /// In sigmas.
    double residual(const Linearised& linear) const;
    double leverage(const Covariance& covariance) const {
        return part * part * covariance.leverages()(equation);
    }
};

/// In the order as if no equation were shared.
std::vector<Observation> observations_of(const Linearised& linear);

}  // namespace culet
