#pragma once
// The standard cuts by their proportions: closed solids with clean meets and the trade's facet
// names, as a start for a fit or a study. Lengths in mm, table up (+z), the middle of the girdle at
// z = 0, length along x.
//
// Facet names: T table, S stars, C crown mains (bezels), U upper halves, G girdle, L lower halves,
// P pavilion mains, CU culet; numbered counter-clockwise from azimuth 0. Step cuts: C1E is the
// first crown tier (next to the girdle) on the side that looks to +x; E, NE, N, NW, W, SW, S, SE.
// Princess: the same with E, N, W, S; P2Ea and P2Eb are the two halves of the second chevron below
// the girdle, a towards the next side counter-clockwise, b towards the one before. A turned stone
// (azimuth) keeps the names it had before it was turned.

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

/// The kind of that name (`emerald` is `step`). Throws InputError with the nearest name.
const CutKind& cut_kind(const std::string& name);

/// `values` override defaults by parameter name. Throws InputError for an unknown parameter, a
/// value out of its range, or proportions that cannot be cut together.
Solid make_cut(const std::string& name, const std::map<std::string, double>& values = {});

}  // namespace culet
