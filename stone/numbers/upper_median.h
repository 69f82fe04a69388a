#pragma once
// The middle one of numbers, for a usual size among sizes some of which are far off.

#include <algorithm>
#include <vector>

namespace culet {

/// Of an even count the upper one of the two in the middle. There must be some.
template <class Number>
Number upper_median(std::vector<Number> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace culet
