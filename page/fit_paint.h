#pragma once
// Colours a stone by its fit report.

#include <string>
#include <vector>

#include "page/drawing.h"

namespace culet {

enum class FitColour {
    residual,    ///< each facet's worst reading, in standard uncertainties; dashed: a suspect
    uncertainty  ///< uncertainty of its normal, one sigma; dashed: not determined
};

struct FitPaint {
    std::vector<FacetPaint> facets;  ///< one per facet of the solid
    PaintLegend legend;
};

/// `fit_json` is a report of `culet fit`; other facets stay plain. Throws InputError when it is not
/// a JSON object.
FitPaint fit_paint(const Solid& solid, const std::string& fit_json, FitColour colour);

/// Standard uncertainties: all larger residuals have the last colour.
inline constexpr double k_worst_shown = 4;

}  // namespace culet
