#pragma once
// A hand-made camera raw file: the smallest DNG (Adobe DNG 1.4) that states its colour filters,
// black and white levels, neutral colour and exposure. The camera's primaries are sRGB's.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace culet::synthetic {

struct Dng {
    int width = 64, height = 48;
    int black = 512, white = 15871;
    std::array<double, 3> neutral{0.5, 1, 0.625};  ///< camera's values for grey
    int orientation = 1;
    std::vector<std::uint16_t> samples;  ///< red at the top left, green beside it, blue diagonally
};

inline std::string dng_bytes(const Dng& dng) {
    std::string head("II*\0\x08\0\0\0", 8), extra;
    struct Entry {
        int tag, type;
        std::uint32_t count;
        std::string data;
    };
    const auto u16 = [](std::uint32_t v) {
        return std::string{static_cast<char>(v & 255), static_cast<char>(v >> 8 & 255)};
    };
    const auto u32 = [&](std::uint32_t v) { return u16(v & 0xffff) + u16(v >> 16); };
    const auto rational = [&](double v) {
        return u32(static_cast<std::uint32_t>(
                   static_cast<std::int32_t>(v * 1e6 + (v < 0 ? -0.5 : 0.5)))) +
               u32(1000000);
    };
    enum { bytes = 1, text = 2, shorts = 3, longs = 4, rationals = 5, signed_rationals = 10 };
    // XYZ to linear sRGB (IEC 61966-2-1).
    std::string matrix;
    for (const double v :
         {3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570})
        matrix += rational(v);
    std::string neutral;
    for (const double v : dng.neutral) neutral += rational(v);
    const std::uint32_t size = static_cast<std::uint32_t>(2 * dng.width * dng.height);
    const auto ifd = [&](std::vector<Entry> entries, std::uint32_t at) {
        std::string table = u16(static_cast<std::uint32_t>(entries.size())), behind;
        const std::uint32_t data_at = at + 2 + 12 * static_cast<std::uint32_t>(entries.size()) + 4;
        for (Entry& e : entries) {
            table += u16(static_cast<std::uint32_t>(e.tag)) +
                     u16(static_cast<std::uint32_t>(e.type)) + u32(e.count);
            if (e.data.size() <= 4) {
                e.data.resize(4, '\0');
                table += e.data;
            } else {
                table += u32(data_at + static_cast<std::uint32_t>(behind.size()));
                behind += e.data;
                if (behind.size() % 2 != 0) behind += '\0';
            }
        }
        return table + u32(0) + behind;
    };
    const auto exif = [&](std::uint32_t at) {
        // ShutterSpeedValue 5: 1/32 s, which cameras print as 1/30.
        return ifd({{33434, rationals, 1, u32(1) + u32(30)},
                    {33437, rationals, 1, u32(8) + u32(1)},
                    {34855, shorts, 1, u16(200)},
                    {37377, signed_rationals, 1, u32(5) + u32(1)},
                    {37386, rationals, 1, u32(100) + u32(1)},
                    {41989, shorts, 1, u16(150)}},
                   at);
    };
    const auto whole = [&](std::uint32_t exif_at, std::uint32_t pixels_at) {
        return ifd({{254, longs, 1, u32(0)},
                    {256, longs, 1, u32(static_cast<std::uint32_t>(dng.width))},
                    {257, longs, 1, u32(static_cast<std::uint32_t>(dng.height))},
                    {258, shorts, 1, u16(16)},
                    {259, shorts, 1, u16(1)},
                    {262, shorts, 1, u16(32803)},
                    {271, text, 6, std::string("culet\0", 6)},
                    {272, text, 5, std::string("test\0", 5)},
                    {273, longs, 1, u32(pixels_at)},
                    {274, shorts, 1, u16(static_cast<std::uint32_t>(dng.orientation))},
                    {277, shorts, 1, u16(1)},
                    {278, longs, 1, u32(static_cast<std::uint32_t>(dng.height))},
                    {279, longs, 1, u32(size)},
                    {33421, shorts, 2, u16(2) + u16(2)},
                    {33422, bytes, 4, std::string("\0\1\1\2", 4)},
                    {34665, longs, 1, u32(exif_at)},
                    {50706, bytes, 4, std::string("\1\4\0\0", 4)},
                    {50708, text, 11, std::string("culet test\0", 11)},
                    {50714, shorts, 1, u16(static_cast<std::uint32_t>(dng.black))},
                    {50717, longs, 1, u32(static_cast<std::uint32_t>(dng.white))},
                    {50721, signed_rationals, 9, matrix},
                    {50728, rationals, 3, neutral},
                    {50778, shorts, 1, u16(21)}},
                   8);
    };
    const auto exif_at = static_cast<std::uint32_t>(8 + whole(0, 0).size());
    const auto pixels_at = exif_at + static_cast<std::uint32_t>(exif(exif_at).size());
    std::string file = head + whole(exif_at, pixels_at) + exif(exif_at);
    for (const std::uint16_t v : dng.samples) file += u16(v);
    return file;
}

/// Sensor samples of a grey of `level` (1: green clips) at each pixel.
template <class Level>
Dng grey_dng(Dng dng, Level level) {
    for (int y = 0; y < dng.height; ++y) {
        for (int x = 0; x < dng.width; ++x) {
            const std::size_t filter = static_cast<std::size_t>(x % 2 + y % 2);
            const double v =
                dng.black + (dng.white - dng.black) * dng.neutral[filter] * level(x, y);
            dng.samples.push_back(static_cast<std::uint16_t>(std::min<double>(v + 0.5, dng.white)));
        }
    }
    return dng;
}

}  // namespace culet::synthetic
