// Wavelengths at which materials are probed before drawing.
#pragma once

#include <vector>

namespace culet {

// Evenly spaced over the eye's response.
inline constexpr double k_first_nm = 410, k_last_nm = 690;
inline constexpr int k_probes = 15;

inline std::vector<double> even_nodes(int count) {
    std::vector<double> nm;
    for (int i = 0; i < count; ++i)
        nm.push_back(k_first_nm + (k_last_nm - k_first_nm) * i / (count - 1));
    return nm;
}

}  // namespace culet
