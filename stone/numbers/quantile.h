#pragma once
// The value below which a part of numbers lies.

#include <algorithm>
#include <vector>

namespace culet {

/// `share` of all but one, rounded down, are no larger: 0 the least, 1 the largest. There must be
/// some.
template <class Number>
Number quantile(std::vector<Number> values, double share) {
    const auto rank =
        values.begin() + static_cast<std::ptrdiff_t>(share * double(values.size() - 1));
    std::nth_element(values.begin(), rank, values.end());
    return *rank;
}

}  // namespace culet
