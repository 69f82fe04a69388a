#include "compare/calibration/picture_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/report/scores_json.h"
#include "compare/scores/aligned_pair.h"
#include "render/colour/colour.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "tests/compare/synthetic_pictures.h"

namespace culet {
namespace {

using synthetic::draw;
using synthetic::StonePicture;
using ::testing::HasSubstr;

const Score& score(const Comparison& comparison, const std::string& key) {
    for (const Score& s : comparison.scores) {
        if (s.key == key) return s;
    }
    throw InternalError("no score of that name");
}

StonePicture small() {
    StonePicture picture;
    picture.width = 150;
    picture.height = 136;
    picture.centre_x = 74.6;
    picture.centre_y = 67.3;
    picture.diameter = 100;
    picture.samples = 3;
    return picture;
}

TEST(Compare, APictureComparedWithItselfScoresPerfect) {
    const Photo photo = draw(small());
    const Comparison c = compare(photo, photo);
    EXPECT_EQ(c.verdict, Verdict::match);
    EXPECT_TRUE(c.usable());
    EXPECT_DOUBLE_EQ(c.registration.iou, 1);
    EXPECT_NEAR(c.registration.residual_px, 0, 1e-6);
    for (const double gain : c.gain) EXPECT_NEAR(gain, 1, 1e-9);
    // Single precision in the blurred planes.
    EXPECT_NEAR(*score(c, "zncc").value, 1, 1e-6);
    EXPECT_NEAR(*score(c, "ssim").value, 1, 1e-6);
    EXPECT_NEAR(*score(c, "deltaE00_mean").value, 0, 1e-6);
    EXPECT_FALSE(score(c, "psnr").value.has_value());
    EXPECT_THAT(score(c, "psnr").note, HasSubstr("equal"));
    EXPECT_GE(c.null_draws, 20);
}

// The truth is the drawing's own transform. One outline point is good to about a quarter of a pixel
// (the steps of the mask after smoothing) and every fourth is independent. So 300 points give the
// centre to 0.03 px, the scale to 0.03 / radius, the turn to 0.03 / (0.1 radius), where 0.1 is the
// root mean square lever of this outline. Four standard deviations are allowed.
TEST(Compare, AKnownMoveIsRecoveredFromTheCoverage) {
    StonePicture still = small();
    still.with_coverage = true;
    StonePicture moved = still;
    moved.centre_x += 6.3;
    moved.centre_y -= 4.2;
    moved.turn = 0.1;
    moved.diameter *= 1.04;
    const Comparison c = compare(draw(moved), draw(still));
    const Registration& r = c.registration;
    EXPECT_EQ(r.photo_outline, "coverage");
    EXPECT_NEAR(r.scale, 1 / 1.04, 4 * 0.03 / 50);
    EXPECT_NEAR(radians(r.turn_deg), -0.1, 4 * 0.03 / 5);
    const double arm_x = moved.centre_x - r.centre_px[0], arm_y = moved.centre_y - r.centre_px[1];
    const double a = radians(r.turn_deg), co = r.scale * std::cos(a), si = r.scale * std::sin(a);
    EXPECT_NEAR(r.centre_px[0] + r.shift_px[0] + co * arm_x - si * arm_y, still.centre_x, 4 * 0.03);
    EXPECT_NEAR(r.centre_px[1] + r.shift_px[1] + si * arm_x + co * arm_y, still.centre_y, 4 * 0.03);
    EXPECT_GT(r.iou, 0.99);
    EXPECT_EQ(c.verdict, Verdict::match);
    EXPECT_GT(*score(c, "zncc").value, 0.99);
}

// Outlines segmented on different grounds may each be off by half a pixel all round. Another
// picture in the render's place must lie as if it had been aligned itself: both outlines come from
// the coverage.
TEST(AlignedPair, TakesAnotherPictureOfTheRendersOutline) {
    StonePicture still = small();
    still.with_coverage = true;
    StonePicture moved = still;
    moved.centre_x += 3.3;
    moved.turn = 0.05;
    const Photo photo = draw(moved), render = draw(still);
    Photo darker = render;
    for (std::size_t i = 0; i < darker.rgb.size(); i += 2) darker.rgb[i] *= 0.5f;
    const AlignedPair put = with_render(aligned(photo, render, 70), darker);
    const AlignedPair own = aligned(photo, darker, 70);
    EXPECT_TRUE(put.comparable());
    EXPECT_EQ(cv::norm(put.pictures.render, own.pictures.render, cv::NORM_INF), 0);
    EXPECT_EQ(put.gain, own.gain);
    EXPECT_EQ(put.compared_pixels, own.compared_pixels);
}

TEST(Compare, AKnownMoveIsRecoveredFromTheBackground) {
    const StonePicture still = small();
    StonePicture moved = still;
    moved.centre_x += 6.3;
    moved.turn = -0.08;
    moved.diameter *= 1.04;
    const Comparison c = compare(draw(moved), draw(still));
    EXPECT_EQ(c.registration.photo_outline, "background");
    EXPECT_NEAR(c.registration.scale, 1 / 1.04, 1.0 / 50);
    EXPECT_NEAR(radians(c.registration.turn_deg), 0.08, 4 * 0.03 / 5);
    EXPECT_EQ(c.verdict, Verdict::match);
}

// A disc's outline: its centre is right to a tenth of a pixel, its diameter to a pixel.
TEST(Compare, TheOutlineFromTheBackgroundIsWhereTheStoneIs) {
    StonePicture round = small();
    round.flatness = 1;
    round.sides = 0;
    round.diameter = 90;  // the outline ends at sqrt(1.1) times this
    round.centre_x = 73.5;
    const Registration r = compare(draw(round), draw(round)).registration;
    EXPECT_NEAR(r.centre_px[0], 73.5, 0.1);
    EXPECT_NEAR(r.centre_px[1], 67.3, 0.1);
    EXPECT_NEAR(r.photo_diameter_px, 90 * std::sqrt(1.1), 1);
}

TEST(Compare, APhotoOfFourTimesThePixelsIsComparedAtTheRendersSize) {
    const StonePicture still = small();
    StonePicture large = still;
    large.width *= 4;
    large.height *= 4;
    large.centre_x = 4 * still.centre_x + 1.5;  // pixel centres: 4 (x + 0.5) - 0.5
    large.centre_y = 4 * still.centre_y + 1.5;
    large.diameter *= 4;
    large.samples = 1;
    const Comparison c = compare(draw(large), draw(still));
    EXPECT_EQ(c.verdict, Verdict::match);
    EXPECT_NEAR(c.registration.scale, 0.25, 0.25 * 0.5 / 50);
    EXPECT_NEAR(c.registration.photo_diameter_px, 4 * c.registration.render_diameter_px, 8);
    EXPECT_GT(*score(c, "zncc").value, 0.99);
}

TEST(Compare, GainOfEachChannelIsRecovered) {
    StonePicture photo = small();
    photo.gain[0] = 0.5;
    photo.gain[1] = 0.8;
    photo.gain[2] = 1.1;
    const Comparison c = compare(draw(photo), draw(small()));
    // Exact, except for the few cells that the third gain drives into clipping, which are left out.
    EXPECT_NEAR(c.gain[0], 0.5, 1e-6);
    EXPECT_NEAR(c.gain[1], 0.8, 1e-6);
    EXPECT_NEAR(c.gain[2], 1.1, 1e-6);
    EXPECT_NEAR(*score(c, "zncc").value, 1, 1e-3);
}

TEST(Compare, ClippedPixelsDoNotPullTheGain) {
    StonePicture photo = small();
    for (double& gain : photo.gain) gain = 3;
    const Comparison c = compare(draw(photo), draw(small()));
    EXPECT_GT(c.saturated, 0.05);
    for (const double gain : c.gain) EXPECT_NEAR(gain, 3, 1e-3);
}

// A camera adds a blur of 0.7 pixels, shot and read noise, and 8 bits. Pose and verdict must hold.
TEST(Compare, NoiseAndBlurOfACameraDoNotUpsetIt) {
    StonePicture turned = small();
    turned.turn = 0.05;
    Photo photo = draw(turned);
    cv::Mat pixels(photo.height, photo.width, CV_32FC3, photo.rgb.data());
    cv::GaussianBlur(pixels, pixels, {0, 0}, 0.7);
    cv::RNG random(1);
    for (float& v : photo.rgb) {
        const double noisy = v + random.gaussian(std::sqrt(2e-6 + 2e-4 * static_cast<double>(v)));
        const double bits = std::round(255 * srgb_encoded(std::clamp(noisy, 0.0, 1.0)));
        v = static_cast<float>(srgb_decoded(bits / 255));
    }
    const Comparison c = compare(photo, draw(small()));
    EXPECT_EQ(c.verdict, Verdict::match);
    EXPECT_GT(c.registration.iou, 0.96);
    EXPECT_NEAR(radians(c.registration.turn_deg), -0.05, 0.03);
    // The outline is then good to about a pixel, half of this score's blur.
    EXPECT_GT(*score(c, "zncc").value, 0.85);
    EXPECT_NEAR(c.registration.scale, 1, 0.02);
}

TEST(Compare, AnotherPatternInTheSameOutlineIsNoEvidence) {
    StonePicture other = small();
    other.pattern = 9;
    const Comparison c = compare(draw(other), draw(small()));
    EXPECT_EQ(c.verdict, Verdict::no_evidence);
    EXPECT_TRUE(c.usable());
    EXPECT_LT(*score(c, "zncc").value, 0.4);
}

TEST(Compare, ScoresFallAsThePatternMovesAway) {
    double last_zncc = 2, last_delta = -1;
    for (const double shift : {0.0, 0.05, 0.15, 0.5}) {
        StonePicture wrong = small();
        wrong.cell_shift = shift;
        const Comparison c = compare(draw(wrong), draw(small()));
        EXPECT_LT(*score(c, "zncc").value, last_zncc);
        EXPECT_GT(*score(c, "deltaE00_mean").value, last_delta);
        last_zncc = *score(c, "zncc").value;
        last_delta = *score(c, "deltaE00_mean").value;
    }
}

TEST(Compare, AMirroredPictureIsNotTurnedBackSilently) {
    StonePicture mirrored = small();
    mirrored.mirrored = true;
    mirrored.flatness = 0.95;
    StonePicture plain = small();
    plain.flatness = 0.95;
    const Comparison c = compare(draw(mirrored), draw(plain));
    EXPECT_NE(c.verdict, Verdict::match);
    EXPECT_LT(*score(c, "zncc").value, 0.5);
}

TEST(Compare, AQuarterTurnIsRefusedWithAHint) {
    StonePicture quarter = small();
    quarter.turn = std::numbers::pi / 2;
    const Comparison c = compare(draw(quarter), draw(small()));
    EXPECT_EQ(c.verdict, Verdict::refused);
    EXPECT_FALSE(c.usable());
    EXPECT_THAT(c.reason, HasSubstr("clockwise by 90 degrees"));
    EXPECT_FALSE(c.pictures.photo_outline.values.empty());
    EXPECT_FALSE(c.pictures.render_outline.values.empty());
}

TEST(Compare, AnotherOutlineIsRefused) {
    StonePicture narrow = small();
    narrow.flatness = 0.5;
    const Comparison c = compare(draw(narrow), draw(small()));
    EXPECT_EQ(c.verdict, Verdict::refused);
    EXPECT_THAT(c.reason, HasSubstr("overlap"));
}

TEST(Compare, ARoundStoneKeepsItsTurnAndSaysSo) {
    StonePicture round = small();
    round.flatness = 1;
    round.sides = 400;
    StonePicture turned = round;
    turned.turn = 0.2;
    const Comparison c = compare(draw(turned), draw(round));
    EXPECT_FALSE(c.registration.turn_known);
    EXPECT_NEAR(c.registration.turn_deg, 0, 1e-12);
    EXPECT_THAT(c.registration.warnings, testing::Contains(HasSubstr("round")));
}

TEST(Compare, ALightGroundAndADarkBoxBothShowTheStone) {
    StonePicture light = small();
    light.ground = 0.95;
    const Comparison c = compare(draw(light), draw(small()));
    EXPECT_GT(c.registration.iou, 0.97);
    EXPECT_EQ(c.verdict, Verdict::match);
}

TEST(Compare, ABlackPhotoIsRefused) {
    const Comparison c = compare(synthetic::flat(150, 136, 0), draw(small()));
    EXPECT_EQ(c.verdict, Verdict::refused);
    EXPECT_THAT(c.reason, HasSubstr("black"));
}

TEST(Compare, APhotoOfOneColourIsRefused) {
    const Comparison c = compare(synthetic::flat(150, 136, 0.5f), draw(small()));
    EXPECT_EQ(c.verdict, Verdict::refused);
    EXPECT_THAT(c.reason, HasSubstr("--mask"));
}

TEST(Compare, AStoneOfOneColourHoldsNoEvidence) {
    StonePicture plain = small();
    plain.with_coverage = true;
    Photo photo = draw(plain);
    std::fill(photo.rgb.begin(), photo.rgb.end(), 0.25f);
    const Comparison c = compare(photo, draw(plain));
    EXPECT_EQ(c.verdict, Verdict::no_evidence);
    EXPECT_FALSE(score(c, "zncc").value.has_value());
    EXPECT_THAT(c.reason, HasSubstr("one brightness"));
}

TEST(Compare, ABlackRenderInsideItsCoverageHoldsNoEvidence) {
    StonePicture plain = small();
    plain.with_coverage = true;
    Photo render = draw(plain);
    std::fill(render.rgb.begin(), render.rgb.end(), 0.0f);
    const Comparison c = compare(draw(plain), render);
    EXPECT_EQ(c.verdict, Verdict::no_evidence);
    for (const double gain : c.gain) EXPECT_EQ(gain, 1);
}

// A pattern of rings looks the same at any turn: turned copies are no null distribution.
TEST(Compare, ARenderThatLooksTheSameTurnedGivesNoNull) {
    StonePicture round = small();
    round.flatness = 1;
    round.sides = 400;
    Photo rings = draw(round);
    for (int y = 0; y < rings.height; ++y) {
        for (int x = 0; x < rings.width; ++x) {
            const double r = std::hypot(x - round.centre_x, y - round.centre_y);
            if (r > 53) continue;
            for (int i = 0; i < 3; ++i) {
                rings.rgb[static_cast<std::size_t>(3 * (y * rings.width + x) + i)] =
                    static_cast<float>(0.3 + 0.2 * std::sin(0.4 * r));
            }
        }
    }
    const Comparison c = compare(rings, rings);
    EXPECT_EQ(c.verdict, Verdict::no_evidence);
    EXPECT_THAT(c.reason, HasSubstr("however it is turned"));
}

TEST(Compare, AMaskOfThreePixelsIsRefused) {
    const Photo render = draw(small());
    Photo photo = render;
    photo.mask.assign(static_cast<std::size_t>(photo.width * photo.height), 0.0f);
    for (const int i : {7000, 7001, 7002}) photo.mask[static_cast<std::size_t>(i)] = 1;
    const Comparison c = compare(photo, render);
    EXPECT_EQ(c.verdict, Verdict::refused);
    EXPECT_THAT(c.reason, HasSubstr("pixels across"));
}

// With all but three pixels ignored; and with all but a corner, which is compared as usual.
TEST(Compare, WhatIsToBeIgnoredIsLeftOutOfEveryScore) {
    StonePicture p;
    p.with_coverage = true;
    const Photo photo = draw(p);
    Photo spoiled = photo;
    std::vector<float> ignored(photo.coverage.size(), 0.0f);
    for (int y = 120; y < 170; ++y) {
        for (int x = 130; x < 180; ++x) {
            const auto i = static_cast<std::size_t>(y * photo.width + x);
            ignored[i] = 1;
            for (std::size_t c = 0; c < 3; ++c) spoiled.rgb[3 * i + c] = 1;
        }
    }
    const Comparison without = compare(spoiled, photo);
    spoiled.ignored = ignored;
    const Comparison with = compare(spoiled, photo);
    EXPECT_GT(*with.scores[0].value, 0.999);
    EXPECT_LT(*without.scores[0].value, 0.95);
    EXPECT_LT(with.compared_pixels, without.compared_pixels - 2000);
    Photo hidden = photo;
    hidden.ignored.assign(photo.coverage.size(), 1.0f);
    for (int k = 0; k < 3; ++k)
        hidden.ignored[static_cast<std::size_t>(150 * photo.width + 150 + k)] = 0;
    EXPECT_EQ(compare(hidden, photo).verdict, Verdict::refused);
}

TEST(Compare, APhotographThatIsNoPhotometryGetsScoresOfGeometry) {
    Photo photo = draw({});
    const Photo render = photo;
    photo.photometric = false;
    photo.not_photometric = "a tone curve";
    const Comparison result = compare(photo, render);
    EXPECT_TRUE(result.geometry_only);
    EXPECT_EQ(result.verdict, Verdict::match);
    for (const Score& score : result.scores) {
        const bool geometry = score.key == "cw_ssim" || score.key == "gmsd" || score.key == "nmi" ||
                              score.key == "reflex_f1" || score.key == "reflex_area_f1";
        EXPECT_EQ(score.value.has_value(), geometry) << score.key;
    }
    EXPECT_NE(scores_json(result).find("\"geometry_only\": true"), std::string::npos);
}

TEST(Compare, AMaskThatFillsThePictureDoesNoHarm) {
    const Photo render = draw(small());
    Photo photo = render;
    photo.mask.assign(static_cast<std::size_t>(photo.width * photo.height), 1.0f);
    EXPECT_EQ(compare(photo, render).verdict, Verdict::refused);
}

TEST(Compare, TinyPicturesAreRefused) {
    for (const int size : {1, 2, 7}) {
        const Photo tiny = synthetic::flat(size, size, 0.3f);
        EXPECT_EQ(compare(tiny, tiny).verdict, Verdict::refused);
        EXPECT_EQ(compare(draw(small()), tiny).verdict, Verdict::refused);
    }
}

TEST(Compare, TheSameSeedGivesTheSameBytesAndAnotherSeedAnotherNull) {
    StonePicture wrong = small();
    wrong.cell_shift = 0.1;
    const Photo photo = draw(small()), render = draw(wrong);
    CompareOptions other;
    other.seed = 2;
    const std::string first = scores_json(compare(photo, render));
    EXPECT_TRUE(first == scores_json(compare(photo, render)));
    EXPECT_FALSE(first == scores_json(compare(photo, render, other)));
}

TEST(Compare, ScaleOfTheLightDoesNotMatterForLinearPictures) {
    StonePicture wrong = small();
    wrong.cell_shift = 0.1;
    Photo photo = draw(small()), render = draw(wrong);
    photo.saturation = render.saturation = 0;
    const Comparison plain = compare(photo, render);
    for (float& v : photo.rgb) v *= 4096.0f;
    const Comparison bright = compare(photo, render);
    EXPECT_NEAR(bright.gain[1], 4096 * plain.gain[1], 4096 * 1e-6);
    EXPECT_NEAR(*score(bright, "zncc").value, *score(plain, "zncc").value, 1e-6);
    EXPECT_NEAR(*score(bright, "ssim").value, *score(plain, "ssim").value, 1e-6);
}

TEST(Compare, AStopFromProgressInterrupts) {
    const Photo photo = draw(small());
    int calls = 0;
    EXPECT_THROW(compare(photo, photo, {}, [&](double) { return ++calls < 3; }), Interrupted);
    EXPECT_EQ(calls, 3);
}

TEST(ScoresJson, HasTheKeysThatOutsidersRelyOnAndNoInfinities) {
    const Photo photo = draw(small());
    const std::string text = scores_json(compare(photo, photo), {"a \"b\"\xff.png", "r.exr", ""});
    const auto json = nlohmann::json::parse(text);
    EXPECT_EQ(json["schema"], 1);
    EXPECT_EQ(json["verdict"], "match");
    EXPECT_TRUE(json["equivalent_facet_error_deg"].is_null());
    EXPECT_TRUE(json["registration"].contains("residual_px"));
    EXPECT_TRUE(json["registration"].contains("iou"));
    EXPECT_EQ(json["gain"].size(), 3u);
    EXPECT_TRUE(json["scores"]["psnr"].is_null());
    for (const char* key : {"zncc", "ssim", "psnr", "deltaE00_mean"}) {
        EXPECT_TRUE(json["scores"].contains(key)) << key;
        EXPECT_TRUE(json["null"].contains(key)) << key;
    }
    EXPECT_TRUE(json["sensitivity"].is_array());
    EXPECT_EQ(text.find("inf"), std::string::npos);
    EXPECT_EQ(text.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace culet
