#include "render/image/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace culet {

namespace {

// Glints are far brighter than the rest and few: photographers let them burn out.
constexpr double k_share_over_white = 0.02;
// Of a pixel, what the stone must fill to count as its light.
constexpr float k_covered = 0.5f;

}  // namespace

double exposure_for_stone(const Picture& picture) {
    std::vector<double> brightest;
    for (std::size_t p = 0; p < picture.pixels(); ++p) {
        if (!picture.coverage.empty() && picture.coverage[p] < k_covered) continue;
        const float* rgb = picture.rgb.data() + 3 * p;
        const double most = std::max({rgb[0], rgb[1], rgb[2]});
        if (picture.coverage.empty() && !(most > 0)) continue;
        if (std::isfinite(most)) brightest.push_back(most);
    }
    if (brightest.empty()) return 1;
    const auto at =
        brightest.begin() + static_cast<std::ptrdiff_t>((1 - k_share_over_white) *
                                                        static_cast<double>(brightest.size() - 1));
    std::nth_element(brightest.begin(), at, brightest.end());
    return *at > 0 ? 1 / *at : 1;
}

}  // namespace culet
