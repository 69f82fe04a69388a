#pragma once
// What a faceter sets on the machine: tier by tier in the design's order, angle, index settings,
// and where to stop.

#include <string>
#include <vector>

#include "stone/design/design.h"
#include "stone/design/tiers.h"
#include "stone/solid/solid.h"

namespace culet {

/// How deep the facets of a tier are cut, by what stands already.
struct CutDepth {
    enum class To {
        meet,      ///< a corner that at least three facets cut before make
        pair,      ///< two of the tier meet on an edge of two facets cut before
        point,     ///< all meet in one point on the axis, `length` from the girdle
        width,     ///< girdle: `length` to the facet across
        height,    ///< level: `length` to the lowest point (of a culet to the highest)
        leave,     ///< `length` is left of the tier `at`
        distance,  ///< `length` from the middle of the girdle's plane
        none,      ///< bounds nothing of the finished stone
    };
    To to = To::none;
    std::vector<std::string> at;  ///< meet, pair, leave: tiers cut before
    double length = 0;            ///< in the solid's unit
};

/// Facets that are cut with one setting of the cheater (the fine turn of the index wheel).
struct IndexSetting {
    struct Tooth {
        int tooth = 0;       ///< 1 .. number of teeth
        double own_deg = 0;  ///< the facet's angle where it is not the tier's; else 0
    };
    double cheater = 0;  ///< teeth, within half a tooth
    std::vector<Tooth> teeth;
};

struct CuttingStep {
    std::string tier;  ///< `tier_titles`
    StonePart part = StonePart::crown;
    std::string instruction;  ///< the author's
    std::vector<int> facets;  ///< of the solid
    CutDepth depth;
    double angle_deg = 0;  ///< from the horizontal: the design's, or the median of its facets
    double least_angle_deg = 0, most_angle_deg = 0;
    std::vector<double> indices;  ///< the facets' own, teeth in (0, gear], in their order
    std::vector<IndexSetting> settings;
};

struct CuttingOptions {
    double gear = 0;         ///< teeth of another wheel than the design's; 0: the design's
    double shown_deg = 0.1;  ///< what the goniometer shows: less is not told apart
};

/// In the order of the solid's design (`cutting_design`). A stone that was fitted or cut anew
/// stands turned against its design by what its facets agree on; that turn is taken out. z is up.
std::vector<CuttingStep> cutting_list(const Solid& solid, const CuttingOptions& options = {});

/// Teeth of the wheel that `cutting_list` counts.
double gear_of(const Solid& solid, const CuttingOptions& options);

/// The author's words, and what else fixes the depth: "meet G, P1", "leave 0.20 mm of G", ... A
/// length in `unit`, or where that is empty over `width`, as cutters write designs: "0.031 W".
std::string depth_words(const CuttingStep& step, const std::string& unit, double width);

/// "12 24 36", "10 58 (cheater -0.24), 38 86 (cheater +0.24)", "8 40, 72 at 41.25"; "any" of what
/// lies level.
std::string index_words(const CuttingStep& step);

/// "57 + 16": facets without the girdle's, and these.
std::string facet_count_words(const Solid& solid);

const char* name_of(StonePart part);

/// The shortest edge between two girdle facets: the girdle where it is thinnest. 0 without one.
double least_girdle(const Solid& solid);

}  // namespace culet
