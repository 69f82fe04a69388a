#pragma once
// Parts of a grade's page.

#include <string>

#include "page/template.h"

namespace culet {

/// Draws the light paths of a section from its JSON (render/grade/path_section.h); empty where it
/// has no outline.
std::string section_drawing(const std::string& section_json);

/// The results of an optimisation, from the JSON of `culet optimize`; false where that is empty.
View optimized_view(const std::string& optimized_json);

}  // namespace culet
