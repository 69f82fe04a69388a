#pragma once
// The standard cuts from their proportions: closed solids with clean meets and the trade's facet
// names, to start a fit or a study. Lengths in mm, table up (+z), the girdle's middle at z = 0,
// length along x.
//
// Facet names: T table, S stars, C crown mains (bezels), U upper halves, G girdle, L lower halves,
// P pavilion mains, CU culet; numbered counter-clockwise from azimuth 0. Step cuts: C1E is the
// first crown tier (next to the girdle) on the side that faces +x; E, NE, N, NW, W, SW, S, SE.
// Princess: the same with E, N, W, S. P2Ea and P2Eb are the two halves of the second chevron below
// the girdle; a is nearer to the next side counter-clockwise, b to the one before. A stone turned
// by azimuth keeps its names.

#include <map>
#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct CutParameter {
    std::string name;  ///< as on the command line, e.g. "crown-angle"
    double value = 0, least = 0, most = 0;
    std::string unit;  ///< "mm", "%", "deg" or ""
    std::string what;
};

struct CutKind {
    std::string name;
    std::string summary;
    std::vector<CutParameter> parameters;
    bool convex = true;
};

const std::vector<CutKind>& cut_kinds();

/// `emerald` is `step`. Throws InputError with the nearest name.
const CutKind& cut_kind(const std::string& name);

/// `values` override defaults. Throws InputError for unknown parameters, values out of range, or
/// proportions that cannot be cut together.
Solid make_cut(const std::string& name, const std::map<std::string, double>& values = {});

}  // namespace culet
