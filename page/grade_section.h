#pragma once
// Parts of the page of a grade.

#include <string>

#include "page/template.h"

namespace culet {

/// The light paths of a section as a drawing, from the JSON of a section
/// (render/grade/path_section.h); empty where it has no outline.
std::string section_drawing(const std::string& section_json);

/// What was optimised, from the JSON of `culet optimize`; false where it is empty.
View optimized_view(const std::string& optimized_json);

}  // namespace culet
