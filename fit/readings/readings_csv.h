#pragma once
// Private to the room; `read_readings_csv` of measurement.h is the front.

#include <cstddef>

namespace culet {

/// A stone file with more readings than this is no stone file.
inline constexpr std::size_t k_most_readings = 100000;

}  // namespace culet
