#pragma once
// Curves that are known at a few rising levels x, straight between them: y has a value for each.

#include <vector>

namespace culet {

/// Beyond the ends: as at the ends.
double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at);

/// Where a non-increasing curve has this value: the middle of a flat stretch, or the nearer end.
double inverse_of_falling(const std::vector<double>& x, const std::vector<double>& y, double value);

/// Non-decreasing least-squares fit (pool adjacent violators), weights alike (isotonic regression,
/// Barlow et al. 1972).
std::vector<double> monotone(const std::vector<double>& values);
/// The same, non-increasing.
std::vector<double> falling(std::vector<double> values);

/// Each shared with its neighbours, at half of its own weight: for variances of a few draws each.
std::vector<double> smoothed(const std::vector<double>& values);

}  // namespace culet
