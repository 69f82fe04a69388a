#pragma once
// Light paths as cutters draw them: an upright section through the stone's middle, and light from
// straight above that is reflected by the section's sides.

#include <array>
#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

enum class PathEnd { returned, head, leak, trapped };
const char* name_of(PathEnd end);

/// x outward in the section, y up.
using SectionPoint = std::array<double, 2>;

struct SectionPath {
    std::vector<SectionPoint> points;  ///< from outside to outside
    PathEnd end = PathEnd::trapped;
};

struct PathSection {
    double azimuth = 0;  ///< of the section: a pavilion main's
    std::vector<SectionPoint> outline;
    std::vector<SectionPath> paths;
};

/// Each path leaves where more than half of it does, and ends after nine faces at most. Sides that
/// stand across the section are exact; others are drawn where they cut it, and reflect as if they
/// stood across. `head`: half angle, radians.
PathSection path_section(const Solid& convex, double n, double head);

/// {"azimuth_deg", "outline": [[x, y], ..], "paths": [{"points", "end"}]}
std::string section_json(const PathSection& section);

}  // namespace culet
