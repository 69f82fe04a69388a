#pragma once
// One figure of a comparison, and what it is worth.

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

/// One score beside what it is worth. The null is the same score for the same render, turned or
/// mirrored in the picture's plane: what the stone's outline and its general brightness reach
/// without any agreement of its pattern.
struct Score {
    std::string key;              ///< as in the JSON: "zncc", "ssim", ...
    std::optional<double> value;  ///< nothing: not defined for these pictures, see `note`
    bool higher_is_better = true;
    bool is_correlation = false;  ///< z is then taken of atanh (Fisher 1915)
    std::vector<double> null;     ///< one value a draw, in the order drawn
    double null_mean = 0, null_sd = 0;
    /// (value - null_mean) / null_sd, positive when the value is better than the null.
    std::optional<double> z;
    /// Share of draws at least as good as the value, (count + 1) / (draws + 1).
    std::optional<double> p;
    std::string note;
};

}  // namespace culet
