#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "render/image/codecs/codecs.h"
#include "stone/errors.h"

namespace culet {

namespace {

constexpr double k_most_pixels = 268435456.0;  // 2^28
constexpr double k_tightest = 20000;           // pixels a byte, more than any codec packs

// Where column x of row y comes from, in pixels of the stored picture (TIFF 6.0, tag 274).
std::size_t stored_place(int orientation, std::size_t x, std::size_t y, std::size_t stored_width,
                         std::size_t stored_height) {
    const bool transposed = orientation >= 5;
    std::size_t column = transposed ? y : x, row = transposed ? x : y;
    if (orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8)
        column = stored_width - 1 - column;
    if (orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7)
        row = stored_height - 1 - row;
    return row * stored_width + column;
}

}  // namespace

void check_size(std::uint64_t width, std::uint64_t height, std::size_t bytes, const char* format,
                const std::filesystem::path& file) {
    const double pixels = static_cast<double>(width) * static_cast<double>(height);
    if (pixels > k_most_pixels) {
        throw InputError(file, fmt::format("is a {} of {} x {} pixels; up to 2^28 pixels are read",
                                           format, width, height));
    }
    if (pixels == 0) {
        throw InputError(file, fmt::format("is a {} that does not state its size: it is cut off "
                                           "or of an unusual kind",
                                           format));
    }
    if (pixels / k_tightest > static_cast<double>(bytes)) {
        throw InputError(file, fmt::format("is a {} of {} x {} pixels in {} bytes: it is cut off",
                                           format, width, height, bytes));
    }
}

DecodedPixels turned_upright(DecodedPixels stored, int orientation) {
    if (orientation < 2 || orientation > 8) return stored;
    DecodedPixels result{stored.width, stored.height, stored.channels, {}};
    if (orientation >= 5) std::swap(result.width, result.height);
    const auto width = static_cast<std::size_t>(result.width),
               height = static_cast<std::size_t>(result.height),
               channels = static_cast<std::size_t>(result.channels);
    std::visit(
        [&](const auto& from) {
            std::decay_t<decltype(from)> to(from.size());
            auto next = to.begin();
            for (std::size_t y = 0; y < height; ++y) {
                for (std::size_t x = 0; x < width; ++x) {
                    const std::size_t place =
                        stored_place(orientation, x, y, static_cast<std::size_t>(stored.width),
                                     static_cast<std::size_t>(stored.height));
                    next = std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(place * channels),
                                       channels, next);
                }
            }
            result.samples = std::move(to);
        },
        stored.samples);
    return result;
}

}  // namespace culet
