#pragma once
// How the stone stands about up, where nothing but calipers across it tells. Which corners their
// jaws touch changes with the turn, and chi-square along it has an end of its own for each.

#include <optional>

#include "fit/relaxation.h"
#include "fit/saddle_solver.h"

namespace culet {

/// The shape turned about up to where the calipers fit better by more than chance would notice, if
/// there is such a place within 10 degrees; nothing where there is none, or where something else
/// (an azimuth, a mirror) says how the stone stands. The shape has to be at an end of the search.
///
/// At each turn chi-square is least over everything else that is varied: without the calipers let
/// the readings leave their widths w with the covariance W; then chi-square is (w - read)'
/// (W + S)^-1 (w - read) and a constant, exactly where equations are linear. Costs one
/// factorisation and two solutions for each corner that a jaw may touch. `solver` may know the
/// pattern of the equations from steps before.
std::optional<Shape> turned_better(Relaxation& relaxation, SaddleSolver& solver, const Shape& shape,
                                   const Softness& softness);

}  // namespace culet
