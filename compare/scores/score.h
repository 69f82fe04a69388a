#pragma once
// One score of a comparison, with its significance.

#include <optional>
#include <string>
#include <vector>

namespace culet {

enum class Verdict {
    match,        ///< far better than chance
    partial,      ///< better than chance, but not by much
    no_evidence,  ///< no better than chance
    refused       ///< the outlines do not fit: nothing was compared
};
const char* name_of(Verdict verdict);

/// A score and its null, the same score for the render rotated or mirrored in the picture's plane:
/// what outline and brightness reach without any agreement of the pattern.
struct Score {
    std::string key;              ///< as in the JSON: "zncc", "ssim", ...
    std::optional<double> value;  ///< nothing: undefined for these pictures, see `note`
    bool higher_is_better = true;
    bool is_correlation = false;  ///< z is then computed from atanh (Fisher 1915)
    std::vector<double> null;     ///< one value for each draw, in order
    double null_mean = 0, null_sd = 0;
    /// (value - null_mean) / null_sd; positive: better than the null.
    std::optional<double> z;
    /// (count + 1) / (draws + 1), counting draws at least as good as the value.
    std::optional<double> p;
    std::string note;
};

}  // namespace culet
