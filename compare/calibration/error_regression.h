#pragma once
// Predicts the logarithm of a stone's facet error from its scores: multivariate inverse regression
// on draws of known error.

#include <optional>
#include <vector>

namespace culet {

/// The logarithm is a weighted sum of the standardised scores. Because scores are correlated and
/// there are hardly more draws than scores, the weights are shrunk by ridge regression (Hoerl and
/// Kennard 1970), with a strength from generalised cross-validation (Golub, Heath and Wahba 1979).
/// All levels of error share the weights, because each has few draws. A missing score is a NaN.
class ErrorRegression {
public:
    ErrorRegression() = default;
    /// `scores[draw][score]`, with about equal slopes against the logarithm. Draws that lack one of
    /// the scores that are asked for are left out.
    ErrorRegression(std::vector<double> log_errors, std::vector<std::vector<double>> scores);

    /// Nothing when all scores are missing, or fewer than three draws have them.
    std::optional<double> of(const std::vector<double>& scores) const;

    /// Each draw's leave-one-out error (Cook and Weisberg 1982, 2.2: residual / (1 - leverage));
    /// NaN for a draw that lacks a score.
    const std::vector<double>& left_out() const { return left_out_; }

private:
    struct Fit {
        std::vector<double> weights;
        double constant = 0;
        std::vector<double> left_out;
    };
    std::optional<Fit> fit(const std::vector<std::size_t>& known) const;

    std::vector<double> log_errors_;
    std::vector<std::vector<double>> scores_;
    std::optional<Fit> complete_;
    std::vector<double> left_out_;
};

}  // namespace culet
