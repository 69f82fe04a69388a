#pragma once
// The tests behind find_symmetry.h, of one fit. Private to the room.

#include "fit/findings/findings.h"
#include "fit/model/options.h"
#include "fit/model/system.h"
#include "fit/uncertainty/covariance.h"

namespace culet {

/// Says that the stone has a symmetry, which would only be found again: exact rotations and
/// mirrors, and those of all facets. One of some facets within a sigma is knowledge like any
/// reading.
bool declares_whole_symmetry(const Reading& reading);

/// `system` must hold no reading that declares its symmetry (`declares_whole_symmetry`): that would
/// be found again.
SymmetryReport symmetry_of(const System& system, const Shape& shape, const Covariance& all,
                           const FitOptions& options);

}  // namespace culet
