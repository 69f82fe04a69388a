#pragma once
// Repeated readings of one quantity.
//
// With weights w = 1 / sigma^2 and m their weighted mean,
//     sum w_i (f - v_i)^2 = W (f - m)^2 + sum w_i (v_i - m)^2,  W = sum w_i,
// so n readings cost a fit no more than one: the mean with variance 1 / W, and a constant, the
// scatter, which adds to chi-square with n - 1 degrees of freedom (Koch 1999, 3.2.3).

#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// One of several readings that share an equation.
struct Replicate {
    int reading = -1;
    double off = 0;  ///< its value - the mean
    double sigma = 0;
};

struct Replicates {
    double value = 0;  ///< the weighted mean
    double sigma = 0;
    double scatter = 0;
    std::vector<Replicate> all;
};

/// Sets of two or more readings of the same kind, facets, places, direction and datum, in the order
/// of the readings; without exact ones and relations. Inclinations of exactly 0 (level both ways)
/// form sets of their own.
std::vector<std::vector<int>> repeated_readings(const std::vector<Reading>& readings);

/// Values and sigmas are divided by `unit`; azimuths may lie on both sides of 0.
Replicates merged(const std::vector<Reading>& readings, const std::vector<int>& group, double unit);

}  // namespace culet
