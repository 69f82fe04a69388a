#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "render/image/codecs/codecs.h"
#include "stone/errors.h"

// Radiance pictures: G. Ward, Real Pixels, in Graphics Gems II (1991), and the format's reference,
// `filefmts` of Radiance. A pixel is three mantissas of 8 bits and one exponent, R, G, B, E.

namespace culet {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

// Rows of these widths may be packed: the mark of a packed row holds its width in 15 bits.
bool may_be_packed(std::size_t width) {
    return width >= 8 && width <= 0x7fff;
}

class HdrBytes {
public:
    HdrBytes(std::string_view bytes, const std::filesystem::path& file)
        : bytes_(bytes), file_(file) {}

    std::string_view take(std::size_t count) {
        if (count > bytes_.size()) throw InputError(file_, "is an HDR that is cut off");
        const std::string_view taken = bytes_.substr(0, count);
        bytes_.remove_prefix(count);
        return taken;
    }
    std::string_view line() {
        const std::string_view taken = take(std::min(bytes_.find('\n'), bytes_.size()));
        take(1);
        return taken;
    }
    std::uint8_t byte() { return static_cast<std::uint8_t>(take(1)[0]); }
    Rgbe pixel() {
        const std::string_view four = take(4);
        Rgbe result;
        std::copy(four.begin(), four.end(), result.begin());
        return result;
    }

    // The four parts of a row one after the other, each in runs: over 128, so many times less 128
    // the next byte; else so many bytes.
    void unpack_row(std::vector<Rgbe>& row) {
        for (std::size_t part = 0; part < 4; ++part) {
            for (std::size_t x = 0; x < row.size();) {
                const std::size_t count = byte();
                const bool same = count > 128;
                const std::size_t length = same ? count - 128 : count;
                if (length == 0 || length > row.size() - x)
                    throw InputError(file_, "is an HDR with a damaged row");
                const std::string_view values = take(same ? 1 : length);
                for (std::size_t i = 0; i < length; ++i)
                    row[x + i][part] = static_cast<std::uint8_t>(values[same ? 0 : i]);
                x += length;
            }
        }
    }

private:
    std::string_view bytes_;
    const std::filesystem::path& file_;
};

// Colours from 0 to 1 come back as they were, unlike in Ward's own programs, which add a half to
// each mantissa.
void add_pixel(const Rgbe& from, std::vector<float>& to) {
    const float unit = from[3] == 0 ? 0 : std::ldexp(1.0f, from[3] - (128 + 8));
    for (std::size_t c = 0; c < 3; ++c) to.push_back(static_cast<float>(from[c]) * unit);
}

Rgbe rgbe_of(const float* rgb) {
    const float most = std::max({rgb[0], rgb[1], rgb[2]});
    if (most < 1e-32f) return {};
    int exponent = 0;
    const auto scale = static_cast<float>(std::frexp(most, &exponent) * 256.0 / most);
    return {static_cast<std::uint8_t>(rgb[0] * scale), static_cast<std::uint8_t>(rgb[1] * scale),
            static_cast<std::uint8_t>(rgb[2] * scale), static_cast<std::uint8_t>(exponent + 128)};
}

std::size_t run_length(const std::vector<std::uint8_t>& values, std::size_t at) {
    std::size_t end = at + 1;
    while (end < values.size() && end - at < 127 && values[end] == values[at]) ++end;
    return end - at;
}

void pack_values(const std::vector<std::uint8_t>& values, std::string& bytes) {
    constexpr std::size_t k_worth_a_run = 4;
    for (std::size_t x = 0; x < values.size();) {
        std::size_t end = x, run = 0;
        while (end < values.size() && end - x < 128) {
            run = run_length(values, end);
            if (run >= k_worth_a_run) break;
            ++end;
        }
        if (end > x) {
            bytes += static_cast<char>(end - x);
            bytes.append(values.begin() + static_cast<std::ptrdiff_t>(x),
                         values.begin() + static_cast<std::ptrdiff_t>(end));
            x = end;
        } else {
            bytes += static_cast<char>(128 + run);
            bytes += static_cast<char>(values[x]);
            x += run;
        }
    }
}

}  // namespace

DecodedPixels decode_hdr(const std::string& bytes, const std::filesystem::path& file) {
    HdrBytes input(bytes, file);
    bool format = false;
    for (std::string_view line = input.line(); !line.empty(); line = input.line())
        format = format || line == "FORMAT=32-bit_rle_rgbe";
    const std::string size(input.line().substr(0, 128));
    unsigned long rows = 0, columns = 0;
    if (!format || std::sscanf(size.c_str(), "-Y %lu +X %lu", &rows, &columns) != 2) {
        throw InputError(file,
                         "is an unusual HDR (expected RGBE in rows from the top): save it again "
                         "with another program");
    }
    check_size(columns, rows, bytes.size(), "HDR", file);
    std::vector<float> samples;
    samples.reserve(3 * rows * columns);
    std::vector<Rgbe> row(columns);
    for (bool packed = may_be_packed(columns); samples.size() < 3 * rows * columns;) {
        const Rgbe first = input.pixel();
        // The first row tells how all are stored.
        packed = packed && first[0] == 2 && first[1] == 2 && first[2] < 128;
        if (!packed) {
            add_pixel(first, samples);
        } else if (first[2] * 256u + first[3] != columns) {
            throw InputError(file, "is an HDR with a damaged row");
        } else {
            input.unpack_row(row);
            for (const Rgbe& pixel : row) add_pixel(pixel, samples);
        }
    }
    return {static_cast<int>(columns), static_cast<int>(rows), 3, std::move(samples)};
}

std::string encode_hdr(int width, int height, std::span<const float> rgb) {
    const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
    check(width > 0 && height > 0 && rgb.size() == 3 * columns * rows,
          "a picture to be packed as HDR has all its samples");
    std::string bytes =
        fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", height, width);
    std::array<std::vector<std::uint8_t>, 4> parts;
    for (std::size_t y = 0; y < rows; ++y) {
        for (auto& part : parts) part.clear();
        for (std::size_t x = 0; x < columns; ++x) {
            const Rgbe pixel = rgbe_of(rgb.data() + 3 * (y * columns + x));
            for (std::size_t p = 0; p < 4; ++p) parts[p].push_back(pixel[p]);
            if (!may_be_packed(columns)) bytes.append(pixel.begin(), pixel.end());
        }
        if (!may_be_packed(columns)) continue;
        bytes += {2, 2, static_cast<char>(width >> 8), static_cast<char>(width & 0xff)};
        for (const auto& part : parts) pack_values(part, bytes);
    }
    return bytes;
}

}  // namespace culet
