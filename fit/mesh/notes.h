#pragma once
// What the fit had to do to the mesh before its readings suited it. Private to the room.

#include <string>

#include "fit/model/fit_model.h"

namespace culet {

/// Azimuths are said to count from the mesh, and count from elsewhere; empty where they do not.
std::string other_turn(const FitModel& model);

/// The mesh was drawn in another unit, most likely; empty where it was not.
std::string other_size(const FitModel& model);

}  // namespace culet
