#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>

#include "render/image/codecs/codecs.h"
#include "stone/text/errors.h"
#include "stone/text/text_scan.h"

// Radiance pictures: G. Ward, Real Pixels, in Graphics Gems II (1991), and the format's reference,
// `filefmts` of Radiance. A pixel has three 8-bit mantissas and one exponent: R, G, B, E.

namespace culet {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

// Rows of these widths may be packed, since a packed row's mark holds the width in 15 bits.
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

    // Reads a row: packed by parts, or pixels with the older run-length code.
    void row(std::vector<Rgbe>& row) {
        const bool packed = may_be_packed(row.size()) && bytes_.size() >= 4 && bytes_[0] == 2 &&
                            bytes_[1] == 2 && (bytes_[2] & 0x80) == 0;
        if (!packed) return unpack_old_row(row);
        const Rgbe mark = pixel();
        if (mark[2] * 256u + mark[3] != row.size())
            throw InputError(file_, "is an HDR with a damaged row");
        unpack_row(row);
    }

private:
    // The row's four parts follow each other in runs. A count over 128 repeats the next byte (count
    // - 128) times; a smaller one precedes that many literal bytes.
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

    // 1, 1, 1, n repeats the previous pixel n times; each directly following mark counts 256 times
    // as much as the last.
    void unpack_old_row(std::vector<Rgbe>& row) {
        unsigned shift = 0;
        for (std::size_t x = 0; x < row.size();) {
            const Rgbe next = pixel();
            if (next[0] != 1 || next[1] != 1 || next[2] != 1) {
                row[x++] = next;
                shift = 0;
                continue;
            }
            const std::size_t length = shift < 32 ? std::size_t{next[3]} << shift : 0;
            if (x == 0 || length > row.size() - x)
                throw InputError(file_, "is an HDR with a damaged row");
            std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), length, row[x - 1]);
            x += length;
            shift += 8;
        }
    }

    std::string_view bytes_;
    const std::filesystem::path& file_;
};

// Colours from 0 to 1 are read back exactly; Ward's own programs add a half to each mantissa.
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

struct HdrHeader {
    SampleMeaning meaning;
    std::size_t line = 0, lines = 0;  ///< pixels per stored row, and rows
    int orientation = 1;              ///< numbered as in EXIF
};

// Returns the numbers after a line's name; at least `count`.
std::vector<double> numbers_in(std::string_view text, std::size_t count, std::size_t line,
                               const std::filesystem::path& file) {
    std::vector<double> numbers;
    for (const std::string_view word : words_of(text.substr(text.find('=') + 1))) {
        const std::optional<double> number = number_in(word);
        if (!number) break;
        numbers.push_back(*number);
    }
    if (numbers.size() < count)
        throw InputError(file, fmt::format("line {} of its header lacks numbers", line));
    return numbers;
}

// EXPOSURE, COLORCORR and PIXASPECT occur once per program that changed the picture, and all
// multiply (filefmts). Lines that begin with a blank describe source pictures.
void read_hdr_line(std::string_view line, std::size_t number, HdrHeader& header, bool& format,
                   const std::filesystem::path& file) {
    const auto numbers = [&](std::size_t count) { return numbers_in(line, count, number, file); };
    const auto positive = [&](std::size_t count) {
        std::vector<double> values = numbers(count);
        for (const double v : values) {
            if (!std::isfinite(v) || !(v > 0))
                throw InputError(
                    file, fmt::format("line {} of its header: {} is not positive", number, v));
        }
        return values;
    };
    SampleMeaning& meaning = header.meaning;
    if (line.starts_with("FORMAT=")) {
        format = true;
        if (line == "FORMAT=32-bit_rle_xyze") {
            meaning.primaries = k_xyz_primaries;
        } else if (line != "FORMAT=32-bit_rle_rgbe") {
            throw InputError(file, fmt::format("is an unusual HDR: line {} of its header names a "
                                               "format that is neither 32-bit_rle_rgbe nor "
                                               "32-bit_rle_xyze: save it again with another "
                                               "program",
                                               number));
        }
    } else if (line.starts_with("EXPOSURE=")) {
        const double exposure = positive(1)[0];
        for (float& factor : meaning.factor) factor = float(double(factor) / exposure);
    } else if (line.starts_with("COLORCORR=")) {
        const std::vector<double> by = positive(3);
        for (std::size_t c = 0; c < 3; ++c)
            meaning.factor[c] = float(double(meaning.factor[c]) / by[c]);
    } else if (line.starts_with("PIXASPECT=")) {
        meaning.pixel_aspect /= positive(1)[0];  // Radiance uses height over width
    } else if (line.starts_with("GAMMA=")) {
        meaning.exponent = positive(1)[0];
    } else if (line.starts_with("PRIMARIES=")) {
        const std::vector<double> xy = numbers(8);
        // Photoshop writes zeros for unknown primaries.
        if (std::all_of(xy.begin(), xy.end(), [](double v) { return v == 0; })) return;
        if (meaning.primaries == k_xyz_primaries) return;
        for (std::size_t i = 0; i < 8; ++i) meaning.primaries[i / 2][i % 2] = xy[i];
    }
}

// `-Y rows +X columns`: two signed axes, the slower one first; +Y is up. The eight orders are those
// of EXIF's orientations.
void read_hdr_size(std::string_view line, HdrHeader& header, const std::filesystem::path& file) {
    const std::string text(line.substr(0, 128));
    std::array<char, 4> order{};
    unsigned long lines = 0, length = 0;
    constexpr std::array<std::string_view, 8> k_orders{"-Y+X", "-Y-X", "+Y-X", "+Y+X",
                                                       "+X-Y", "-X-Y", "-X+Y", "+X+Y"};
    const int found = std::sscanf(text.c_str(), "%c%c %lu %c%c %lu", &order[0], &order[1], &lines,
                                  &order[2], &order[3], &length);
    const auto known =
        std::find(k_orders.begin(), k_orders.end(), std::string_view(order.data(), order.size()));
    if (found != 6 || known == k_orders.end()) {
        throw InputError(file,
                         "is an unusual HDR: behind its header stands no size such as -Y 512 +X "
                         "1024: save it again with another program");
    }
    header.orientation = static_cast<int>(known - k_orders.begin()) + 1;
    header.lines = lines;
    header.line = length;
}

HdrHeader read_hdr_header(HdrBytes& input, const std::filesystem::path& file) {
    HdrHeader header;
    bool format = false;
    std::size_t number = 0;
    for (;;) {
        std::string_view line = input.line();
        if (line.ends_with('\r')) line.remove_suffix(1);
        ++number;
        if (line.empty()) break;
        read_hdr_line(line, number, header, format, file);
    }
    read_hdr_size(input.line(), header, file);
    if (!format) header.meaning.notes.push_back("it names no FORMAT and is taken as RGBE");
    return header;
}

}  // namespace

DecodedPixels decode_hdr(const std::string& bytes, const std::filesystem::path& file) {
    HdrBytes input(bytes, file);
    HdrHeader header = read_hdr_header(input, file);
    const bool by_columns = header.orientation >= 5;
    check_size(header.line, header.lines, bytes.size(), "HDR", file);
    std::vector<float> samples;
    samples.reserve(3 * header.lines * header.line);
    std::vector<Rgbe> row(header.line);
    for (std::size_t y = 0; y < header.lines; ++y) {
        input.row(row);
        for (const Rgbe& pixel : row) add_pixel(pixel, samples);
    }
    if (by_columns) header.meaning.pixel_aspect = 1 / header.meaning.pixel_aspect;
    return turned_upright({static_cast<int>(header.line), static_cast<int>(header.lines), 3,
                           std::move(samples), std::move(header.meaning)},
                          header.orientation);
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
