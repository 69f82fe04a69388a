#pragma once
// The cutter's coordinates of a facet, and the solid of a design's facets.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/gemcad_io.h"
#include "stone/solid.h"

namespace culet {

/// Where a facet is cut. Angle from the horizontal: 0 table, 90 girdle, both sides positive.
struct CutSetting {
    double angle_deg = 0;
    bool pavilion = false;
    double distance = 0;  ///< from the origin, >= 0
    double index = 0;     ///< on the gear; may be fractional
};

/// n = (sin a sin t, sin a cos t, +-cos a) with t = 2 pi (index - offset) / gear. Exact at whole
/// quarters, so that a girdle stands upright and a table lies flat.
Plane plane_of(const CutSetting& setting, const CutSheet& sheet);

/// The inverse; the index lies in (0, |gear|].
CutSetting setting_of(const Plane& plane, const CutSheet& sheet);

/// A plane of a file: `name` may be empty; `place` tells people where it stands.
struct CutPlane {
    Plane plane;
    std::string name, place;
    int tier = -1;  ///< facets of one line of the design
};

/// Of each plane the name of its tier: the one name that its facets are given, however many of them
/// are given it. Empty where a tier has none, or several: those are its facets' own.
std::vector<std::string> tier_names(const std::vector<CutPlane>& planes);

/// Fills in solid, notes and lists of planes. Throws InputError.
void build_solid(ReadCut& cut, const std::vector<CutPlane>& planes, const CutReading& how,
                 const std::filesystem::path& file);

}  // namespace culet
