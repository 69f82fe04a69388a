#pragma once
// The sheet beside the faceting machine: tiers in cutting order with angle, index settings and
// depth, drawings and proportions.

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
    std::string unit;   ///< of lengths; empty: the design's own, which has no size
    /// By step, degrees: the largest standard uncertainty of its angles; empty: unknown.
    std::vector<double> sigmas_deg;
};

/// A step as the sheet says it, in the order of the steps.
struct SheetRow {
    std::string tier, part;
    std::string angle;    ///< degrees, with its sigma where known
    std::string indices;  ///< `printed_indices`
    std::string depth;    ///< `depth_words`
};
std::vector<SheetRow> sheet_rows(const CuttingSheet& sheet);

/// Facets, symmetry, index wheel, and what angles and lengths are given in; one line.
std::string about_sheet(const CuttingSheet& sheet);

/// A page to print on one sheet of A4.
std::string cutting_sheet_page(const CuttingSheet& sheet);

/// The same as lines of text, at most 80 columns wide.
std::string cutting_sheet_text(const CuttingSheet& sheet);

}  // namespace culet
