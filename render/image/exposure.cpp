#include "render/image/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

namespace culet {

namespace {

// Smallest coverage of a pixel that counts as the stone.
constexpr float k_covered = 0.5f;

constexpr std::uint32_t k_shift = 16;
constexpr std::size_t k_buckets = std::size_t{1} << 15;

// Bits of a non-negative number, which sort like the number.
std::uint32_t order_of(float number) {
    std::uint32_t bits = 0;
    const float positive = number > 0 ? number : 0;
    std::memcpy(&bits, &positive, sizeof bits);
    return bits;
}

}  // namespace

double exposure_for_stone(const Picture& picture, double share_over_white) {
    // Count by the upper half of the bits, so that only one bucket must be sorted.
    std::vector<std::size_t> counts(k_buckets);
    std::size_t all = 0;
    const auto each = [&picture](const auto& visit) {
        for (std::size_t p = 0; p < picture.pixels(); ++p) {
            if (!picture.coverage.empty() && picture.coverage[p] < k_covered) continue;
            const float* rgb = picture.rgb.data() + 3 * p;
            const float most = std::max({rgb[0], rgb[1], rgb[2]});
            if (picture.coverage.empty() && !(most > 0)) continue;
            if (std::isfinite(most)) visit(order_of(most));
        }
    };
    each([&](std::uint32_t order) {
        ++counts[order >> k_shift];
        ++all;
    });
    if (all == 0) return 1;
    auto rank = static_cast<std::size_t>((1 - share_over_white) * static_cast<double>(all - 1));
    std::uint32_t bucket = 0;
    while (rank >= counts[bucket]) rank -= counts[bucket++];
    std::vector<std::uint32_t> near;
    near.reserve(counts[bucket]);
    each([&](std::uint32_t order) {
        if (order >> k_shift == bucket) near.push_back(order);
    });
    const auto at = near.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(near.begin(), at, near.end());
    float white = 0;
    std::memcpy(&white, &*at, sizeof white);
    return white > 0 ? 1 / static_cast<double>(white) : 1;
}

}  // namespace culet
