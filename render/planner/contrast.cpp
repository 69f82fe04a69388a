#include "render/planner/contrast.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "render/colour/colour_error.h"

namespace culet {

namespace {

constexpr double k_pixels = 65536;
constexpr float k_covered = 0.5f;

// A place from 0 to side - 1: fractions of a number's multiples, in 32 bits.
int place_in(int side, std::uint32_t number, std::uint32_t multiple) {
    return static_cast<int>(static_cast<std::uint64_t>(side) * (number * multiple) >> 32);
}
// Of the golden ratio's like in two dimensions (Roberts 2018): no grid of facets falls in with
// them.
constexpr std::uint32_t k_along = 0xC13FA9A9, k_down = 0x91E10DA6;

}  // namespace

Contrast contrast_of(const Picture& picture, int windows, double filled) {
    Contrast found;
    if (picture.coverage.empty()) return found;
    const int width = picture.width / windows, height = picture.height;
    const int side = static_cast<int>(std::sqrt(std::clamp(filled / k_pixels, 1.0, 1e6)));
    std::uint32_t number = 0;
    for (int top = 0; top < height; top += side) {
        for (int left = 0; left < width; left += side, ++number) {
            const int x = left + place_in(side, number, k_along),
                      y = top + place_in(side, number, k_down);
            if (x >= width || y >= height) continue;
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                static_cast<std::size_t>(x);
            if (picture.coverage[pixel] < k_covered) continue;
            const Rgb here = picture.pixel(x, y);
            double most = 0;
            if (x > 0) most = std::max(most, apart(here, picture.pixel(x - 1, y)));
            if (x + 1 < width) most = std::max(most, apart(here, picture.pixel(x + 1, y)));
            if (y > 0) most = std::max(most, apart(here, picture.pixel(x, y - 1)));
            if (y + 1 < height) most = std::max(most, apart(here, picture.pixel(x, y + 1)));
            const double root = std::isfinite(most) ? std::sqrt(most) : 0, mean = mean_of(here),
                         radiance = std::isfinite(mean) ? std::max(0.0, mean) : 0;
            found.pixels.push_back({x, y, root, radiance});
            found.sum += root;
            found.radiance += radiance;
        }
    }
    return found;
}

}  // namespace culet
