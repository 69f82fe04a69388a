// PNG, TIFF and JPEG files of other programs. Expectations: the formats' specifications, closed
// forms of transfer curves, published matrices.

#include <fmt/format.h>
#include <half.h>
#include <lcms2.h>
#include <png.h>
#include <tiffio.h>
#include <zlib.h>
// jpeglib.h needs this include before it.
#include <cstdio>
// Must follow <cstdio>.
#include <jpeglib.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

#include "render/colour/colour.h"
#include "tests/render/foreign_picture.h"

namespace {

using namespace culet;
using culet::test::Colour;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Xy = std::array<double, 2>;

// An ICC profile with primaries and a curve, white D65.
std::string icc_profile(const Xy& red, const Xy& green, const Xy& blue, cmsToneCurve* curve) {
    const cmsCIExyY white{0.3127, 0.3290, 1};
    const cmsCIExyYTRIPLE primaries{
        {red[0], red[1], 1}, {green[0], green[1], 1}, {blue[0], blue[1], 1}};
    cmsToneCurve* curves[3]{curve, curve, curve};
    cmsHPROFILE profile = cmsCreateRGBProfile(&white, &primaries, curves);
    cmsUInt32Number size = 0;
    cmsSaveProfileToMem(profile, nullptr, &size);
    std::string bytes(size, '\0');
    cmsSaveProfileToMem(profile, bytes.data(), &size);
    cmsCloseProfile(profile);
    cmsFreeToneCurve(curve);
    return bytes;
}

std::string adobe_rgb_profile() {
    return icc_profile({0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06},
                       cmsBuildGamma(nullptr, 2.19921875));
}
std::string linear_profile() {
    return icc_profile({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, cmsBuildGamma(nullptr, 1));
}
std::string srgb_profile() {
    const double curve[]{2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
    return icc_profile({0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06},
                       cmsBuildParametricToneCurve(nullptr, 4, curve));
}

Colour powers(const Colour& v, double exponent) {
    return {std::pow(v[0], exponent), std::pow(v[1], exponent), std::pow(v[2], exponent)};
}

class ForeignPng : public test::ForeignPicture {
protected:
    using Adapt = std::function<void(png_structp, png_infop)>;

    // One row of samples of 8 or 16 bits (most significant byte first).
    static std::string png(int width, int bits, int colour, const std::string& row,
                           const Adapt& adapt = {}) {
        std::string bytes;
        png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
        png_infop info = png_create_info_struct(png);
        png_set_write_fn(
            png, &bytes,
            [](png_structp to, png_bytep data, png_size_t size) {
                static_cast<std::string*>(png_get_io_ptr(to))
                    ->append(reinterpret_cast<const char*>(data), size);
            },
            nullptr);
        png_set_IHDR(png, info, static_cast<png_uint_32>(width), 1, bits, colour,
                     PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        if (adapt) adapt(png, info);
        png_write_info(png, info);
        png_write_row(png, reinterpret_cast<png_const_bytep>(row.data()));
        png_write_end(png, info);
        png_destroy_write_struct(&png, &info);
        return bytes;
    }
    static std::string rgb(const Adapt& adapt) {
        return png(1, 8, PNG_COLOR_TYPE_RGB, std::string("\x33\x80\xcc"), adapt);
    }
    // A chunk after the header, with its checksum (PNG, 5.3).
    static std::string with_chunk(std::string bytes, const std::string& name_and_data) {
        const auto number = [](std::uint32_t v) {
            return std::string{char(v >> 24), char(v >> 16), char(v >> 8), char(v)};
        };
        const auto sum = crc32(0, reinterpret_cast<const Bytef*>(name_and_data.data()),
                               static_cast<uInt>(name_and_data.size()));
        return bytes.insert(33, number(static_cast<std::uint32_t>(name_and_data.size() - 4)) +
                                    name_and_data + number(static_cast<std::uint32_t>(sum)));
    }
    static constexpr Colour k_values{0x33 / 255.0, 0x80 / 255.0, 0xcc / 255.0};
    static Colour decoded() {
        return {srgb_decoded(k_values[0]), srgb_decoded(k_values[1]), srgb_decoded(k_values[2])};
    }
};

TEST_F(ForeignPng, GammaAndChromaticitiesAreFollowed) {
    for (const double exponent : {1.0, 2.0, 1.8}) {
        const auto gamma = [&](png_structp png, png_infop info) {
            png_set_gAMA(png, info, 1 / exponent);
        };
        expect_near(pixel(read(rgb(gamma)), 0, 0), powers(k_values, exponent), 1e-4);
    }
    // A lone gamma of 1/2.2 is how programs mark sRGB.
    const auto usual = [](png_structp png, png_infop info) { png_set_gAMA(png, info, 0.45455); };
    expect_near(pixel(read(rgb(usual)), 0, 0), decoded(), 1e-6);
    const auto adobe = [](png_structp png, png_infop info) {
        png_set_gAMA(png, info, 1.0);
        png_set_cHRM(png, info, 0.3127, 0.3290, 0.64, 0.33, 0.21, 0.71, 0.15, 0.06);
    };
    expect_near(pixel(read(rgb(adobe)), 0, 0), test::srgb_of_adobe_rgb(k_values), 1e-3);
}

TEST_F(ForeignPng, ProfilesAreFollowed) {
    const auto with = [](const std::string& profile) {
        return rgb([&](png_structp png, png_infop info) {
            png_set_iCCP(png, info, "p", 0, reinterpret_cast<png_const_bytep>(profile.data()),
                         static_cast<png_uint_32>(profile.size()));
        });
    };
    expect_near(pixel(read(with(linear_profile())), 0, 0), k_values, 1e-3);
    expect_near(pixel(read(with(adobe_rgb_profile())), 0, 0),
                test::srgb_of_adobe_rgb(powers(k_values, 2.19921875)), 1e-3);
    // sRGB's own profile is decoded by its standard, to the last bit.
    const ReadPicture srgb = read(with(srgb_profile()));
    EXPECT_EQ(srgb.picture.rgb, read(rgb({})).picture.rgb);
    EXPECT_EQ(srgb.encoding, "8-bit sRGB");
}

TEST_F(ForeignPng, CodingIndependentCodePoints) {
    // ITU-T H.273: primaries 1 (Rec. 709) and transfer 8 (linear); 9 and 16 are Rec. 2100 PQ.
    expect_near(pixel(read(with_chunk(rgb({}), std::string("cICP\1\10\0\1", 8))), 0, 0), k_values,
                1e-6);
    EXPECT_THAT(refusal(with_chunk(rgb({}), std::string("cICP\11\20\0\1", 8))), HasSubstr("PQ"));
}

TEST_F(ForeignPng, PalettesBitsTransparencyAndOrientation) {
    const ReadPicture bits = read(png(3, 1, PNG_COLOR_TYPE_GRAY, "\x40"));
    expect_near(pixel(bits, 0, 0), {0, 0, 0}, 0);
    expect_near(pixel(bits, 1, 0), {1, 1, 1}, 0);

    const auto palette = [](png_structp png, png_infop info) {
        const png_color colours[]{{255, 0, 0}, {0, 0, 255}};
        const png_byte alpha[]{51};
        png_set_PLTE(png, info, colours, 2);
        png_set_tRNS(png, info, alpha, 1, nullptr);
    };
    const ReadPicture indexed = read(png(2, 1, PNG_COLOR_TYPE_PALETTE, "\x40", palette));
    expect_near(pixel(indexed, 0, 0), {1, 0, 0}, 0);
    expect_near(pixel(indexed, 1, 0), {0, 0, 1}, 0);
    EXPECT_EQ(indexed.picture.coverage, (std::vector<float>{0.2f, 1}));

    const auto one_is_clear = [](png_structp png, png_infop info) {
        png_color_16 clear{};
        clear.gray = 7;
        png_set_tRNS(png, info, nullptr, 0, &clear);
    };
    EXPECT_EQ(read(png(2, 8, PNG_COLOR_TYPE_GRAY, "\x07\x08", one_is_clear)).picture.coverage,
              (std::vector<float>{0, 1}));

    // EXIF 2.3, 4.6.4: 6 is shown turned clockwise by a quarter. Pixels per length: PNG, 11.3.5.3.
    const ReadPicture turned =
        read(png(2, 8, PNG_COLOR_TYPE_GRAY, std::string("\0\xff", 2), [](auto png, auto info) {
            std::string exif("II*\0\x08\0\0\0\1\0\x12\1\3\0\1\0\0\0\6\0\0\0\0\0\0\0", 26);
            png_set_eXIf_1(png, info, 26, reinterpret_cast<png_bytep>(exif.data()));
            png_set_pHYs(png, info, 100, 200, PNG_RESOLUTION_UNKNOWN);
        }));
    ASSERT_EQ(turned.picture.height, 2);
    expect_near(pixel(turned, 0, 1), {1, 1, 1}, 0);
    EXPECT_THAT(turned.notes, ElementsAre(HasSubstr("0.5 times as wide")));
}

class ForeignTiff : public test::ForeignPicture {
protected:
    using Adapt = std::function<void(TIFF*)>;

    template <class Sample>
    std::string tiff(const std::vector<Sample>& samples, int colours, int format,
                     const Adapt& adapt = {}) const {
        TIFF* tiff = TIFFOpen(file("a.tif").c_str(), "w");
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 1);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 1);
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, int{8 * sizeof(Sample)});
        TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, format);
        TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, int(samples.size()));
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, colours);
        TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
        if (adapt) adapt(tiff);
        TIFFWriteEncodedStrip(tiff, 0, const_cast<Sample*>(samples.data()),
                              static_cast<tmsize_t>(samples.size() * sizeof(Sample)));
        TIFFClose(tiff);
        return text("a.tif");
    }
    static Adapt profile(const std::string& bytes) {
        return [bytes](TIFF* tiff) {
            TIFFSetField(tiff, TIFFTAG_ICCPROFILE, static_cast<std::uint32_t>(bytes.size()),
                         bytes.data());
        };
    }
    static Adapt alpha(std::uint16_t kind) {
        return [kind](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_EXTRASAMPLES, 1, &kind); };
    }
    using Words = std::vector<std::uint16_t>;
    using Bytes = std::vector<std::uint8_t>;
};

TEST_F(ForeignTiff, ProfilesAreFollowed) {
    const Words values{20000, 40000, 60000};
    const Colour parts{20000 / 65535.0, 40000 / 65535.0, 60000 / 65535.0};
    const ReadPicture adobe =
        read(tiff(values, PHOTOMETRIC_RGB, SAMPLEFORMAT_UINT, profile(adobe_rgb_profile())));
    expect_near(pixel(adobe, 0, 0), test::srgb_of_adobe_rgb(powers(parts, 2.19921875)), 1e-3);
    EXPECT_EQ(adobe.white, 1);
    expect_near(
        pixel(read(tiff(values, PHOTOMETRIC_RGB, SAMPLEFORMAT_UINT, profile(linear_profile()))), 0,
              0),
        parts, 1e-3);
    // Floats are decoded the same way and keep their range.
    const std::vector<float> bright{4, 0.5f, 0.25f};
    expect_near(pixel(read(tiff(bright, PHOTOMETRIC_RGB, SAMPLEFORMAT_IEEEFP,
                                profile(adobe_rgb_profile()))),
                      0, 0),
                test::srgb_of_adobe_rgb(powers({4, 0.5, 0.25}, 2.19921875)), 0.02);
    // Invalid profiles, and profiles for inks, are reported.
    for (const std::string& broken :
         {std::string("no profile at all"), adobe_rgb_profile().substr(0, 200)}) {
        const ReadPicture read =
            this->read(tiff(values, PHOTOMETRIC_RGB, SAMPLEFORMAT_UINT, profile(broken)));
        expect_near(pixel(read, 0, 0),
                    {srgb_decoded(parts[0]), srgb_decoded(parts[1]), srgb_decoded(parts[2])}, 1e-6);
        EXPECT_THAT(read.notes, ElementsAre(HasSubstr("profile")));
        EXPECT_THAT(read.not_photometric, HasSubstr("profile"));
    }
    EXPECT_THAT(read(tiff(Bytes{1, 2, 3, 4}, PHOTOMETRIC_SEPARATED, SAMPLEFORMAT_UINT,
                          profile(linear_profile())))
                    .not_photometric,
                HasSubstr("other channels"));
    // Grey is R = G = B.
    const double grey = 30000 / 65535.0;
    expect_near(pixel(read(tiff(Words{30000}, PHOTOMETRIC_MINISBLACK, SAMPLEFORMAT_UINT,
                                profile(linear_profile()))),
                      0, 0),
                {grey, grey, grey}, 1e-3);
}

TEST_F(ForeignTiff, SamplesOfEveryKind) {
    // Half floats: TIFF technical note of Adobe Photoshop, 2005.
    const std::vector<Imath::half> halves{Imath::half(0.5f), Imath::half(2.0f), Imath::half(0.25f)};
    expect_near(pixel(read(tiff(halves, PHOTOMETRIC_RGB, SAMPLEFORMAT_IEEEFP)), 0, 0),
                {0.5, 2, 0.25}, 0);
    // TIFF 6.0, tag 262, WhiteIsZero.
    expect_near(pixel(read(tiff(Bytes{255}, PHOTOMETRIC_MINISWHITE, SAMPLEFORMAT_UINT)), 0, 0),
                {0, 0, 0}, 0);
    expect_near(pixel(read(tiff(Words{0}, PHOTOMETRIC_MINISWHITE, SAMPLEFORMAT_UINT)), 0, 0),
                {1, 1, 1}, 0);
    for (const int format : {SAMPLEFORMAT_UINT, SAMPLEFORMAT_INT})
        EXPECT_THAT(refusal(tiff(std::vector<std::uint32_t>{1, 2, 3}, PHOTOMETRIC_RGB, format)),
                    HasSubstr("32 bits, whole numbers"));
}

TEST_F(ForeignTiff, AlphaAndInks) {
    const double half = srgb_decoded(128 / 255.0);
    const ReadPicture unassociated = read(tiff(Bytes{128, 128, 128, 51}, PHOTOMETRIC_RGB,
                                               SAMPLEFORMAT_UINT, alpha(EXTRASAMPLE_UNASSALPHA)));
    expect_near(pixel(unassociated, 0, 0), {half, half, half}, 1e-6);
    EXPECT_FLOAT_EQ(unassociated.picture.coverage[0], 0.2f);
    // TIFF 6.0, section 18: associated alpha has been multiplied into the samples.
    const ReadPicture associated = read(tiff(Bytes{64, 64, 64, 127}, PHOTOMETRIC_RGB,
                                             SAMPLEFORMAT_UINT, alpha(EXTRASAMPLE_ASSOCALPHA)));
    expect_near(pixel(associated, 0, 0), {half, half, half}, 0.01);
    EXPECT_THAT(read(tiff(Words{9, 9, 9, 9}, PHOTOMETRIC_RGB, SAMPLEFORMAT_UINT,
                          alpha(EXTRASAMPLE_UNSPECIFIED)))
                    .notes,
                ElementsAre(HasSubstr("last channel")));
    const ReadPicture grey = read(tiff(Words{32768, 13107}, PHOTOMETRIC_MINISBLACK,
                                       SAMPLEFORMAT_UINT, alpha(EXTRASAMPLE_UNASSALPHA)));
    EXPECT_FLOAT_EQ(grey.picture.coverage[0], 0.2f);
    expect_near(pixel(grey, 0, 0), {half, half, half}, 0.002);

    // Half of the cyan and a fifth of black: no alpha.
    const ReadPicture inks =
        read(tiff(Bytes{128, 0, 255, 51}, PHOTOMETRIC_SEPARATED, SAMPLEFORMAT_UINT));
    EXPECT_FALSE(inks.had_alpha);
    expect_near(pixel(inks, 0, 0), {srgb_decoded(127 / 255.0 * 0.8), srgb_decoded(0.8), 0}, 1e-6);
    EXPECT_THAT(inks.not_photometric, HasSubstr("CMYK"));
}

TEST_F(ForeignTiff, PrimariesAspectAndFurtherPicturesAreSeen) {
    const float primaries[]{0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f};
    const ReadPicture read = this->read(
        tiff(std::vector<float>{1, 0, 0}, PHOTOMETRIC_RGB, SAMPLEFORMAT_IEEEFP, [&](TIFF* tiff) {
            TIFFSetField(tiff, TIFFTAG_PRIMARYCHROMATICITIES, primaries);
            TIFFSetField(tiff, TIFFTAG_XRESOLUTION, 100.0);
            TIFFSetField(tiff, TIFFTAG_YRESOLUTION, 200.0);
        }));
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(pixel(read, 0, 0)[c], test::k_rec709_of_rec2020[0][c], test::k_four_digits);
    EXPECT_THAT(read.notes, ElementsAre(HasSubstr("2 times as wide")));
}

class ForeignJpeg : public test::ForeignPicture {
protected:
    using Adapt = std::function<void(jpeg_compress_struct&)>;

    // 8 x 8 pixels of one colour at the best quality.
    static std::string jpeg(const std::vector<std::uint8_t>& colour, J_COLOR_SPACE space,
                            const std::string& profile = {}, const Adapt& adapt = {}) {
        jpeg_compress_struct info{};
        jpeg_error_mgr errors{};
        info.err = jpeg_std_error(&errors);
        jpeg_create_compress(&info);
        unsigned char* memory = nullptr;
        unsigned long size = 0;
        jpeg_mem_dest(&info, &memory, &size);
        info.image_width = info.image_height = 8;
        info.input_components = static_cast<int>(colour.size());
        info.in_color_space = space;
        jpeg_set_defaults(&info);
        jpeg_set_quality(&info, 100, TRUE);
        if (adapt) adapt(info);
        jpeg_start_compress(&info, TRUE);
        if (!profile.empty())
            jpeg_write_icc_profile(&info, reinterpret_cast<const JOCTET*>(profile.data()),
                                   static_cast<unsigned>(profile.size()));
        std::vector<std::uint8_t> row;
        for (int x = 0; x < 8; ++x) row.insert(row.end(), colour.begin(), colour.end());
        for (int y = 0; y < 8; ++y) {
            JSAMPROW start = row.data();
            jpeg_write_scanlines(&info, &start, 1);
        }
        jpeg_finish_compress(&info);
        std::string bytes(reinterpret_cast<const char*>(memory), size);
        jpeg_destroy_compress(&info);
        std::free(memory);
        return bytes;
    }
    static constexpr Colour k_parts{100 / 255.0, 150 / 255.0, 200 / 255.0};
};

TEST_F(ForeignJpeg, AdobeRgbByProfileAndByExif) {
    const std::vector<std::uint8_t> colour{100, 150, 200};
    const Colour expected = test::srgb_of_adobe_rgb(powers(k_parts, 2.19921875));
    expect_near(pixel(read(jpeg(colour, JCS_RGB, adobe_rgb_profile())), 3, 3), expected, 0.01);
    // DCF 2.0: the interoperability index R03 says the same, without a profile. The directories of
    // EXIF, each entry of 12 bytes: 34665 (EXIF) at 26, 40965 (interoperability) at 44, 1 (index).
    const std::string exif(
        "II*\0\x08\0\0\0"
        "\1\0\x69\x87\4\0\1\0\0\0\x1a\0\0\0\0\0\0\0"
        "\1\0\x05\xa0\4\0\1\0\0\0\x2c\0\0\0\0\0\0\0"
        "\1\0\1\0\2\0\4\0\0\0R03\0\0\0\0\0",
        62);
    std::string bytes = jpeg(colour, JCS_RGB);
    bytes.insert(2, std::string("\xff\xe1\0\x46"
                                "Exif\0\0",
                                10) +
                        exif);
    const ReadPicture by_exif = read(bytes);
    expect_near(pixel(by_exif, 3, 3), expected, 0.01);
    EXPECT_EQ(by_exif.encoding, "8-bit Adobe RGB (1998)");
}

TEST_F(ForeignJpeg, InksOfAdobeAreComplements) {
    // What cyan and black leave of white: the same picture either way.
    const Colour expected{srgb_decoded(100 / 255.0 * 0.8), srgb_decoded(0.8), srgb_decoded(0.8)};
    const ReadPicture adobe = read(jpeg({100, 255, 255, 204}, JCS_CMYK));
    expect_near(pixel(adobe, 3, 3), expected, 0.01);
    EXPECT_THAT(adobe.not_photometric, HasSubstr("CMYK"));
    const ReadPicture plain = read(
        jpeg({155, 0, 0, 51}, JCS_CMYK, {}, [](auto& info) { info.write_Adobe_marker = FALSE; }));
    expect_near(pixel(plain, 3, 3), expected, 0.01);
    const ReadPicture ycck = read(jpeg({100, 255, 255, 204}, JCS_CMYK, {},
                                       [](auto& info) { jpeg_set_colorspace(&info, JCS_YCCK); }));
    expect_near(pixel(ycck, 3, 3), expected, 0.02);
}

TEST(OtherPictures, AreNamedWithWhatToDo) {
    const std::pair<std::string, const char*> files[]{
        {std::string("\0\0\0\x18", 4) + "ftypheic\0\0\0\0", "HEIC"},
        {std::string("\0\0\0\x18", 4) + "ftypavif\0\0\0\0", "AVIF"},
        {"RIFF1234WEBPVP8 ", "WebP"},
        {"GIF89a", "GIF"}};
    for (const auto& [bytes, name] : files) {
        try {
            picture_of_bytes(bytes, "a");
            ADD_FAILURE() << name;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(std::string("format ") + name));
            EXPECT_THAT(error.what(), HasSubstr("convert it"));
        }
    }
}

}  // namespace
