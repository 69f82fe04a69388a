#pragma once
// Private to the room; callers use `read_readings_csv` of measurement.h.

#include <cstddef>

namespace culet {

/// A file with more readings than this is no stone file.
inline constexpr std::size_t k_most_readings = 100000;

}  // namespace culet
