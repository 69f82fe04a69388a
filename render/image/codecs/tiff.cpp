#include <fmt/format.h>
#include <half.h>
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <type_traits>

#include "render/image/codecs/codecs.h"
#include "render/image/codecs/tiff_memory.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

struct TiffLayout {
    std::uint32_t width = 0, height = 0;
    std::uint16_t samples = 1;  ///< per pixel
    std::uint16_t bits = 1;     ///< per sample
    std::uint16_t format = SAMPLEFORMAT_UINT;
    std::uint16_t colours = PHOTOMETRIC_RGB;
    std::uint16_t orientation = ORIENTATION_TOPLEFT;
    std::optional<std::uint16_t> further;  ///< kind of the last sample (EXTRASAMPLE_...)
    bool planes = false;                   ///< channels are stored separately
    bool tiles = false;
    std::uint32_t block_width = 0, block_height = 0;  ///< of a tile, or of a strip of rows
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
    std::uint16_t further = 0, *kinds = nullptr;
    if (TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &further, &kinds) == 1 && further > 0)
        layout.further = kinds[further - 1];
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

// Reads samples as stored, in any arrangement of the file; of grey with alpha, only the grey.
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

// Lets libtiff convert palettes, luminance with colour differences, and fewer bits to R, G, B of 8
// bits.
bool read_tiff_colours(TIFF* tiff, const TiffLayout& layout, std::size_t channels,
                       std::vector<std::uint8_t>& samples) {
    std::vector<std::uint32_t> raster(std::size_t{layout.width} * layout.height);
    if (TIFFReadRGBAImageOriented(tiff, layout.width, layout.height, raster.data(),
                                  layout.orientation, 1) == 0) {
        return false;
    }
    auto* to = samples.data();
    for (const std::uint32_t pixel : raster) {
        const std::array<std::uint32_t, 3> rgb{TIFFGetR(pixel), TIFFGetG(pixel), TIFFGetB(pixel)};
        for (std::size_t c = 0; c < channels; ++c) *to++ = static_cast<std::uint8_t>(rgb[c]);
    }
    return true;
}

// Expands grey with alpha to four channels.
template <class Sample>
std::vector<Sample> with_grey_thrice(const std::vector<Sample>& pairs) {
    std::vector<Sample> samples;
    samples.reserve(2 * pairs.size());
    for (std::size_t i = 0; i + 1 < pairs.size(); i += 2)
        samples.insert(samples.end(), {pairs[i], pairs[i], pairs[i], pairs[i + 1]});
    return samples;
}

template <class Stored, class Kept>
void take_tiff_samples(TIFF* tiff, const TiffInput& input, const TiffLayout& layout,
                       bool by_library, const std::filesystem::path& file, DecodedPixels& result) {
    const auto channels = static_cast<std::size_t>(result.channels);
    std::vector<Stored> stored(std::size_t{layout.width} * layout.height * channels);
    bool whole = false;
    if constexpr (std::is_same_v<Stored, std::uint8_t>) {
        whole = by_library ? read_tiff_colours(tiff, layout, channels, stored)
                           : read_tiff_blocks(tiff, layout, channels, stored);
    } else {
        whole = read_tiff_blocks(tiff, layout, channels, stored);
    }
    if (!whole) throw tiff_refusal(input, file);
    if constexpr (std::is_integral_v<Stored>) {
        if (layout.colours == PHOTOMETRIC_MINISWHITE && !by_library) {
            for (std::size_t i = 0; i < stored.size(); i += channels)
                stored[i] = static_cast<Stored>(std::numeric_limits<Stored>::max() - stored[i]);
        }
    }
    std::vector<Kept> kept;
    if constexpr (std::is_same_v<Stored, Kept>)
        kept = std::move(stored);
    else
        kept.assign(stored.begin(), stored.end());
    if (channels == 2) {
        kept = with_grey_thrice(kept);
        result.channels = 4;
        result.meaning.grey = true;
    }
    result.samples = std::move(kept);
}

// Reads the tags 34675 (ICC), 318 and 319 (white and primaries), 301 (transfer function), 282 and
// 283 (pixels per length); TIFF 6.0.
SampleMeaning meaning_of_tiff(TIFF* tiff, const TiffLayout& layout, std::size_t channels) {
    SampleMeaning meaning;
    std::uint32_t bytes = 0;
    void* profile = nullptr;
    float* white = nullptr;
    float* primaries = nullptr;
    if (TIFFGetField(tiff, TIFFTAG_ICCPROFILE, &bytes, &profile) == 1)
        meaning.profile.assign(static_cast<const char*>(profile), bytes);
    if (layout.colours == PHOTOMETRIC_LOGLUV) {
        meaning.primaries = k_xyz_primaries;
    } else if (TIFFGetField(tiff, TIFFTAG_PRIMARYCHROMATICITIES, &primaries) == 1) {
        for (std::size_t i = 0; i < 6; ++i)
            meaning.primaries[i / 2][i % 2] = static_cast<double>(primaries[i]);
        if (TIFFGetField(tiff, TIFFTAG_WHITEPOINT, &white) == 1)
            meaning.primaries[3] = {static_cast<double>(white[0]), static_cast<double>(white[1])};
    }
    std::uint16_t* curve = nullptr;
    if (meaning.profile.empty() &&
        TIFFGetField(tiff, TIFFTAG_TRANSFERFUNCTION, &curve, &curve, &curve) == 1) {
        meaning.not_photometric = "its TransferFunction tag is not followed";
    }
    float across = 0, down = 0;
    if (TIFFGetField(tiff, TIFFTAG_XRESOLUTION, &across) == 1 &&
        TIFFGetField(tiff, TIFFTAG_YRESOLUTION, &down) == 1 && across > 0)
        meaning.pixel_aspect = static_cast<double>(down) / static_cast<double>(across);
    meaning.inks = layout.colours == PHOTOMETRIC_SEPARATED;
    if (!meaning.inks && (channels == 2 || channels == 4)) {
        meaning.multiplied = layout.further == EXTRASAMPLE_ASSOCALPHA;
        if (layout.further.value_or(EXTRASAMPLE_UNSPECIFIED) == EXTRASAMPLE_UNSPECIFIED)
            meaning.notes.emplace_back(
                "it does not say what its last channel is: it is taken as alpha");
    }
    if (TIFFLastDirectory(tiff) == 0)
        meaning.notes.emplace_back("it holds several pictures: the first is read");
    return meaning;
}

// Refuses tiles that take more memory than the picture.
void check_tiles(const TiffLayout& layout, const TiffInput& input,
                 const std::filesystem::path& file) {
    const double block = static_cast<double>(layout.block_width) * layout.block_height;
    const double picture = static_cast<double>(layout.width) * layout.height;
    if (block == 0 || block > 4 * picture + 1024.0 * 1024) throw tiff_refusal(input, file);
}

// Channels to read: grey 1, or 2 with alpha; colours 3, or 4 with alpha; inks 4.
std::size_t tiff_channels(const TiffLayout& layout, const std::filesystem::path& file) {
    const bool inks = layout.colours == PHOTOMETRIC_SEPARATED;
    const std::size_t least = is_grey(layout) || layout.colours == PHOTOMETRIC_PALETTE ? 1
                              : inks                                                   ? 4
                                                                                       : 3;
    const std::size_t most = inks ? 4 : least + 1;
    if (layout.samples < least || layout.samples > most) {
        throw InputError(file, fmt::format("has {} channels; expected grey, RGB or CMYK, of the "
                                           "first two with or without alpha",
                                           layout.samples));
    }
    return layout.colours == PHOTOMETRIC_PALETTE ? 3 : layout.samples;
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
    const std::size_t channels = tiff_channels(layout, file);
    const bool whole_numbers =
        layout.format == SAMPLEFORMAT_UINT || layout.format == SAMPLEFORMAT_VOID;
    const bool floats = layout.format == SAMPLEFORMAT_IEEEFP;
    const bool inks = layout.colours == PHOTOMETRIC_SEPARATED;
    const bool plain = layout.colours <= PHOTOMETRIC_RGB || inks || is_logarithmic(layout);
    const bool by_library = whole_numbers && (!plain || layout.bits < 8);
    DecodedPixels result{
        static_cast<int>(layout.width),
        static_cast<int>(layout.height),
        static_cast<int>(by_library && channels % 2 == 0 ? channels - 1 : channels),
        {},
        meaning_of_tiff(tiff.get(), layout, channels)};
    const auto take = [&]<class Stored, class Kept>(Stored, Kept) {
        take_tiff_samples<Stored, Kept>(tiff.get(), input, layout, by_library, file, result);
    };
    const bool inverted = floats && layout.colours == PHOTOMETRIC_MINISWHITE;
    if (by_library || (whole_numbers && layout.bits == 8)) {
        take(std::uint8_t{}, std::uint8_t{});
    } else if (whole_numbers && layout.bits == 16) {
        take(std::uint16_t{}, std::uint16_t{});
    } else if (plain && floats && !inverted && layout.bits == 16) {
        take(Imath::half{}, float{});
    } else if (plain && floats && !inverted && layout.bits == 32) {
        take(float{}, float{});
    } else if (plain && floats && !inverted && layout.bits == 64) {
        take(double{}, float{});
    } else {
        throw InputError(
            file, fmt::format("has samples of {} bits, {}{}, which are not read here: save it with "
                              "8 or 16 bits, or as floats",
                              layout.bits,
                              floats                              ? "floats"
                              : layout.format == SAMPLEFORMAT_INT ? "whole numbers with a sign"
                              : whole_numbers                     ? "whole numbers"
                                                                  : "of no real numbers",
                              inverted ? " where 0 is white" : ""));
    }
    return turned_upright(std::move(result), layout.orientation);
}

}  // namespace culet
