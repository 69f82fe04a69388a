#pragma once
// How the stone stands about up, where nothing but calipers across it tells. Which corners their
// jaws touch changes with the turn, and chi-square along it has an end of its own for each.

#include <optional>

#include "fit/solve/kkt_solver.h"
#include "fit/solve/relaxation.h"

namespace culet {

/// What the mesh says against how the shape stands about up, in chi-square: as sure as the corners
/// of both are near to each other, and no more than 25, since the mesh may have been turned. Half a
/// turn is nothing to a caliper, and nothing here.
double turn_off_the_mesh(const Relaxation& relaxation, const Shape& shape);

/// The shape turned about up to where the calipers and the mesh together say that it stands, if
/// that is elsewhere; nothing where something else (an azimuth, a mirror) says it. The shape has to
/// be at an end of the search.
///
/// Facets that lean the other way may gain only where the stone stands otherwise, and the other way
/// round: with the calipers loosened the best few sets of such facets are found (see
/// sign_ambiguity.h), and the stone is turned with each of them, too.
///
/// At each turn chi-square is least over everything else that is varied: without the calipers let
/// the readings leave their widths w with the covariance W; then chi-square is (w - read)'
/// (W + S)^-1 (w - read) and a constant, exactly where equations are linear. Costs one
/// factorisation and two solutions for each corner that a jaw may touch. `solver` may know the
/// pattern of the equations from steps before.
std::optional<Shape> turned_better(Relaxation& relaxation, KktSolver& solver, const Shape& shape,
                                   const PenaltyScale& penalty);

}  // namespace culet
