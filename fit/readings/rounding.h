#pragma once
// The effect of instruments that show steps, such as 0.1 degrees or 0.01 mm.

#include <utility>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Variance that repeated readings share because all are rounded to the same steps: the mean square
/// of E[rounded] - truth over all positions between two steps,
///     sum over k >= 1 of step^2 / (2 pi^2 k^2) exp(-4 pi^2 k^2 sigma^2 / step^2),
/// from the Fourier series of the sawtooth (Widrow & Kollar 2008, chapter 4): step^2/12 without
/// noise, negligible from sigma = step/2 on, where noise dithers the steps away.
double common_rounding_variance(double sigma, double step);

/// Sigma of each of `replicates` equal readings that gives their mean its true variance (sigma^2 +
/// step^2/12 - c) / replicates + c, with c shared.
double rounded_sigma(double sigma, double step, int replicates);

/// Gives rounded readings their `rounded_sigma`. They are of one quantity if they show the same
/// value for the same thing, or for facets that exact symmetry makes alike (`alike`: pairs).
void widen_for_rounding(std::vector<Reading>& readings,
                        const std::vector<std::pair<int, int>>& alike, int facets);

}  // namespace culet
