#pragma once
// A graded stone, for commands that grade: its figures and its JSON.

#include <string>
#include <vector>

#include "app/input/grade_input.h"
#include "render/grade/grade.h"
#include "render/grade/grade_sigma.h"

namespace culet {

struct Graded {
    GradeInput input;
    Grade grade;
    GradeSigma sigma;
    std::vector<FacetCost> costs;
    std::string json;
};

/// `tilts`: "FROM:TO:STEP", or angles separated by commas; all in degrees. Throws InputError.
GradeOptions grade_options(double head_deg, const std::string& tilts);

/// `draws`: stones drawn at random for the sigmas where the input's uncertainty is known; 0: no
/// sigmas.
Graded grade_input(GradeInput input, const GradeOptions& options, int draws, bool quiet);

}  // namespace culet
