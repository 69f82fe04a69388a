#pragma once
// The light paths of a section as a drawing.

#include <string>

namespace culet {

/// From the JSON of a section (render/grade/path_section.h); empty where it has no outline.
std::string section_drawing(const std::string& section_json);

}  // namespace culet
