#pragma once
// Writes a stone for printers: 3MF, core specification 1.2.

#include <string>

#include "stone/solid/solid.h"

namespace culet {

/// A ZIP archive, not compressed, of one closed mesh of triangles. `solid` is in mm. Corners have
/// all digits; facets lose their names. The same stone gives the same bytes. Throws InputError for
/// a solid that is not closed, which the format forbids.
std::string three_mf_bytes(const Solid& solid, const std::string& name);

}  // namespace culet
