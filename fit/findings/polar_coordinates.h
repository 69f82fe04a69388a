#pragma once
// Polar angle, azimuth and distance about the stone's own axis, in which symmetric facets are
// alike. Private to the room.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fit/findings/findings.h"
#include "fit/model/linear.h"
#include "stone/solid/axis_groups.h"

namespace culet {

/// Three numbers a facet, in the scale of the fit: angle from the axis; azimuth times its sine
/// (both are angles on the sphere of directions); distance from the middle. For a level facet
/// (within 3 degrees) the first two are its normal's components across the axis.
struct PolarCoordinates {
    std::vector<double> polar, azimuth, distance, sine;
    std::vector<std::array<double, 2>> across;
    std::vector<bool> level;
    Eigen::MatrixXd rows;       ///< derivatives by the unknowns, 3 rows a facet
    Eigen::MatrixXd placement;  ///< derivatives by tilts of the axis and shifts of the middle (4
                                ///< columns)
};
PolarCoordinates polar_coordinates(const FitModel& model, const Shape& shape,
                                   const RowWriter& writer, const std::vector<Tier>& tiers);

/// `deviations`: coordinates less those of the nearest stone of the group at a first guess.
/// `columns`: derivatives by the parameters of such stones (what each orbit shares, the mirror
/// planes' azimuth).
struct SymmetricModel {
    Eigen::VectorXd deviations;
    Eigen::MatrixXd columns;
};
SymmetricModel symmetric_model(const PolarCoordinates& coordinates, const AxisGroup& group);

}  // namespace culet
