#pragma once
// What a faceter sets on the machine, tier by tier in the design's order: angle, index settings and
// depth.

#include <string>
#include <vector>

#include "stone/design/design.h"
#include "stone/design/tiers.h"
#include "stone/solid/solid.h"

namespace culet {

/// How deep a tier is cut, relative to what is cut already.
struct CutDepth {
    enum class To {
        meet,      ///< a corner of at least three facets cut before
        pair,      ///< two facets of the tier meet on an edge of two facets cut before
        point,     ///< all meet in one point on the axis, `length` from the girdle
        width,     ///< girdle: `length` to the facet across
        height,    ///< level facets: `length` to the lowest point (for a culet, to the highest)
        leave,     ///< `length` of the tier `at` is left
        distance,  ///< `length` from the middle of the girdle's plane
        none,      ///< bounds nothing of the finished stone
    };
    To to = To::none;
    std::vector<std::string> at;  ///< tiers cut before; for meet, pair, leave
    double length = 0;            ///< in the solid's unit
};

/// Facets that are cut with one setting of the cheater (the fine turn of the index wheel).
struct IndexSetting {
    struct Tooth {
        int tooth = 0;       ///< 1 .. number of teeth
        double own_deg = 0;  ///< the facet's angle where it differs from the tier's; else 0
    };
    double cheater = 0;  ///< teeth, within half a tooth
    std::vector<Tooth> teeth;
};

struct CuttingStep {
    std::string tier;  ///< `tier_titles`
    StonePart part = StonePart::crown;
    std::string instruction;  ///< the author's, and that the tier is frosted
    std::vector<int> facets;  ///< of the solid
    CutDepth depth;
    double angle_deg = 0;  ///< from the horizontal: the design's, or the median of its facets'
    double least_angle_deg = 0, most_angle_deg = 0;
    std::vector<double> indices;  ///< the facets' own teeth in (0, gear], in the order of `facets`
    std::vector<IndexSetting> settings;
};

struct CuttingOptions {
    double gear = 0;         ///< teeth of another wheel than the design's; 0: the design's
    double shown_deg = 0.1;  ///< what the goniometer shows; smaller differences are ignored
};

/// Follows the order of the solid's design (`cutting_design`). A turn against the design that the
/// facets of a fitted or recut stone share is removed. z is up.
std::vector<CuttingStep> cutting_list(const Solid& solid, const CuttingOptions& options = {});

double gear_of(const Solid& solid, const CuttingOptions& options);

/// The author's words, and whatever else fixes the depth: "meet G, P1", "leave 0.20 mm of G", ...
/// Lengths are in `unit`; if that is empty, relative to `width` as cutters write: "0.031 W".
std::string depth_words(const CuttingStep& step, const std::string& unit, double width);

/// "12 24 36", "10 58 (cheater -0.24), 38 86 (cheater +0.24)", "8 40, 72 at 41.25"; "any" for level
/// facets.
std::string index_words(const CuttingStep& step);

/// The same as GemCad prints it on a wheel of so many teeth, beginning with the last tooth, which
/// is zero: "96-08-16", "10-58 (cheater -0.24)", "08-40, 72 at 41.3".
std::string printed_indices(const CuttingStep& step, double gear);

/// "57 + 16": the facets without the girdle's, and the girdle's.
std::string facet_count_words(const Solid& solid);

const char* name_of(StonePart part);

/// The shortest edge between two girdle facets; 0 without one.
double least_girdle(const Solid& solid);

}  // namespace culet
