#pragma once
// One stone of a grade's page: its grade, its scopes' pictures, its light paths.

#include <filesystem>
#include <string>

#include "page/grade_page.h"
#include "render/grade/grade.h"
#include "stone/stone.h"

namespace culet {

struct GradePageOptions {
    double head_deg = 10;
    int size = 320;  ///< of the pictures, pixels along a side
    int threads = 0;
};

/// What was graded: without a material it has the index of `grade` alone.
struct GradedStone {
    const Stone& stone;
    bool has_material = false;
    const Grade& grade;
    const std::string& json;
};

/// Draws the scopes with the engine beams, and writes PREFIX-aset.png, ... to `folder`; if that is
/// empty, they are only in the page. The stone is clear and without double refraction, as for the
/// grade's figures.
GradeDesign graded_design(const GradedStone& graded, const std::filesystem::path& folder,
                          const std::string& prefix, const GradePageOptions& options);

}  // namespace culet
