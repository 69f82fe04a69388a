#pragma once
// Reading pictures that a test made, and published colour space data.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "render/image/image_io.h"
#include "stone/text/errors.h"
#include "tests/folder_test.h"

namespace culet::test {

using Colour = std::array<double, 3>;

class ForeignPicture : public FolderTest {
protected:
    static ReadPicture read(const std::string& bytes) { return picture_of_bytes(bytes, "a"); }
    static std::string refusal(const std::string& bytes) {
        try {
            read(bytes);
        } catch (const InputError& error) {
            return error.what();
        }
        return "read";
    }
    static Colour pixel(const ReadPicture& read, int x, int y) {
        const Rgb rgb = read.picture.pixel(x, y);
        return {rgb[0], rgb[1], rgb[2]};
    }
    static void expect_near(const Colour& found, const Colour& expected, double tolerance) {
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], expected[c], tolerance) << "channel " << c;
    }
};

// To XYZ (D65): Adobe RGB (1998) 4.3.6.1; from XYZ to sRGB: IEC 61966-2-1:1999, amendment 1, F.8.
inline Colour srgb_of_adobe_rgb(const Colour& v) {
    const double x = 0.57667 * v[0] + 0.18556 * v[1] + 0.18823 * v[2],
                 y = 0.29734 * v[0] + 0.62736 * v[1] + 0.07529 * v[2],
                 z = 0.02703 * v[0] + 0.07069 * v[1] + 0.99134 * v[2];
    return {3.2406255 * x - 1.5372080 * y - 0.4986286 * z,
            -0.9689307 * x + 1.8757561 * y + 0.0415175 * z,
            0.0557101 * x - 0.2040211 * y + 1.0569959 * z};
}

// Columns of Rec. ITU-R BT.2407-0, 2.2: Rec. 2020 to Rec. 709.
inline constexpr std::array<Colour, 3> k_rec709_of_rec2020{
    {{1.6605, -0.1246, -0.0182}, {-0.5876, 1.1329, -0.1006}, {-0.0728, -0.0083, 1.1187}}};

// This matrix and that of IEC 61966-2-1 are published with four digits.
inline constexpr double k_four_digits = 5e-4;

// D65 at luminance 1, CIE 15.
inline constexpr Colour k_d65_xyz{0.95047, 1, 1.08883};

}  // namespace culet::test
