#pragma once
// Parts of a grade's page.

#include <string>

#include "page/template.h"

namespace culet {

/// Draws the JSON of a section (render/grade/path_section.h); empty where it has no outline.
std::string section_drawing(const std::string& section_json);

/// Shows the JSON of `culet optimize`; false where that is empty.
View optimized_view(const std::string& optimized_json);

}  // namespace culet
