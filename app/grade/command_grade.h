#pragma once
// The page of culet grade, for other commands too.

#include <filesystem>
#include <string>
#include <vector>

#include "app/input/grade_input.h"
#include "app/program/options.h"

namespace culet {

/// Writes report.html, grade.json and pictures of the files side by side, as `culet grade -o` does,
/// below `optimized_json` (of `culet optimize --json`) unless that is empty.
void write_grade_page(const std::vector<std::string>& files, const GradeChoices& choices,
                      const std::filesystem::path& folder, const CommonOptions& common,
                      const std::string& optimized_json = {});

}  // namespace culet
