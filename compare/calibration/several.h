#pragma once
// Combines photographs of one stone, and finds what each contributes.

#include <optional>
#include <string>
#include <vector>

#include "compare/calibration/calibrated_verdict.h"
#include "compare/scores/compare.h"

namespace culet {

struct PhotographRow {
    std::string name;
    std::string page;  ///< its own report, relative to the common one
    std::string scores_json;
    Comparison comparison;
    std::optional<CalibratedVerdict> calibrated;
};

/// Null where none was found.
const EquivalentError* equivalent_of(const PhotographRow& row);

struct SeveralPhotographs {
    Verdict verdict = Verdict::no_evidence;
    std::string reason;
    /// Mean of the logarithms of the photographs' equivalent facet errors with inverse-variance
    /// weights. Its interval comes from those variances or from the photographs' scatter, whichever
    /// is wider.
    EquivalentError together;
    /// The same without each of the photographs, in their order.
    std::vector<EquivalentError> without;
    /// Largest change of the answer when one is left out, as a factor of at least 1.
    double largest_change = 1;
};

/// The majority's verdict, in a tie the worse one. Refused photographs count only when all are.
SeveralPhotographs together(const std::vector<PhotographRow>& rows);

/// The combined answer, and every photograph's scores under "photographs".
std::string several_json(const SeveralPhotographs& several, const std::vector<PhotographRow>& rows);

}  // namespace culet
