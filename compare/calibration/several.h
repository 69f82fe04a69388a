#pragma once
// Several photographs of one stone: what they say together, and what each of them adds to that.

#include <optional>
#include <string>
#include <vector>

#include "compare/calibration/calibrated_verdict.h"
#include "compare/scores/compare.h"

namespace culet {

struct PhotographRow {
    std::string name;  ///< of the file
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
    /// Weighted mean of the logarithms of the photographs' equivalent facet errors, each weighted
    /// by the inverse of its variance; the interval is the wider of what those variances and the
    /// photographs' scatter give.
    EquivalentError together;
    /// The same without each of the photographs, in their order.
    std::vector<EquivalentError> without;
    /// Largest change of the common answer by leaving one out, as a factor, 1 or more.
    double largest_change = 1;
};

/// The verdict is that of most photographs, the worse one in a tie; refused ones have no say
/// unless all are.
SeveralPhotographs together(const std::vector<PhotographRow>& rows);

/// One object: the common answer, and every photograph's scores under "photographs".
std::string several_json(const SeveralPhotographs& several, const std::vector<PhotographRow>& rows);

}  // namespace culet
