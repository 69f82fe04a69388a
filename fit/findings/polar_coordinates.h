#pragma once
// A stone's planes as a symmetric stone has them alike: polar angle, azimuth and distance about an
// axis of the stone's own. Private to the room.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fit/findings/findings.h"
#include "fit/model/linear.h"
#include "stone/solid/axis_groups.h"

namespace culet {

/// Three numbers a facet, in the scale of the fit: angle from the axis; azimuth times the sine of
/// that angle (so that both are angles on the sphere of directions); distance from the middle. Of a
/// facet that lies level (within 3 degrees) the first two are its normal's components across.
struct PolarCoordinates {
    std::vector<double> polar, azimuth, distance, sine;
    std::vector<std::array<double, 2>> across;
    std::vector<bool> level;
    Eigen::MatrixXd rows;       ///< of small steps of the unknowns, 3 for each facet
    Eigen::MatrixXd placement;  ///< by tilts of the axis and shifts of the middle (4 columns)
};
PolarCoordinates polar_coordinates(const FitModel& model, const Shape& shape,
                                   const RowWriter& writer, const std::vector<Tier>& tiers);

/// deviations = what the coordinates are beyond the nearest stone of that group at a first guess;
/// columns = how those change with the parameters of such stones (what each orbit shares, and the
/// mirror planes' azimuth). Rows of facets that `facets` leaves out are zero.
struct SymmetricModel {
    Eigen::VectorXd deviations;
    Eigen::MatrixXd columns;
};
SymmetricModel symmetric_model(const PolarCoordinates& coordinates, const AxisGroup& group);

}  // namespace culet
