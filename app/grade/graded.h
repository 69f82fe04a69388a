#pragma once
// A graded stone, for commands that grade: its figures, its JSON, its part of a page.

#include <filesystem>
#include <string>
#include <vector>

#include "app/grade/grade_pictures.h"
#include "app/input/grade_input.h"
#include "page/grade_page.h"
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

struct GradePageOptions {
    double head_deg = 10;
    int size = 320;  ///< of the pictures, pixels
    int threads = 0;
};

/// Writes the scopes' pictures to `folder` as PREFIX-aset.png, ...
GradeDesign design_for_page(const Graded& graded, const std::filesystem::path& folder,
                            const std::string& prefix, const GradePageOptions& page);

}  // namespace culet
