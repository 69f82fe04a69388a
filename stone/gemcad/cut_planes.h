#pragma once
// The solid of a design's facets.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/gemcad/gemcad_io.h"
#include "stone/solid/solid.h"

namespace culet {

/// A plane of a design's file: `name` may be empty; `place` tells people where it stands.
struct CutPlane {
    Plane plane;
    std::string name, place;
    int tier = 0, facet = 0;  ///< of the design
};

/// Of each tier of the design its one label: that of all its facets, however many of them it
/// stands at. Empty where a tier has none, or several: those are its facets' own.
std::vector<std::string> tier_labels(const Design& design);

/// Fills in the solid with its design, notes and lists of planes. Throws InputError.
void build_solid(ReadCut& cut, Design design, const std::vector<CutPlane>& planes,
                 const CutReading& how, const std::filesystem::path& file);

}  // namespace culet
