#pragma once
// Uncertainties of a grade's figures, and the loss of light caused by each facet.

#include <map>
#include <string>
#include <vector>

#include "render/grade/grade.h"
#include "render/uncertainty/drawn_stones.h"

namespace culet {

struct GradeSigma {
    std::map<std::string, double> figures;  ///< by name, see grade_figures.h
    /// Sigmas of the curves at seven of the grade's tilts; NaN at the others.
    std::vector<TiltCurve> curves;
    bool correlated = false;
    int draws = 0;
    int left_out = 0;  ///< draws that bound no stone
};

/// Grades stones drawn from the uncertainty, face up; sigma is their standard deviation. Figures
/// have kinks and jumps as functions of the angles, so draws tell more than derivatives. `draws`:
/// at least 2. Throws Interrupted.
GradeSigma grade_sigma(const Solid& solid, const GradeIndex& index, const GradeOptions& options,
                       const StoneUncertainty& uncertainty, int draws,
                       const Progress& progress = {});

/// Light lost because one facet differs from the others of its tier.
struct FacetCost {
    int facet = 0;
    double cost = 0;  ///< gain of iso light return, per cent, if the facet followed its tier's mean
    double off = 0;   ///< its inclination minus the tier's mean, radians
};

/// Facets in tiers of two or more, largest cost first; costs below 0.005 are left out.
std::vector<FacetCost> facet_costs(const Solid& solid, const GradeIndex& index,
                                   const GradeOptions& options);

}  // namespace culet
