#pragma once
// Fits a convex stone, the turns of a turntable and the camera before it to outlines in pictures.

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "fit/silhouettes/plane_condition.h"
#include "fit/silhouettes/turning_camera.h"

namespace culet {

/// Places in one picture, in order along the stone's outline, as `TurningCamera` counts them.
using PicturePoints = std::vector<glm::dvec2>;

struct TurningOutlines {
    std::vector<PicturePoints> outlines;
    TurningSeries start;  ///< a turn for each outline
    ExpectedSeries expected;
    std::vector<Plane> planes;  ///< where facets may be; empty: the outlines alone tell
    std::vector<PlaneCondition> conditions;  ///< for `refit_turning`
    /// For `refit_turning`: by how much errors of whole sides make the sigmas of points larger.
    double sigmas_times = 1;
};

struct TurningFit {
    Solid solid;  ///< facets are named F1, F2, ...
    TurningSeries series;
    std::vector<double> turn_sigmas;  ///< radians
    /// Standard uncertainty of each facet's normal, radians, the larger of two tilts. A facet that
    /// no outline shows keeps that of its start: see `k_turning_tilt`.
    std::vector<double> tilt_sigmas;
    double scatter = 0;  ///< robust standard deviation of a point, across the outline
};

/// Sigma of a facet's tilt about the plane with which the fit started, radians.
inline constexpr double k_turning_tilt = 0.17;

/// Throws InputError if the outlines enclose no stone.
TurningFit fit_turning(const TurningOutlines& outlines);

/// Keeps to the given planes and adds none; facets are named by their planes: F1 is the first.
TurningFit refit_turning(const TurningOutlines& outlines);

/// The corners of a convex body's outline in a picture, counter-clockwise.
PicturePoints outline_in_picture(std::span<const Vec3> corners, const TurningCamera& camera,
                                 double turn);
struct FromOutline {
    double distance = 0;  ///< positive outside
    double side = 0;      ///< length of the outline's side that is nearest
};
/// Of points from that outline.
std::vector<FromOutline> outline_distances(std::span<const Vec3> corners,
                                           const TurningCamera& camera, double turn,
                                           const PicturePoints& points);
/// The turn near `start` that brings the body's outline closest to the points. Its sigma: if a
/// point's is `scatter`.
struct FittedTurn {
    double turn = 0, sigma = 0;
};
FittedTurn fitted_turn(std::span<const Vec3> corners, const TurningCamera& camera, double start,
                       const PicturePoints& points, double scatter);

}  // namespace culet
