#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "render/image/codecs/codecs.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_most_pixels = 268435456.0;  // 2^28
constexpr double k_tightest = 20000;           // pixels per byte, more than any codec packs

// Index in the stored picture of column x of row y (TIFF 6.0, tag 274).
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

// Works in strips of columns that fit the cache, since rows of the result may be columns of the
// stored picture.
template <std::size_t k_channels, class Sample>
std::vector<Sample> turned_samples(const std::vector<Sample>& from, int orientation,
                                   std::size_t width, std::size_t height) {
    const bool transposed = orientation >= 5;
    const std::size_t stored_width = transposed ? height : width,
                      stored_height = transposed ? width : height;
    std::vector<Sample> to(from.size());
    constexpr std::size_t k_strip = 32;
    for (std::size_t left = 0; left < width; left += k_strip) {
        const std::size_t right = std::min(left + k_strip, width);
        for (std::size_t y = 0; y < height; ++y) {
            Sample* next = to.data() + (y * width + left) * k_channels;
            for (std::size_t x = left; x < right; ++x, next += k_channels) {
                const Sample* pixel =
                    from.data() +
                    stored_place(orientation, x, y, stored_width, stored_height) * k_channels;
                for (std::size_t c = 0; c < k_channels; ++c) next[c] = pixel[c];
            }
        }
    }
    return to;
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
    DecodedPixels result{
        stored.width, stored.height, stored.channels, {}, std::move(stored.meaning)};
    if (orientation >= 5) {
        std::swap(result.width, result.height);
        result.meaning.pixel_aspect = 1 / result.meaning.pixel_aspect;
    }
    const auto width = static_cast<std::size_t>(result.width),
               height = static_cast<std::size_t>(result.height);
    std::visit(
        [&](const auto& from) {
            result.samples =
                stored.channels == 1   ? turned_samples<1>(from, orientation, width, height)
                : stored.channels == 3 ? turned_samples<3>(from, orientation, width, height)
                                       : turned_samples<4>(from, orientation, width, height);
        },
        stored.samples);
    return result;
}

}  // namespace culet
