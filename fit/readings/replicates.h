#pragma once
// Readings of one quantity, taken again and again.
//
// With weights w = 1 / sigma^2 and m their weighted mean,
//     sum w_i (f - v_i)^2 = W (f - m)^2 + sum w_i (v_i - m)^2,  W = sum w_i,
// so that n readings cost a fit no more than one: the mean with the variance 1 / W, and a constant,
// the scatter, which belongs to chi-square with n - 1 degrees of freedom (Koch 1999, 3.2.3).

#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// One of several readings that share an equation.
struct Replicate {
    int reading = -1;
    double off = 0;  ///< its value less the mean
    double sigma = 0;
};

struct Replicates {
    double value = 0;  ///< the mean
    double sigma = 0;
    double scatter = 0;
    std::vector<Replicate> all;
};

/// Sets of two and more readings of the same kind, facets, places, direction and datum, each in
/// the order of the readings. Exact ones and relations stand alone. An inclination of exactly 0
/// says more than others do (level both ways): only such go together.
std::vector<std::vector<int>> repeated_readings(const std::vector<Reading>& readings);

/// Values and sigmas divided by `unit`; azimuths on either side of 0 belong together.
Replicates merged(const std::vector<Reading>& readings, const std::vector<int>& group, double unit);

}  // namespace culet
