#pragma once
// The figures of a grade by name, as its JSON has them: what sigmas and comparisons are told of.

#include <string>
#include <vector>

#include "render/grade/grade.h"

namespace culet {

struct GradeFigure {
    std::string name;   ///< "iso", "iso_table", "aset.red", "balance.leak", ...
    std::string words;  ///< for people
    double value = 0;
    bool percent = false;  ///< of light return; else a fraction, or degrees for `fire.spread_deg`
};

/// Face up; what is not known of the stone (no table, no dispersion) is left out.
std::vector<GradeFigure> figures_of(const Grade& grade);

}  // namespace culet
