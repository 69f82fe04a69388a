#pragma once
// What a faceter sets on the machine: tier by tier, the angle and the teeth of the index wheel.

#include <string>
#include <vector>

#include "stone/gemcad_io.h"
#include "stone/solid.h"
#include "stone/tiers.h"

namespace culet {

struct CuttingStep {
    std::string tier;  ///< name of the tier, or of its only facet
    StonePart part = StonePart::crown;
    double angle_deg = 0;  ///< mean, from the horizontal: 0 table, 90 girdle
    double least_angle_deg = 0, most_angle_deg = 0;
    std::vector<double> indices;  ///< teeth, in (0, gear], in their order
};

/// Pavilion, culet, girdle, crown, table; within each in the solid's order. Teeth count as in
/// GemCad's designs (cut_planes.h), on the gear of `sheet`. z is up.
std::vector<CuttingStep> cutting_list(const Solid& solid, const CutSheet& sheet);

}  // namespace culet
