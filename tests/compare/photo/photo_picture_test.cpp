// Photos as EXR files. Expectations: IEEE 754 binary16 (11 significant bits, 2^-24 to 65504).

#include "compare/photo/photo_picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/image/image_io.h"
#include "tests/scratch_folder.h"

namespace culet {
namespace {

// Values over four decades, each with noise of the given relative size.
Photo photo_of(double noise) {
    Photo photo;
    photo.width = 40;
    photo.height = 30;
    for (std::size_t i = 0; i < 3 * 1200; ++i) {
        const double value = 1e-4 * std::pow(1e4, double(i) / 3600);
        photo.rgb.push_back(float(value));
        photo.variance.push_back(float(noise * noise * value * value));
    }
    photo.saturated.assign(1200, 0);
    return photo;
}

TEST(PhotoPicture, NoiseDecidesAboutHalfFloats) {
    const auto samples = [](const Photo& photo) { return picture_of(photo).samples; };
    EXPECT_EQ(samples(photo_of(0.005)), Picture::Samples::half);
    EXPECT_EQ(samples(photo_of(1e-5)), Picture::Samples::single);
    Photo bright = photo_of(0.005);
    bright.rgb[7] = 70000;
    EXPECT_EQ(samples(bright), Picture::Samples::single) << "beyond the largest half";
    // A dark first shot: in its units dark values fall below the resolution of halves.
    Photo dark = photo_of(0.005);
    for (float& value : dark.rgb) value *= 1e-4f;
    for (float& value : dark.variance) value *= 1e-8f;
    EXPECT_EQ(samples(dark), Picture::Samples::single);
    Photo unknown = photo_of(0.005);
    unknown.variance.clear();
    EXPECT_EQ(samples(unknown), Picture::Samples::single);
}

TEST(PhotoPicture, ComesBackFromItsFile) {
    const test::ScratchFolder folder;
    const Photo photo = photo_of(0.005);
    write_picture(picture_of(photo), folder / "photo.exr");
    const Picture back = read_picture(folder / "photo.exr").picture;
    ASSERT_EQ(back.rgb.size(), photo.rgb.size());
    for (std::size_t i = 0; i < back.rgb.size(); ++i)
        ASSERT_NEAR(back.rgb[i], photo.rgb[i], std::ldexp(photo.rgb[i], -11)) << i;
    ASSERT_EQ(back.planes.size(), 4u);
    EXPECT_EQ(back.planes[0].channel, "variance.R");
    for (std::size_t i = 0; i < back.pixels(); ++i) {
        const float variance = photo.variance[3 * i];
        ASSERT_NEAR(back.planes[0].values[i], variance, variance / 64) << i;
    }
}

}  // namespace
}  // namespace culet
