#include "render/image/sparkle.h"

#include <algorithm>
#include <cmath>

namespace culet {

namespace {

// Length over which a streak falls to 1/e, as a part of the picture's longer side.
constexpr double k_length = 0.02;

// Spreads exponentially along one diagonal, one way and then back. `step`: 1 to the lower right, -1
// to the lower left.
std::vector<double> streaked(const std::vector<double>& bright, const PictureSize& size, int step,
                             double ratio) {
    const int width = size.width, height = size.height;
    const auto at = [&](int x, int y) { return static_cast<std::size_t>(y * width + x); };
    std::vector<double> forth = bright, back = bright;
    for (int y = 1; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (x - step >= 0 && x - step < width)
                forth[at(x, y)] += ratio * forth[at(x - step, y - 1)];
        }
    }
    for (int y = height - 2; y >= 0; --y) {
        for (int x = 0; x < width; ++x) {
            if (x + step >= 0 && x + step < width)
                back[at(x, y)] += ratio * back[at(x + step, y + 1)];
        }
    }
    // Normalise the whole streak to 1.
    const double whole = (1 + ratio) / (1 - ratio);
    for (std::size_t i = 0; i < forth.size(); ++i)
        forth[i] = (forth[i] + back[i] - bright[i]) / whole;
    return forth;
}

}  // namespace

void add_sparkle(std::vector<float>& rgb, const PictureSize& size, double strength) {
    const double ratio = std::exp(-1 / std::max(1.0, k_length * std::max(size.width, size.height)));
    const std::size_t pixels = rgb.size() / 3;
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double> bright(pixels);
        for (std::size_t i = 0; i < pixels; ++i)
            bright[i] = std::max(0.0, static_cast<double>(rgb[3 * i + c]) - 1);
        const std::vector<double> down = streaked(bright, size, 1, ratio),
                                  up = streaked(bright, size, -1, ratio);
        for (std::size_t i = 0; i < pixels; ++i)
            rgb[3 * i + c] += static_cast<float>(strength * (down[i] + up[i]) / 2);
    }
}

}  // namespace culet
