#pragma once
// The solid that a shape's planes enclose, with its corners as functions of the unknowns.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fit/model/fit_model.h"

namespace culet {

struct Enclosed {
    Solid solid;
    std::shared_ptr<const Outline> outline;
    bool closed = false;               ///< false: the planes enclose no bounded solid
    std::vector<std::string> missing;  ///< facets that are not part of the solid
};
Enclosed enclosed_by(const FitModel& model, const Shape& shape);

/// Returns the solid of the mesh's facets and the shape's points.
Solid met_solid(const FitModel& model, const Shape& shape);

/// Returns the hinges, sorted: pairs of a facet and a neighbour's corner that must stay below it.
/// Empty for a stone that need not be convex.
std::vector<std::pair<int, int>> hinges_of(const FitModel& model);

}  // namespace culet
