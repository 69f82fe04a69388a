#pragma once
// The effect on readings of an instrument that rounds to steps of, say, 0.1 degrees or 0.01 mm.

#include <utility>
#include <vector>

#include "fit/readings/measurement.h"

namespace culet {

/// Variance that repeated readings of one quantity share because all are rounded to the same steps:
/// the mean square of E[rounded] - truth over all positions between two steps,
///     sum over k >= 1 of step^2 / (2 pi^2 k^2) exp(-4 pi^2 k^2 sigma^2 / step^2),
/// from the Fourier series of the sawtooth (Widrow & Kollar 2008, chapter 4). It is step^2/12
/// without noise and negligible from sigma = step/2 on, where noise dithers the steps away.
double common_rounding_variance(double sigma, double step);

/// The sigma that each of `replicates` equal readings of one quantity needs, so that their mean has
/// its true variance (sigma^2 + step^2/12 - c) / replicates + c, with c the shared variance.
double rounded_sigma(double sigma, double step, int replicates);

/// Gives every rounded reading its `rounded_sigma`. Readings are of one quantity if they show the
/// same value and name the same thing, or facets that exact symmetry makes alike (`alike`: pairs of
/// facets).
void widen_for_rounding(std::vector<Reading>& readings,
                        const std::vector<std::pair<int, int>>& alike, int facets);

}  // namespace culet
