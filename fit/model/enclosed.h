#pragma once
// The solid that a shape's planes enclose, and its corners in terms of the unknowns.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fit/model/fit_model.h"

namespace culet {

struct Enclosed {
    Solid solid;
    std::shared_ptr<const Outline> outline;
    bool closed = false;               ///< false: the planes do not close
    std::vector<std::string> missing;  ///< facets that have no part in the solid
};
Enclosed enclosed_by(const FitModel& model, const Shape& shape);

/// The solid of the mesh's own facets and the shape's points.
Solid met_solid(const FitModel& model, const Shape& shape);

/// Facets, and the corners of their neighbours, which stay below them: in order. None of a stone
/// that need not be convex.
std::vector<std::pair<int, int>> hinges_of(const FitModel& model);

}  // namespace culet
