#include "page/colour_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace culet {

namespace {

constexpr std::uint32_t k_difference[] = {0x2166ac, 0x4393c3, 0x92c5de, 0xd1e5f0, 0xf7f7f7,
                                          0xfddbc7, 0xf4a582, 0xd6604d, 0xb2182b};
constexpr std::uint32_t k_error[] = {0x000004, 0x1b0c41, 0x4a0c6b, 0x781c6d, 0xa52c60,
                                     0xcf4446, 0xed6925, 0xfb9b06, 0xf7d13d, 0xfcffa4};
constexpr std::uint32_t k_residual[] = {0xffffcc, 0xffeda0, 0xfed976, 0xfeb24c,
                                        0xfd8d3c, 0xfc4e2a, 0xe31a1c, 0xbd0026};
constexpr std::uint32_t k_uncertainty[] = {0xffffd9, 0xedf8b1, 0xc7e9b4, 0x7fcdbb,
                                           0x41b6c4, 0x1d91c0, 0x225ea8};

std::span<const std::uint32_t> stops_of(ColourMap map) {
    if (map == ColourMap::difference) return k_difference;
    if (map == ColourMap::residual) return k_residual;
    if (map == ColourMap::uncertainty) return k_uncertainty;
    return k_error;
}

}  // namespace

std::array<std::uint8_t, 3> colour_at(ColourMap map, double share) {
    const auto stops = stops_of(map);
    double t = share >= 0 ? std::min(share, 1.0) : 0;
    if (map == ColourMap::likeness) t = 1 - t;
    const double at = t * static_cast<double>(stops.size() - 1);
    const auto cell = std::min(static_cast<std::size_t>(at), stops.size() - 2);
    const double part = at - static_cast<double>(cell);
    std::array<std::uint8_t, 3> colour{};
    for (std::size_t c = 0; c < 3; ++c) {
        const auto shift = 16 - 8 * c;
        const double low = stops[cell] >> shift & 255, high = stops[cell + 1] >> shift & 255;
        colour[c] = static_cast<std::uint8_t>(std::lround(low + part * (high - low)));
    }
    return colour;
}

std::string css_colour(ColourMap map, double share) {
    const auto c = colour_at(map, share);
    return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

std::string css_gradient(ColourMap map) {
    std::string gradient = "linear-gradient(to right";
    for (int i = 0; i <= 10; ++i) gradient += ", " + css_colour(map, i / 10.0);
    return gradient + ")";
}

}  // namespace culet
