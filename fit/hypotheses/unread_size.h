#pragma once
// Readings of angles alone, which do not determine the stone's size. Private to the room.

#include <vector>

#include "fit/findings/result.h"

namespace culet {

bool says_size(const std::vector<Reading>& readings);

/// The mesh's depth with a relative sigma of a millionth. Without any length, the angles agree best
/// with a stone of size zero whose planes all meet in one point.
Reading size_of_mesh(const Stone& stone);

/// Removes that last reading from the result of a fit with it; the size becomes undetermined.
void take_back_size(const Reading& size, FitResult& result);

}  // namespace culet
