#pragma once
// Quantiles of a list of numbers.

#include <algorithm>
#include <vector>

namespace culet {

/// The number of rank floor(share (n - 1)): 0 the smallest, 1 the largest. `values` must not be
/// empty.
template <class Number>
Number quantile(std::vector<Number> values, double share) {
    const auto rank =
        values.begin() + static_cast<std::ptrdiff_t>(share * double(values.size() - 1));
    std::nth_element(values.begin(), rank, values.end());
    return *rank;
}

}  // namespace culet
