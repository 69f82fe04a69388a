#pragma once
// Medians of a list, for a typical size where some are far off.

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

/// For an even count the mean of the two middle values; 0 without any.
inline double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

}  // namespace culet
