#pragma once
// How the stone stands about up, where nothing but calipers across it tells. Which corners their
// jaws touch changes with the turn, and chi-square along it has an end of its own for each.

#include <optional>

#include "fit/relaxation.h"
#include "fit/saddle_solver.h"

namespace culet {

struct Turned {
    Shape shape;
    double nearer = 0;  ///< what chi-square may rise by: it stands more as the mesh does
};

/// The shape turned about up to where the calipers and the mesh together say that it stands, if
/// that is elsewhere; nothing where something else (an azimuth, a mirror) says it. The shape has to
/// be at an end of the search. What the mesh says is as sure as its corners are near to the
/// shape's, and nothing at all at a loss of 25: it may have been turned.
///
/// At each turn chi-square is least over everything else that is varied: without the calipers let
/// the readings leave their widths w with the covariance W; then chi-square is (w - read)'
/// (W + S)^-1 (w - read) and a constant, exactly where equations are linear. Costs one
/// factorisation and two solutions for each corner that a jaw may touch. `solver` may know the
/// pattern of the equations from steps before.
std::optional<Turned> turned_better(Relaxation& relaxation, SaddleSolver& solver,
                                    const Shape& shape, const Softness& softness);

}  // namespace culet
