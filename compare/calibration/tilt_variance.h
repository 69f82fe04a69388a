#pragma once
// The common size of many small causes, from what they change in a picture: a variance component.

#include <optional>
#include <vector>

namespace culet {

/// What is known of a picture beforehand. Columns have one value for each sample.
struct TiltModel {
    /// The change by a unit of each cause (each facet's tilts).
    std::vector<std::vector<double>> changes;
    /// Directions in which pictures differ for other reasons, by unknown amounts.
    std::vector<std::vector<double>> nuisances;
    /// Sigma of each sample for all other reasons, positive; only ratios count.
    std::vector<double> noise;
};

/// The causes' root mean square in their unit: the square root of Rao's quadratic estimate of a
/// variance component (Rao 1971, MINQUE; the first iterate of restricted maximum likelihood,
/// Patterson and Thompson 1971). After whitening and projecting out the nuisances it is
///     sum w (y / s)^2 / sum w,   w = (s^2 / (s^2 + t^2))^2,
/// with y and s the difference and the singular values along the changes' principal directions;
/// barely visible directions do not count, clearly visible ones count alike. t is the median of s,
/// because other noise (mostly the causes' non-linear effect) is unknown. The noise's share is not
/// subtracted, so that the logarithm always exists: a calibration must find the estimate for no
/// causes, and its bias for large ones.
class TiltVariance {
public:
    /// Not usable.
    TiltVariance() = default;
    explicit TiltVariance(const TiltModel& model);
    /// From the `rows()` and `samples()` of an earlier one.
    TiltVariance(std::vector<float> rows, std::size_t samples)
        : samples_(samples), rows_(std::move(rows)) {}

    /// False: every change of a cause is also a nuisance.
    bool usable() const { return !rows_.empty(); }
    std::size_t samples() const { return samples_; }
    /// One for each direction, with `samples()` values. The estimate is the root sum of squares of
    /// their products with a difference.
    const std::vector<float>& rows() const { return rows_; }
    /// `difference`: a picture minus the one without causes. Nothing when not usable.
    std::optional<double> rms(const std::vector<double>& difference) const;

private:
    std::size_t samples_ = 0;
    std::vector<float> rows_;
};

}  // namespace culet
