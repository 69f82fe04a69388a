#pragma once
// Piecewise linear curves: a value y at each of a few rising levels x.

#include <vector>

namespace culet {

/// Constant beyond the ends.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at);

/// Where a non-increasing curve has this value: the middle of a level part, or the nearer end.
double inverse_of_falling(const std::vector<double>& x, const std::vector<double>& y, double value);

/// Non-decreasing least squares with equal weights (isotonic regression by pool adjacent violators,
/// Barlow et al. 1972).
std::vector<double> monotone(const std::vector<double>& values);
/// The same, non-increasing.
std::vector<double> falling(std::vector<double> values);

/// Averages each value with its neighbours at half weight: for variances of a few draws.
std::vector<double> smoothed(const std::vector<double>& values);

}  // namespace culet
