#pragma once
// Light paths as cutters draw them: in a vertical section through the stone's middle, with light
// from straight above.

#include <array>
#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

enum class SectionEnd { returned, head, leak, trapped };
const char* name_of(SectionEnd end);

/// x outward in the section, y up.
using SectionPoint = std::array<double, 2>;

struct SectionPath {
    std::vector<SectionPoint> points;  ///< from outside to outside
    SectionEnd end = SectionEnd::trapped;
};

struct PathSection {
    double azimuth = 0;  ///< of the section: a pavilion main's
    std::vector<SectionPoint> outline;
    std::vector<SectionPath> paths;
};

/// Each path exits at the first side that transmits more than half of it, and ends after nine
/// faces at most. Sides perpendicular to the section are exact; others are drawn where they
/// intersect it, and reflect as if perpendicular. `head`: half angle, radians.
PathSection path_section(const Solid& convex, double n, double head);

/// {"azimuth_deg", "outline": [[x, y], ..], "paths": [{"points", "end"}]}
std::string section_json(const PathSection& section);

}  // namespace culet
