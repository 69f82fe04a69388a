#pragma once
// The lines of a design's file: facets that are cut alike.

#include <string>
#include <vector>

#include "stone/design/design.h"

namespace culet {

struct CutLine {
    CutSetting setting;  ///< as it reads back from the texts
    std::string angle, distance;
    std::vector<std::string> indices, labels;  ///< of each facet; a label may be empty
    std::vector<int> facets;                   ///< of the solid; -1: only in the design
    const DesignTier* tier = nullptr;          ///< of the design; null: it lacks these facets
    bool ends_tier = false;                    ///< the last line of `tier`

    Plane plane(std::size_t facet, const Solid& solid, const Design& design) const;
};

/// What the facets of one line share: angle and distance (.asc); the distance alone, since each has
/// its normal (.gcs); nothing but the tier (.gem).
enum class LineShares { setting, distance, tier };

/// The solid in its design's order, and what the design has besides. `word` is a name as the file
/// holds it. Labels that the reader infers are empty.
std::vector<CutLine> cut_lines(const Solid& solid, const Design& design, LineShares shares,
                               std::string (*word)(const std::string&));

}  // namespace culet
