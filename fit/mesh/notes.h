#pragma once
// Notes on what the fit changed in the mesh to suit the readings. Private to the room.

#include <string>

#include "fit/model/fit_model.h"

namespace culet {

/// Says that azimuths declared to count from the mesh count from elsewhere; empty where they do
/// not.
std::string other_turn(const FitModel& model);

/// Says that the mesh was probably drawn in another unit; empty where it was not.
std::string other_size(const FitModel& model);

}  // namespace culet
