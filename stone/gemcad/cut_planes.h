#pragma once
// Builds the solid from a design's planes.

#include <filesystem>
#include <string>
#include <vector>

#include "stone/gemcad/gemcad_io.h"
#include "stone/solid/solid.h"

namespace culet {

/// A plane of a design's file. `name` may be empty; `place` tells people where it stands.
struct CutPlane {
    Plane plane;
    std::string name, place;
    int tier = 0, facet = 0;  ///< of the design
};

/// A tier's label, if exactly one stands in it: it holds for all facets. Several labels belong to
/// single facets; the tier has none then.
std::vector<std::string> tier_labels(const Design& design);

/// An angle or index without the rounding of a file that gives planes: designs have four decimals
/// at most.
double without_noise(double setting);

/// Fills in the solid with its design, notes and lists of planes. Throws InputError.
void build_solid(ReadCut& cut, Design design, const std::vector<CutPlane>& planes,
                 const CutReading& how, const std::filesystem::path& file);

}  // namespace culet
