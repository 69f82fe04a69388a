#pragma once
// How large many small causes are together, from what they changed in a picture, without telling
// one from another: a variance component.

#include <optional>
#include <vector>

namespace culet {

/// What is known of a picture's samples before it is seen. All columns have a value a sample.
struct TiltModel {
    /// What a unit of each cause (each facet's tilts) changes.
    std::vector<std::vector<double>> changes;
    /// Directions in which pictures differ for other reasons, by unknown amounts.
    std::vector<std::vector<double>> nuisances;
    /// Standard deviation of each sample for all other reasons, in any unit: only their ratios
    /// count. Over zero.
    std::vector<double> noise;
};

/// The causes' root mean square, in their unit: the square root of Rao's quadratic estimate of a
/// variance component (Rao 1971, MINQUE; the first iterate of restricted maximum likelihood,
/// Patterson and Thompson 1971). With the noise made equal, the nuisances projected out, and
/// y, s the difference and the singular values along the changes' principal directions, it is
///     sum w (y / s)^2 / sum w,   w = (s^2 / (s^2 + t^2))^2,
/// so that directions hardly seen do not count and those well seen count alike, however strong.
/// t is the median of s: which noise there is beside the causes is not known beforehand (mostly it
/// is what is not linear in them). The noise's own share is left in, so that the logarithm exists:
/// what the estimate is of pictures with no cause at all, and how it bends for large ones, is for a
/// calibration to tell.
class TiltVariance {
public:
    /// Not usable.
    TiltVariance() = default;
    explicit TiltVariance(const TiltModel& model);
    /// One that was kept: its `rows()` and `samples()`.
    TiltVariance(std::vector<float> rows, std::size_t samples)
        : samples_(samples), rows_(std::move(rows)) {}

    /// False: no cause changes any sample otherwise than a nuisance does.
    bool usable() const { return !rows_.empty(); }
    std::size_t samples() const { return samples_; }
    /// One of `samples()` values a direction: the estimate is the root of the sum of the squares of
    /// their products with a difference.
    const std::vector<float>& rows() const { return rows_; }
    /// `difference`: of a picture from the one without causes, a value a sample; nothing when not
    /// usable.
    std::optional<double> rms(const std::vector<double>& difference) const;

private:
    std::size_t samples_ = 0;
    std::vector<float> rows_;
};

}  // namespace culet
