#pragma once
// Readings of angles alone, which say nothing of how large the stone is. Private to the room.

#include <vector>

#include "fit/findings/result.h"

namespace culet {

/// Some reading is a length, a volume or a weight.
bool says_size(const std::vector<Reading>& readings);

/// The depth of the mesh, as a reading of a millionth. Without any length the angles agree best
/// with a stone of no size at all, all of whose planes meet in one point.
Reading size_of_mesh(const Stone& stone);

/// The result of a fit with the mesh's size as the last of its readings, without that reading: the
/// size is one more thing that nothing measured fixes.
void take_back_size(const Reading& size, FitResult& result);

}  // namespace culet
