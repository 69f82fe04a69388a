// Radiance and float maps. Expectations: Radiance's file formats (filefmts), Debevec's PFM.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "tests/render/foreign_picture.h"

namespace {

using namespace culet;
using culet::test::Colour;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Radiance : public test::ForeignPicture {
protected:
    // 8-bit mantissas: accurate to 2^-8 of their power of two.
    static std::string rgbe(const Colour& colour) {
        int exponent = 0;
        std::frexp(std::max({colour[0], colour[1], colour[2]}), &exponent);
        std::string bytes;
        for (const double v : colour)
            bytes += static_cast<char>(static_cast<int>(v * std::ldexp(256, -exponent)));
        return bytes + static_cast<char>(exponent + 128);
    }
    static std::string one(const std::string& lines, const Colour& colour,
                           const char* format = "rgbe") {
        return fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_{}\n{}\n-Y 1 +X 1\n", format, lines) +
               rgbe(colour);
    }
};

TEST_F(Radiance, ExposuresAndColourCorrectionsMultiplyAndAreTakenOut) {
    // Indented lines belong to the pictures it was made from and are ignored.
    const ReadPicture read = this->read(
        one("EXPOSURE=2\n\tEXPOSURE=100\nEXPOSURE=4.0\nCOLORCORR=2 1 0.5\n", {1, 0.5, 0.25}));
    expect_near(pixel(read, 0, 0), {1 / 16.0, 1 / 16.0, 1 / 16.0}, 1e-7);
    EXPECT_THAT(read.notes, IsEmpty());
    EXPECT_THAT(refusal(one("EXPOSURE=0\n", {1, 1, 1})), HasSubstr("line 3"));
    EXPECT_THAT(refusal(one("COLORCORR=1 2\n", {1, 1, 1})), HasSubstr("line 3"));
}

TEST_F(Radiance, XyzAndPrimariesBecomeSrgb) {
    expect_near(pixel(read(one("", test::k_d65_xyz, "xyze")), 0, 0), {1, 1, 1}, 0.02);
    const ReadPicture red =
        read(one("PRIMARIES=.708 .292 .170 .797 .131 .046 .3127 .3290\n", {0.5, 0, 0}));
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(pixel(red, 0, 0)[c], 0.5 * test::k_rec709_of_rec2020[0][c],
                    test::k_four_digits);
    // Radiance's own white is equal energy: white stays white.
    expect_near(
        pixel(read(one("PRIMARIES=.64 .33 .29 .60 .15 .06 .3333 .3333\n", {1, 1, 1})), 0, 0),
        {1, 1, 1}, 1e-6);
    // Photoshop's way of leaving it unspecified.
    expect_near(pixel(read(one("PRIMARIES=0 0 0 0 0 0 0 0\n", {0.5, 0, 0})), 0, 0), {0.5, 0, 0}, 0);
    EXPECT_THAT(refusal(one("", {1, 1, 1}, "luvw")), HasSubstr("line 2"));
}

TEST_F(Radiance, EveryOrderOfPixelsIsTurnedUpright) {
    constexpr int k_columns = 3, k_rows = 2;
    const auto value = [](int x, int y) { return Colour{(x + 1) / 8.0, (y + 1) / 8.0, 0.5}; };
    for (const char first : {'Y', 'X'}) {
        for (const bool x_right : {true, false}) {
            for (const bool y_down : {true, false}) {
                const std::string x = fmt::format("{}X {}", x_right ? '+' : '-', k_columns),
                                  y = fmt::format("{}Y {}", y_down ? '-' : '+', k_rows);
                std::string bytes = fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n{} {}\n",
                                                first == 'Y' ? y : x, first == 'Y' ? x : y);
                for (int slow = 0; slow < (first == 'Y' ? k_rows : k_columns); ++slow) {
                    for (int fast = 0; fast < (first == 'Y' ? k_columns : k_rows); ++fast) {
                        const int column = first == 'Y' ? fast : slow,
                                  row = first == 'Y' ? slow : fast;
                        bytes += rgbe(value(x_right ? column : k_columns - 1 - column,
                                            y_down ? row : k_rows - 1 - row));
                    }
                }
                const ReadPicture read = this->read(bytes);
                ASSERT_EQ(read.picture.width, k_columns) << bytes;
                for (int row = 0; row < k_rows; ++row)
                    for (int column = 0; column < k_columns; ++column)
                        expect_near(pixel(read, column, row), value(column, row), 1e-6);
            }
        }
    }
    EXPECT_THAT(refusal("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +Y 1\nabcd"),
                HasSubstr("-Y 512"));
}

TEST_F(Radiance, OldRunsRepeatThePixelBefore) {
    // 1 + 3 + 256 pixels: a mark directly after a mark counts 256 times.
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 262\n" +
                        rgbe({0.5, 0.25, 0.5}) + "\1\1\1\3" + "\1\1\1\1" + rgbe({0.25, 0.5, 0.5}) +
                        "\1\1\1\1";
    const ReadPicture read = this->read(bytes);
    expect_near(pixel(read, 259, 0), {0.5, 0.25, 0.5}, 0);
    expect_near(pixel(read, 260, 0), {0.25, 0.5, 0.5}, 0);
    expect_near(pixel(read, 261, 0), {0.25, 0.5, 0.5}, 0);
    bytes.back() = '\2';
    EXPECT_THAT(refusal(bytes), HasSubstr("damaged"));
}

TEST_F(Radiance, HeadersOfOtherProgramsAreRead) {
    const std::string longer(5000, 'x');
    const ReadPicture read = this->read("#?RADIANCE\r\nSOFTWARE=" + longer +
                                        "\r\nPIXASPECT=0.5\r\n\r\n-Y 1 +X 1\n" + rgbe({1, 1, 1}));
    expect_near(pixel(read, 0, 0), {1, 1, 1}, 0);
    // Radiance's aspect is height over width.
    EXPECT_THAT(read.notes, ElementsAre(HasSubstr("FORMAT"), HasSubstr("2 times as wide")));
}

TEST_F(Radiance, AFloatMapsScaleMultiplies) {
    const float values[3]{0.25f, 0.5f, 1};
    std::string samples(reinterpret_cast<const char*>(values), sizeof values);
    const ReadPicture scaled = read("PF 1 1 -2\n" + samples);
    expect_near(pixel(scaled, 0, 0), {0.5, 1, 2}, 0);
    EXPECT_THAT(scaled.notes, ElementsAre(HasSubstr("scale, 2")));
    for (int c = 0; c < 3; ++c) std::reverse(samples.begin() + 4 * c, samples.begin() + 4 * c + 4);
    expect_near(pixel(read("PF\r\n1 1\r\n1.0\r\n" + samples), 0, 0), {0.25, 0.5, 1}, 0);
}

}  // namespace
