#pragma once
// From several scores of one stone to the logarithm of its facet error, by what draws of known
// error have: multivariate inverse regression.

#include <optional>
#include <vector>

namespace culet {

/// The logarithm is a weighted sum of the scores. Scores of one stone go up and down together, and
/// there are hardly more draws than scores: weights are held near zero by ridge regression (Hoerl
/// and Kennard 1970) of the standardised scores, as strongly as generalised cross-validation wants
/// it (Golub, Heath and Wahba 1979). All levels of error share the weights, so that no level hangs
/// on its own few draws. A missing score is a NaN.
class ErrorRegression {
public:
    ErrorRegression() = default;
    /// `scores`: a draw, a score; of about equal slope against the logarithm. Draws that lack one
    /// of the scores that are asked about are left out.
    ErrorRegression(std::vector<double> log_errors, std::vector<std::vector<double>> scores);

    /// Nothing when all scores are missing, or fewer than three draws have those that are not.
    std::optional<double> of(const std::vector<double>& scores) const;

    /// By how much each draw's answer is off when the draw itself is left out of the fit (Cook and
    /// Weisberg 1982, 2.2: residual over one less its leverage); NaN for one that lacks a score.
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
