#pragma once
// How sure the figures of a grade are, and which facet costs how much light.

#include <map>
#include <string>
#include <vector>

#include "render/grade/grade.h"
#include "render/uncertainty/drawn_stones.h"

namespace culet {

struct GradeSigma {
    std::map<std::string, double> figures;  ///< by the names of grade_figures.h
    /// Of the grade's curves, at seven of its tilts; NaN at the others.
    std::vector<TiltCurve> curves;
    bool correlated = false;
    int draws = 0;
    int left_out = 0;  ///< draws that were no stone
};

/// Stones drawn from the uncertainty, graded face up; sigma is their standard deviation. Figures
/// are continuous in the angles but for their edges, and bent where they are: draws tell what
/// slopes would not. `draws` at least 2. Throws Interrupted.
GradeSigma grade_sigma(const Solid& solid, const GradeIndex& index, const GradeOptions& options,
                       const StoneUncertainty& uncertainty, int draws,
                       const Progress& progress = {});

/// What one facet's departure from the others of its tier costs.
struct FacetCost {
    int facet = 0;
    double cost = 0;  ///< per cent of iso light return gained with the facet as its tier's mean
    double off = 0;   ///< its inclination's departure from the tier's mean, radians
};

/// Of facets in tiers of two or more, the dearest first; what costs less than 0.005 is left out.
std::vector<FacetCost> facet_costs(const Solid& solid, const GradeIndex& index,
                                   const GradeOptions& options);

}  // namespace culet
