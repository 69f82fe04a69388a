#pragma once
// What a faceter sets on the machine: tier by tier, the angle and the teeth of the index wheel.

#include <string>
#include <vector>

#include "stone/gemcad_io.h"
#include "stone/solid.h"
#include "stone/tiers.h"

namespace culet {

/// How deep the facets of a tier are cut, by what stands already.
struct CutDepth {
    enum class To {
        meet,          ///< a corner that at least three facets cut before make
        pair,          ///< two of the tier meet on an edge of two facets cut before
        centre,        ///< all of the first tier meet in one point under the middle
        outline,       ///< girdle: the stone's width is free
        girdle_width,  ///< what is left of the girdle is free
        size,          ///< free
    };
    To to = To::size;
    std::vector<std::string> at;  ///< meet, pair: tiers cut before that are met
};

struct CuttingStep {
    std::string tier;  ///< name of the tier, or of its only facet
    StonePart part = StonePart::crown;
    std::vector<int> facets;  ///< of the solid
    CutDepth depth;
    double angle_deg = 0;  ///< mean, from the horizontal: 0 table, 90 girdle
    double least_angle_deg = 0, most_angle_deg = 0;
    std::vector<double> indices;  ///< teeth, in (0, gear], in their order
};

/// Pavilion, culet, girdle, crown, table; within each in the solid's order, a design's being its
/// author's, or the steepest first. Teeth count as in
/// GemCad's designs (cut_planes.h), on the gear of `sheet`. z is up.
std::vector<CuttingStep> cutting_list(const Solid& solid, const CutSheet& sheet,
                                      bool steepest_first = false);

/// "meet G, P1", "centre point", ...
std::string depth_words(const CutDepth& depth);

/// Teeth to a hundredth, 0.04 degrees on a wheel of 96, with blanks between them; "any" of what
/// lies level. The tooth at zero is called by the number of teeth.
std::string index_settings(const CuttingStep& step, double gear);

const char* name_of(StonePart part);

/// The shortest edge between two girdle facets: the girdle where it is thinnest. 0 without one.
double least_girdle(const Solid& solid);

}  // namespace culet
