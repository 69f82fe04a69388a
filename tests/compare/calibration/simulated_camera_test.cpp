#include "compare/calibration/simulated_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/calibration/photo_blur.h"
#include "compare/photo/pixels.h"
#include "render/colour/colour.h"
#include "tests/compare/synthetic_pictures.h"

namespace culet {
namespace {

Photo grey(float value) {
    Photo photo = synthetic::flat(64, 64, value);
    photo.saturation = 0;
    photo.coverage.assign(64 * 64, 1.0f);
    return photo;
}

// Shot noise at 0.4 x 10000 electrons, and 6 of read noise: sqrt(4000 + 36) / 10000. The variance
// of 12288 samples is known to sqrt(2 / 12288) = 1.3 %; five of these are allowed.
TEST(SimulatedCamera, HasTheNoiseOfItsElectrons) {
    CameraModel camera;
    camera.bits = 0;
    camera.clips = false;
    camera.gain = {2, 2, 2};
    camera.psf_px = 0;
    const Photo photo = photographed(grey(0.2f), camera, 1);
    double sum = 0, squares = 0;
    for (const float v : photo.rgb) {
        sum += static_cast<double>(v);
        squares += static_cast<double>(v) * static_cast<double>(v);
    }
    const double n = static_cast<double>(photo.rgb.size()), mean = sum / n;
    const double variance = squares / n - mean * mean;
    EXPECT_NEAR(mean, 0.4, 5 * std::sqrt(variance / n));
    EXPECT_NEAR(variance / (4036.0 / 1e8), 1, 0.065);
}

TEST(SimulatedCamera, WritesWholeStepsAndClips) {
    CameraModel camera;
    camera.gain = {1, 3, 1};
    const Photo photo = photographed(grey(0.5f), camera, 2);
    EXPECT_EQ(photo.saturation, 1);
    for (std::size_t i = 0; i < photo.rgb.size(); i += 3) {
        const double steps = srgb_encoded(static_cast<double>(photo.rgb[i])) * 255;
        EXPECT_NEAR(steps, std::round(steps), 1e-3);
        EXPECT_EQ(photo.rgb[i + 1], 1.0f);
    }
}

TEST(SimulatedCamera, IsRepeatableAndKeepsTheCoverageWhereAsked) {
    CameraModel camera;
    const Photo a = photographed(grey(0.3f), camera, 3), b = photographed(grey(0.3f), camera, 3),
                c = photographed(grey(0.3f), camera, 4);
    EXPECT_EQ(a.rgb, b.rgb);
    EXPECT_NE(a.rgb, c.rgb);
    EXPECT_TRUE(a.coverage.empty());
    camera.outline_from_background = false;
    EXPECT_EQ(photographed(grey(0.3f), camera, 3).coverage.size(), 64u * 64u);
}

TEST(SimulatedCamera, MetersAnotherLightLikeTheModel) {
    const Photo dim = grey(0.1f), model = grey(0.4f);
    EXPECT_NEAR(exposure_like(dim, model), 4, 1e-5);
    EXPECT_EQ(exposure_like(grey(0), model), 1);
}

// Two pictures of cells, one of them photographed with a known blur. The cells of the other are
// moved slightly, as by facet errors; no detail is lost.
TEST(PhotoBlur, IsFoundWhetherOrNotTheCellsAreInTheirPlaces) {
    for (const double shift : {0.0, 0.03}) {
        for (const double sigma : {0.8, 1.5, 2.5}) {
            synthetic::StonePicture drawn;
            drawn.cell_shift = shift;
            drawn.with_coverage = true;
            const Photo sharp = synthetic::draw(drawn);
            CameraModel camera;
            camera.psf_px = sigma;
            camera.scale_error = 0;
            const Photo photo = photographed(sharp, camera, 6);
            drawn.cell_shift = 0;
            const Photo render = synthetic::draw(drawn);
            MatchedPictures pictures;
            pictures.photo = colour_of(photo).clone();
            pictures.render = colour_of(render).clone();
            pictures.mask = cv::Mat::zeros(photo.height, photo.width, CV_8U);
            cv::ellipse(pictures.mask, {158, 150}, {85, 65}, 0, 0, 360, cv::Scalar(255),
                        cv::FILLED);
            pictures.diameter = 180;
            EXPECT_NEAR(photo_blur_px(pictures), sigma, 0.3) << shift;
        }
    }
}

// A Gaussian of 1.5 pixels spreads one lit pixel of 64 x 64 to a second moment of 1.5^2 per axis;
// its tails end at about four deviations.
TEST(Softened, SpreadsLightByThePointSpreadAndKeepsItAndTheCoverage) {
    Photo point = grey(0);
    for (std::size_t c = 0; c < 3; ++c) point.rgb[3 * (32 * 64 + 32) + c] = 1;
    const Photo soft = softened(point, 1.5);
    double light = 0, moment = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const auto v = static_cast<double>(soft.rgb[3 * static_cast<std::size_t>(y * 64 + x)]);
            light += v;
            moment += v * (x - 32) * (x - 32);
        }
    }
    EXPECT_NEAR(light, 1, 1e-4);
    EXPECT_NEAR(moment, 2.25, 0.03);
    EXPECT_EQ(soft.coverage, point.coverage);
    EXPECT_EQ(softened(point, 0).rgb, point.rgb);
}

TEST(PhotoBlur, OfASharperPhotoOrOfAFewPixelsIsNone) {
    MatchedPictures pictures;
    pictures.photo = cv::Mat(64, 64, CV_32FC3, cv::Scalar(0.5, 0.5, 0.5));
    cv::randu(pictures.photo, 0.0, 1.0);
    cv::GaussianBlur(pictures.photo, pictures.render, {0, 0}, 2);
    pictures.mask = cv::Mat(64, 64, CV_8U, cv::Scalar(255));
    EXPECT_EQ(photo_blur_px(pictures), 0);
    pictures.mask.setTo(0);
    EXPECT_EQ(photo_blur_px(pictures), 0);
}

}  // namespace
}  // namespace culet
