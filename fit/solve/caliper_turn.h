#pragma once
// Where an earlier result goes on from. Private to the room.

#include "fit/solve/relaxation.h"

namespace culet {

/// The shape as it is, turned about up by a little to where it fits the calipers best: a result is
/// told as its mesh lies, not as it lay between the jaws. Itself where something else says how it
/// stands.
Shape turned_to_calipers(const Relaxation& relaxation, const Shape& shape);

}  // namespace culet
