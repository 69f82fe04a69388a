#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <type_traits>

#include "render/image/codecs/codecs.h"
#include "stone/errors.h"

namespace culet {

namespace {

constexpr tmsize_t k_most_tiff_memory = tmsize_t{1} << 31;  // in one piece, by the library

// A file in memory, and the first complaint of the library about it.
struct TiffInput {
    const std::string* bytes = nullptr;
    std::uint64_t at = 0;
    std::array<char, 160> complaint{};
};

tmsize_t give_tiff_bytes(thandle_t handle, void* to, tmsize_t count) {
    auto* input = static_cast<TiffInput*>(handle);
    if (count <= 0 || input->at >= input->bytes->size()) return 0;
    const std::size_t given = std::min(static_cast<std::size_t>(count),
                                       input->bytes->size() - static_cast<std::size_t>(input->at));
    std::memcpy(to, input->bytes->data() + input->at, given);
    input->at += given;
    return static_cast<tmsize_t>(given);
}

tmsize_t take_no_tiff_bytes(thandle_t, void*, tmsize_t) {
    return 0;
}

toff_t seek_tiff(thandle_t handle, toff_t offset, int from) {
    auto* input = static_cast<TiffInput*>(handle);
    const toff_t start = from == SEEK_SET   ? 0
                         : from == SEEK_CUR ? input->at
                                            : static_cast<toff_t>(input->bytes->size());
    return input->at = start + offset;
}

int close_tiff(thandle_t) {
    return 0;
}

toff_t tiff_size(thandle_t handle) {
    return static_cast<TiffInput*>(handle)->bytes->size();
}

// The file as it lies in memory, which the library only reads. Without it libtiff 4.5 refuses
// uncompressed tiles whose bytes are no multiple of 1024 (it compares them with its buffer's size).
int map_tiff(thandle_t handle, void** base, toff_t* size) {
    const auto* input = static_cast<TiffInput*>(handle);
    *base = const_cast<char*>(input->bytes->data());
    *size = input->bytes->size();
    return 1;
}

void unmap_tiff(thandle_t, void*, toff_t) {}

int keep_tiff_complaint(TIFF*, void* kept, const char*, const char* format, va_list values) {
    auto* input = static_cast<TiffInput*>(kept);
    if (input->complaint[0] == '\0')
        std::vsnprintf(input->complaint.data(), input->complaint.size(), format, values);
    return 1;
}

int ignore_tiff_warning(TIFF*, void*, const char*, const char*, va_list) {
    return 1;
}

using OpenTiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

OpenTiff opened_tiff(TiffInput& input) {
    TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
    check(options != nullptr, "libtiff starts");
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, k_most_tiff_memory);
    TIFFOpenOptionsSetErrorHandlerExtR(options, keep_tiff_complaint, &input);
    TIFFOpenOptionsSetWarningHandlerExtR(options, ignore_tiff_warning, &input);
    TIFF* tiff = TIFFClientOpenExt("TIFF", "r", &input, give_tiff_bytes, take_no_tiff_bytes,
                                   seek_tiff, close_tiff, tiff_size, map_tiff, unmap_tiff, options);
    TIFFOpenOptionsFree(options);
    return {tiff, TIFFClose};
}

InputError tiff_refusal(const TiffInput& input, const std::filesystem::path& file) {
    const std::string what = input.complaint.data();
    return {file, fmt::format("is a broken or unusual TIFF{}: save it again with another program",
                              what.empty() ? "" : " (" + what + ")")};
}

struct TiffLayout {
    std::uint32_t width = 0, height = 0;
    std::uint16_t samples = 1;  ///< a pixel
    std::uint16_t bits = 1;     ///< a sample
    std::uint16_t format = SAMPLEFORMAT_UINT;
    std::uint16_t colours = PHOTOMETRIC_RGB;
    std::uint16_t orientation = ORIENTATION_TOPLEFT;
    bool planes = false;  ///< each channel by itself
    bool tiles = false;
    std::uint32_t block_width = 0, block_height = 0;  ///< of a tile, or a strip of rows
};

TiffLayout tiff_layout(TIFF* tiff) {
    TiffLayout layout;
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &layout.width);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &layout.height);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &layout.samples);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &layout.bits);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &layout.format);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &layout.orientation);
    if (TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &layout.colours) == 0 && layout.samples < 3)
        layout.colours = PHOTOMETRIC_MINISBLACK;
    std::uint16_t planes = PLANARCONFIG_CONTIG;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &planes);
    layout.planes = planes == PLANARCONFIG_SEPARATE;
    layout.tiles = TIFFIsTiled(tiff) != 0;
    if (layout.tiles) {
        TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &layout.block_width);
        TIFFGetField(tiff, TIFFTAG_TILELENGTH, &layout.block_height);
    } else {
        layout.block_width = layout.width;
        TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &layout.block_height);
        layout.block_height = std::min(layout.block_height, layout.height);
    }
    return layout;
}

bool is_logarithmic(const TiffLayout& layout) {
    return layout.colours == PHOTOMETRIC_LOGL || layout.colours == PHOTOMETRIC_LOGLUV;
}

bool is_grey(const TiffLayout& layout) {
    return layout.colours == PHOTOMETRIC_MINISWHITE || layout.colours == PHOTOMETRIC_MINISBLACK ||
           layout.colours == PHOTOMETRIC_LOGL;
}

// Samples as they are stored, of whatever arrangement in the file; of grey with alpha, grey.
template <class Stored>
bool read_tiff_blocks(TIFF* tiff, const TiffLayout& layout, std::size_t channels,
                      std::vector<Stored>& samples) {
    const std::size_t width = layout.width, height = layout.height;
    const std::size_t in_pixel = layout.planes ? 1 : layout.samples;
    const std::size_t block_row = layout.block_width * in_pixel;
    std::vector<Stored> block(block_row * layout.block_height);
    for (std::size_t plane = 0; plane < (layout.planes ? channels : 1); ++plane) {
        for (std::size_t y = 0; y < height; y += layout.block_height) {
            for (std::size_t x = 0; x < width; x += layout.block_width) {
                const std::size_t rows = std::min<std::size_t>(layout.block_height, height - y),
                                  columns = std::min<std::size_t>(layout.block_width, width - x);
                const auto column32 = static_cast<std::uint32_t>(x),
                           row32 = static_cast<std::uint32_t>(y);
                const auto plane16 = static_cast<std::uint16_t>(plane);
                const auto room = static_cast<tmsize_t>(block.size() * sizeof(Stored));
                const tmsize_t read =
                    layout.tiles
                        ? TIFFReadEncodedTile(tiff,
                                              TIFFComputeTile(tiff, column32, row32, 0, plane16),
                                              block.data(), room)
                        : TIFFReadEncodedStrip(tiff, TIFFComputeStrip(tiff, row32, plane16),
                                               block.data(), room);
                if (read < static_cast<tmsize_t>(rows * block_row * sizeof(Stored))) return false;
                for (std::size_t r = 0; r < rows; ++r) {
                    const Stored* from = block.data() + r * block_row;
                    Stored* to = samples.data() + ((y + r) * width + x) * channels + plane;
                    for (std::size_t c = 0; c < columns; ++c, from += in_pixel, to += channels)
                        std::copy_n(from, layout.planes ? 1 : channels, to);
                }
            }
        }
    }
    return true;
}

// What the library itself makes of palettes, inks, luminance with colour differences and fewer
// bits: 8 bits of R, G, B, A, as it is stored.
bool read_tiff_colours(TIFF* tiff, const TiffLayout& layout, std::size_t channels,
                       std::vector<std::uint8_t>& samples) {
    std::vector<std::uint32_t> raster(std::size_t{layout.width} * layout.height);
    if (TIFFReadRGBAImageOriented(tiff, layout.width, layout.height, raster.data(),
                                  layout.orientation, 1) == 0) {
        return false;
    }
    auto* to = samples.data();
    for (const std::uint32_t pixel : raster) {
        const std::array<std::uint32_t, 4> rgba{TIFFGetR(pixel), TIFFGetG(pixel), TIFFGetB(pixel),
                                                TIFFGetA(pixel)};
        for (std::size_t c = 0; c < channels; ++c) *to++ = static_cast<std::uint8_t>(rgba[c]);
    }
    return true;
}

// CIE XYZ to linear sRGB (IEC 61966-2-1).
void make_rgb_of_xyz(std::vector<float>& samples) {
    for (std::size_t i = 0; i + 2 < samples.size(); i += 3) {
        const float x = samples[i], y = samples[i + 1], z = samples[i + 2];
        samples[i] = 3.240479f * x - 1.53715f * y - 0.498535f * z;
        samples[i + 1] = -0.969256f * x + 1.875991f * y + 0.041556f * z;
        samples[i + 2] = 0.055648f * x - 0.204043f * y + 1.057311f * z;
    }
}

template <class Stored, class Kept>
std::vector<Kept> tiff_samples(TIFF* tiff, const TiffInput& input, const TiffLayout& layout,
                               std::size_t channels, const std::filesystem::path& file) {
    std::vector<Stored> stored(std::size_t{layout.width} * layout.height * channels);
    bool whole = false;
    if constexpr (std::is_same_v<Stored, std::uint8_t>)
        whole = read_tiff_colours(tiff, layout, channels, stored);
    else
        whole = read_tiff_blocks(tiff, layout, channels, stored);
    if (!whole) throw tiff_refusal(input, file);
    if constexpr (std::is_same_v<Stored, Kept>) {
        return stored;
    } else {
        return {stored.begin(), stored.end()};
    }
}

// A header's tiles must not take more than its picture does.
void check_tiles(const TiffLayout& layout, const TiffInput& input,
                 const std::filesystem::path& file) {
    const double block = static_cast<double>(layout.block_width) * layout.block_height;
    const double picture = static_cast<double>(layout.width) * layout.height;
    if (block == 0 || block > 4 * picture + 1024.0 * 1024) throw tiff_refusal(input, file);
}

}  // namespace

DecodedPixels decode_tiff(const std::string& bytes, const std::filesystem::path& file) {
    TiffInput input{&bytes, 0, {}};
    const OpenTiff tiff = opened_tiff(input);
    if (tiff == nullptr) throw tiff_refusal(input, file);
    TiffLayout layout = tiff_layout(tiff.get());
    if (is_logarithmic(layout) &&
        TIFFSetField(tiff.get(), TIFFTAG_SGILOGDATAFMT, SGILOGDATAFMT_FLOAT) == 1) {
        layout = tiff_layout(tiff.get());
    }
    check_size(layout.width, layout.height, bytes.size(), "TIFF", file);
    check_tiles(layout, input, file);
    if (layout.samples < 1 || layout.samples > 4) {
        throw InputError(
            file, fmt::format("has {} channels; expected grey, RGB or RGBA", layout.samples));
    }
    const bool whole_numbers =
        layout.format == SAMPLEFORMAT_UINT || layout.format == SAMPLEFORMAT_VOID;
    const bool floats = layout.format == SAMPLEFORMAT_IEEEFP;
    const bool plain = layout.colours <= PHOTOMETRIC_RGB || is_logarithmic(layout);
    const bool small = whole_numbers && (layout.bits <= 8 || !plain);
    const bool coloured_alpha = layout.samples == 4 && layout.colours == PHOTOMETRIC_RGB;
    // Of inks, four are no alpha.
    const std::size_t channels = is_grey(layout) ? 1 : coloured_alpha ? 4 : 3;
    DecodedPixels result{static_cast<int>(layout.width),
                         static_cast<int>(layout.height),
                         static_cast<int>(channels),
                         {}};
    const auto read = [&]<class Stored, class Kept>(Stored, Kept) {
        return tiff_samples<Stored, Kept>(tiff.get(), input, layout, channels, file);
    };
    if (!small && layout.samples < channels) throw tiff_refusal(input, file);
    if (small) {
        result.samples = read(std::uint8_t{}, std::uint8_t{});
    } else if (whole_numbers && layout.bits == 16) {
        auto samples = read(std::uint16_t{}, std::uint16_t{});
        if (layout.colours == PHOTOMETRIC_MINISWHITE) {
            for (std::uint16_t& v : samples) v = static_cast<std::uint16_t>(65535 - v);
        }
        result.samples = std::move(samples);
    } else if (plain && floats && layout.bits == 32) {
        auto samples = read(float{}, float{});
        if (layout.colours == PHOTOMETRIC_LOGLUV) make_rgb_of_xyz(samples);
        result.samples = std::move(samples);
    } else if (plain && floats && layout.bits == 64) {
        result.samples = read(double{}, float{});
    } else {
        throw InputError(file,
                         "has a pixel type that is not read here; expected 8 bit, 16 bit or float");
    }
    return turned_upright(std::move(result), layout.orientation);
}

}  // namespace culet
