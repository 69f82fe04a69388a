#pragma once
// Median of a list, for a typical size where some are far off.

#include <algorithm>
#include <vector>

namespace culet {

/// For an even count the upper of the two middle values. `values` must not be empty.
template <class Number>
Number upper_median(std::vector<Number> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace culet
