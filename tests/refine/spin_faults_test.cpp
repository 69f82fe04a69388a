// Series that are not one even turn of a still stone. Expectations: what was done to the frames.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "refine/spin/spin.h"
#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "tests/fit/test_stones.h"
#include "tests/refine/lit_stone.h"
#include "tests/refine/spin_frames.h"

namespace culet {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

// A small step cut on bare ground.
synthetic::SpinTruth small_stone(int frames) {
    synthetic::SpinTruth truth = synthetic::lying(test::off_standard(make_cut("step"), 0.3, 0, 3),
                                                  130, radians(45), frames, 5);
    truth.size = 220;
    truth.specks = 0;
    return truth;
}

cv::Mat view_of(LevelPicture& picture) {
    return cv::Mat(picture.height, picture.width, CV_8UC3, picture.rgb.data());
}

// The wobble that was drawn, 0.2 degrees, and as much again for outlines of small pictures; the
// first frame's 1.3 degrees are its own.
void expect_turns(const SpinResult& found, const synthetic::SpinTruth& truth) {
    double mean = 0, squares = 0;
    const double count = double(found.frames.size());
    for (std::size_t f = 0; f < found.frames.size(); ++f)
        mean += (*found.frames[f].turn - truth.series.turns[f]) / count;
    for (std::size_t f = 0; f < found.frames.size(); ++f)
        squares += std::pow(*found.frames[f].turn - truth.series.turns[f] - mean, 2) / count;
    EXPECT_LT(degrees(std::sqrt(squares)), 0.5);
    EXPECT_NEAR(degrees(found.camera.elevation), 45, 1);
}

// Frame 10 is missing, frame 20 was taken twice.
TEST(SpinFaults, FindsStepsThatAreMissingOrDoubled) {
    synthetic::SpinTruth truth = small_stone(32);
    std::vector<double>& turns = truth.series.turns;
    turns.insert(turns.begin() + 20, turns[19]);
    turns.erase(turns.begin() + 9);
    const SpinResult found = spin(synthetic::frames_of(truth));
    EXPECT_EQ(found.trouble, "");
    EXPECT_THAT(found.notes, testing::ElementsAre(
                                 HasSubstr("missing between frame-009.png and frame-010.png"),
                                 HasSubstr("did not turn on between frame-019.png and frame-020")));
    expect_turns(found, truth);
}

// 32 frames over 345 degrees.
TEST(SpinFaults, FindsATurnThatDoesNotClose) {
    synthetic::SpinTruth truth = small_stone(32);
    for (double& turn : truth.series.turns) turn *= 345.0 / 360;
    const SpinResult found = spin(synthetic::frames_of(truth));
    EXPECT_EQ(found.trouble, "");
    EXPECT_THAT(found.notes, Contains(HasSubstr("the steps are 10.7")));
    expect_turns(found, truth);
}

// From frame 15 on the stone lies 8 pixels further.
TEST(SpinFaults, SaysWhereTheStoneSlipped) {
    synthetic::SpinTruth truth = small_stone(32);
    std::vector<SpinFrame> frames = synthetic::frames_of(truth);
    for (Vec3& v : truth.solid.vertices) v += Vec3(6, -5, 0);
    for (Facet& f : truth.solid.facets) f.plane.offset += glm::dot(f.plane.normal, Vec3(6, -5, 0));
    const std::vector<SpinFrame> behind = synthetic::frames_of(truth);
    std::copy(behind.begin() + 14, behind.end(), frames.begin() + 14);
    const SpinResult found = spin(frames);
    EXPECT_THAT(found.trouble, HasSubstr("slipped on the turntable between frame-014.png and "
                                         "frame-015.png"));
    EXPECT_THAT(found.remedy, HasSubstr("--step 11.2"));
}

// Half a pixel on each side of the width.
TEST(SpinFaults, JpegOfLowQualityLeavesTheStone) {
    const synthetic::SpinTruth truth = small_stone(32);
    std::vector<SpinFrame> frames = synthetic::frames_of(truth);
    for (SpinFrame& frame : frames) synthetic::compress(frame.picture, 60);
    const SpinResult found = spin(frames);
    EXPECT_EQ(found.trouble, "");
    EXPECT_THAT(found.notes, IsEmpty());
    expect_turns(found, truth);
}

// It lies on the turntable, beside the stone and below it.
TEST(SpinFaults, AHairOnTheGroundIsNoStone) {
    const synthetic::SpinTruth truth = small_stone(32);
    std::vector<SpinFrame> frames = synthetic::frames_of(truth);
    double depth = 0;
    for (const Vec3& v : truth.solid.vertices) depth = std::max(depth, -v.z);
    for (std::size_t f = 0; f < frames.size(); ++f) {
        cv::Mat picture = view_of(frames[f].picture);
        const PictureAxes at = picture_axes(truth.series.camera, truth.series.turns[f]);
        std::vector<cv::Point> hair;
        for (double t = -1; t <= 1; t += 0.05) {
            const Vec3 place(60 + 12 * t * t, 70 * t, -depth);
            const double near = 1 - glm::dot(at.nearing, place);
            const double u = truth.size / 2.0 + at.dx + glm::dot(at.across, place) / near,
                         v = truth.size / 2.0 - at.dy - glm::dot(at.along, place) / near;
            hair.emplace_back(int(std::lround(16 * (u - 0.5))), int(std::lround(16 * (v - 0.5))));
        }
        cv::Mat with = picture.clone();
        cv::polylines(with, hair, false, cv::Scalar::all(70), 1, cv::LINE_AA, 4);
        // The stone is before it.
        std::vector<cv::Point> outline;
        for (const glm::dvec2& c :
             outline_in_picture(truth.solid.vertices, truth.series.camera, truth.series.turns[f]))
            outline.emplace_back(int(std::lround(truth.size / 2.0 + c.x)),
                                 int(std::lround(truth.size / 2.0 - c.y)));
        cv::Mat mask(picture.size(), CV_8U, cv::Scalar(255));
        cv::fillConvexPoly(mask, outline, cv::Scalar(0));
        with.copyTo(picture, mask);
    }
    const SpinResult found = spin(frames);
    EXPECT_EQ(found.trouble, "");
    expect_turns(found, truth);
}

// A program made white what it took for ground: the outline is torn by two pixels or so.
TEST(SpinFaults, DoubtsStonesThatWereCutOut) {
    const synthetic::SpinTruth truth = small_stone(32);
    std::vector<SpinFrame> frames = synthetic::frames_of(truth);
    std::mt19937_64 random(2);
    std::normal_distribution<double> torn(0, 2);
    for (std::size_t f = 0; f < frames.size(); ++f) {
        std::vector<cv::Point> outline;
        const auto corners =
            outline_in_picture(truth.solid.vertices, truth.series.camera, truth.series.turns[f]);
        for (const glm::dvec2& c : places_along(corners))
            outline.emplace_back(int(std::lround(truth.size / 2.0 + c.x + torn(random))),
                                 int(std::lround(truth.size / 2.0 - c.y + torn(random))));
        cv::Mat mask(truth.size, truth.size, CV_8U, cv::Scalar(255));
        cv::fillPoly(mask, std::vector{outline}, cv::Scalar(0));
        view_of(frames[f].picture).setTo(cv::Scalar::all(255), mask);
    }
    EXPECT_THAT(spin(frames).trouble, HasSubstr("cut out"));
}

// A convex stone with a point.
TEST(SpinFaults, APearIsAStone) {
    synthetic::SpinTruth truth = synthetic::lying(make_cut("pear"), 150, radians(45), 24, 5);
    truth.size = 240;
    truth.specks = 0;
    const SpinResult pear = spin(synthetic::frames_of(truth));
    EXPECT_THAT(pear.notes, IsEmpty());
    EXPECT_EQ(pear.trouble, "");
    expect_turns(pear, truth);
}

}  // namespace
}  // namespace culet
