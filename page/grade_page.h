#pragma once
// The page of `culet grade`: what one cut, or several side by side, do with light.

#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct GradePicture {
    std::string scope;    ///< aset, idealscope, darkfield, hearts, arrows
    std::string summary;  ///< one line
    std::string uri;      ///< a PNG as data URI
};

struct GradeDesign {
    std::string json;          ///< its grade
    std::string section_json;  ///< light paths (render/grade/path_section.h)
    std::vector<GradePicture> pictures;
    Solid solid;
};

struct GradeView {
    std::vector<GradeDesign> designs;  ///< at least one
    std::string version, command;
    std::string optimized_json;  ///< of `culet optimize`; the designs are then its before and
                                 ///< after; or empty
};

/// "7 of 8 hearts"; "12 hearts" if there are more than a standard brilliant has.
std::string counted_of_eight(int count, const std::string& what);

/// Contains the grades as data. Throws InputError when a grade is not a JSON object.
std::string grade_page(const GradeView& view);

}  // namespace culet
