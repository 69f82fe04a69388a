#pragma once
// A fit report as colours on its stone.

#include <string>
#include <vector>

#include "page/drawing.h"

namespace culet {

/// What the facets of a drawing show.
enum class FitColour {
    residual,    ///< each facet's worst reading, in standard uncertainties; dashed: a suspect
    uncertainty  ///< how far its normal may be off, one standard uncertainty; dashed: not
                 ///< determined
};

struct FitPaint {
    std::vector<FacetPaint> facets;  ///< one a facet of the solid
    PaintLegend legend;
};

/// `fit_json` is a report of `culet fit`; what it does not say stays plain. Throws InputError when
/// it is no JSON object.
FitPaint fit_paint(const Solid& solid, const std::string& fit_json, FitColour colour);

/// Beyond this many standard uncertainties every residual has the last colour.
inline constexpr double k_worst_shown = 4;

}  // namespace culet
