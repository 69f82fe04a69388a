#include "render/image/shown_bytes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace culet {

namespace {

std::uint32_t bits_of(float number) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    return bits;
}
float number_of(std::uint32_t bits) {
    float number = 0;
    std::memcpy(&number, &bits, sizeof number);
    return number;
}

std::uint8_t encoded(float shown) {
    return static_cast<std::uint8_t>(std::lround(255 * srgb_encoded(static_cast<double>(shown))));
}

// The byte of a positive number, monotonic for every tone map: a table by the upper half of the
// number's bits, and the numbers where bytes begin. A power per value would cost more than the
// picture.
class ByteTable {
public:
    explicit ByteTable(ToneMap map) {
        std::uint32_t bits = 0;
        begin_[0] = 0;
        for (int byte = 1; byte < 256; ++byte) {
            std::uint32_t low = bits, high = k_infinity;  // first number with this byte or more
            while (low < high) {
                const std::uint32_t middle = low + (high - low) / 2;
                if (byte_of(number_of(middle), map) >= byte) {
                    high = middle;
                } else {
                    low = middle + 1;
                }
            }
            begin_[static_cast<std::size_t>(byte)] = bits = low;
        }
        int byte = 0;
        for (std::uint32_t bucket = 0; bucket < first_.size(); ++bucket) {
            while (byte < 255 && begin_[static_cast<std::size_t>(byte) + 1] <= bucket << k_shift)
                ++byte;
            first_[bucket] = static_cast<std::uint8_t>(byte);
        }
    }

    /// For finite light >= 0.
    std::uint8_t operator()(float lit) const {
        const auto bits = bits_of(lit);
        std::size_t byte = first_[bits >> k_shift];
        while (byte < 255 && begin_[byte + 1] <= bits) ++byte;
        return static_cast<std::uint8_t>(byte);
    }

private:
    static constexpr std::uint32_t k_infinity = 0x7f800000, k_shift = 16;

    static int byte_of(float lit, ToneMap map) { return encoded(tone_mapped(lit, map)); }

    std::array<std::uint32_t, 256> begin_{};
    std::array<std::uint8_t, (k_infinity >> k_shift) + 1> first_{};
};

const ByteTable& table_of(ToneMap map) {
    static const std::array<ByteTable, 4> tables{
        ByteTable(ToneMap::none), ByteTable(ToneMap::reinhard), ByteTable(ToneMap::filmic),
        ByteTable(ToneMap::gamma2)};
    return tables[static_cast<std::size_t>(map)];
}

}  // namespace

std::vector<std::uint8_t> shown_bytes(const Picture& picture, const PngLook& look,
                                      bool with_alpha) {
    const std::size_t channels = with_alpha ? 4 : 3, pixels = picture.pixels();
    std::vector<std::uint8_t> bytes(channels * pixels);
    const auto fill = [&](const auto& byte_at) {
        for (std::size_t i = 0; i < pixels; ++i) {
            for (std::size_t c = 0; c < 3; ++c) bytes[channels * i + c] = byte_at(3 * i + c);
        }
    };
    if (!is_pointwise(look)) {
        const std::vector<float> shown = as_shown(picture, look);
        fill([&](std::size_t i) { return encoded(shown[i]); });
    } else {
        const ByteTable& table = table_of(look.tone_map);
        fill([&](std::size_t i) { return table(exposed(picture.rgb[i], look.exposure)); });
    }
    if (!with_alpha) return bytes;
    const bool covered = look.alpha && !picture.coverage.empty();
    for (std::size_t i = 0; i < pixels; ++i) {
        const double share =
            covered ? std::clamp(static_cast<double>(picture.coverage[i]), 0.0, 1.0) : 1.0;
        bytes[4 * i + 3] = static_cast<std::uint8_t>(std::lround(255 * share));
    }
    return bytes;
}

}  // namespace culet
