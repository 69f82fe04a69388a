#pragma once
// The tests behind find_symmetry.h, of one fit. Private to the room.

#include "fit/find_symmetry.h"
#include "fit/model/system.h"
#include "fit/uncertainty/inference.h"

namespace culet {

/// `system` must hold no reading that declares its symmetry (`declares_whole_symmetry`): that would
/// be found again.
SymmetryReport symmetry_of(const System& system, const Shape& shape, const Inference& inference,
                           const FitOptions& options);

}  // namespace culet
