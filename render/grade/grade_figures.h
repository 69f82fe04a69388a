#pragma once
// A grade's figures by name, as in its JSON, for sigmas and comparisons.

#include <string>
#include <vector>

#include "render/grade/grade.h"

namespace culet {

struct GradeFigure {
    std::string name;   ///< "iso", "iso_table", "aset.red", "balance.leak", ...
    std::string words;  ///< description for readers
    double value = 0;
    bool percent = false;  ///< of light return; otherwise a fraction, or degrees for
                           ///< `fire.spread_deg`
};

/// Face-up figures; those that do not apply (no table, no dispersion) are left out.
std::vector<GradeFigure> figures_of(const Grade& grade);

}  // namespace culet
