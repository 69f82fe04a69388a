#pragma once
// The sheet that lies beside the faceting machine: tiers in the order of cutting, angles, index
// settings, what each is cut to, drawings and proportions.

#include <string>
#include <vector>

#include "stone/design/cutting_list.h"
#include "stone/solid/solid.h"

namespace culet {

struct CuttingSheet {
    std::string name, version;
    Design design;
    Solid solid;  ///< table up (+z)
    std::vector<CuttingStep> steps;
    double teeth = 96;  ///< of the index wheel
    std::string unit;   ///< of lengths; empty: the design's own, without size
    /// By step, degrees: one standard uncertainty of its least sure angle; empty: none is known.
    std::vector<double> sigmas_deg;
};

/// A whole page in itself, to be printed on one A4.
std::string cutting_sheet_page(const CuttingSheet& sheet);

/// The same as lines of text.
std::string cutting_sheet_text(const CuttingSheet& sheet);

}  // namespace culet
