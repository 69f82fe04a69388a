#pragma once
// A grade as JSON (docs/grade.md).

#include <string>
#include <vector>

#include "render/grade/grade.h"
#include "render/grade/grade_sigma.h"
#include "stone/text/change.h"

namespace culet {

/// Information in a grade's JSON besides the figures.
struct GradeContext {
    std::string name;  ///< of the stone
    std::string file;
    std::string material;             ///< empty: only an index was given
    bool crystal = false;             ///< graded with the mean of its indices
    std::vector<std::string> facets;  ///< names, for the costs
    GradeOptions options;
    const GradeSigma* sigma = nullptr;  ///< null: unknown
    std::vector<FacetCost> costs;
    std::vector<std::string> notes;
    std::vector<Change> changed;  ///< changes made to the given stone
};

/// Fills in what the arguments tell; the caller adds the rest. `material` may be null.
GradeContext grade_context(const Solid& solid, const Material* material,
                           const GradeOptions& options);

std::string grade_json(const Grade& grade, const GradeContext& context);

}  // namespace culet
