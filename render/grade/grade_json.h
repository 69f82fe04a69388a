#pragma once
// A grade as JSON for everyone (docs/grade.md).

#include <string>
#include <vector>

#include "render/grade/grade.h"
#include "render/grade/grade_sigma.h"
#include "stone/text/change.h"

namespace culet {

/// What a grade's JSON tells beside its figures.
struct GradeContext {
    std::string name;  ///< of the stone
    std::string file;
    std::string material;             ///< empty: an index alone
    bool crystal = false;             ///< graded with the mean of its indices
    std::vector<std::string> facets;  ///< names, for the costs
    GradeOptions options;
    const GradeSigma* sigma = nullptr;  ///< none: no uncertainties are known
    std::vector<FacetCost> costs;
    std::vector<std::string> notes;
    std::vector<Change> changed;  ///< of the stone, against what was given
};

/// What is known of the stone itself; the rest is left to be filled in. `material`: none, nullptr.
GradeContext grade_context(const Solid& solid, const Material* material,
                           const GradeOptions& options);

std::string grade_json(const Grade& grade, const GradeContext& context);

}  // namespace culet
