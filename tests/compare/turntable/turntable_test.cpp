// Expectations: the axis and camera with which the pictures were made.

#include "compare/turntable/turntable.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>

#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"
#include "tests/compare/turned_stone.h"

namespace culet {
namespace {

Solid stone_of_width(const char* cut, double width) {
    Solid solid = make_cut(cut);
    double radius = 0;
    for (const Vec3& v : solid.vertices) radius = std::max(radius, std::hypot(v.x, v.y));
    for (Vec3& v : solid.vertices) v *= width / 2 / radius;
    for (Facet& f : solid.facets) f.plane.offset *= width / 2 / radius;
    return solid;
}

std::vector<BackLitOutline> outlines_of(const Solid& solid, int count,
                                        const synthetic::TurntableTruth& truth) {
    std::mt19937_64 random(5);
    std::vector<BackLitOutline> outlines;
    for (int i = 0; i < count; ++i)
        outlines.push_back(back_lit_outline(
            synthetic::turned_picture(solid, 2 * std::numbers::pi * i / count, truth, random)));
    return outlines;
}

synthetic::TurntableTruth small() {
    synthetic::TurntableTruth truth;
    truth.size = 320;
    truth.pixel = 0.0225;
    return truth;
}

// A straight edge blurred by a Gaussian falls to half at the edge. Noise of a hundredth of the
// light over the slope, 0.4 of the light per pixel, is 0.025 pixels for one point. A hundredth of a
// pixel is added for the steps of 8 bits and for interpolating the profile.
TEST(BackLitOutline, LiesOnTheEdges) {
    const std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, 1.5}},  {"B", {{0, 0, -1}, 1.5}},
                                         {"E", {{1, 0, 0}, 2.5}},  {"W", {{-1, 0, 0}, 2.5}},
                                         {"N", {{0, 1, 0}, 2.47}}, {"S", {{0, -1, 0}, 2.5}}};
    const synthetic::TurntableTruth truth = small();
    std::mt19937_64 random(1);
    const BackLitOutline outline = back_lit_outline(
        synthetic::turned_picture(intersect_half_spaces(planes).solid, 0, truth, random));
    ASSERT_TRUE(outline.trouble.empty()) << outline.trouble;
    EXPECT_GT(outline.contrast, 0.9);
    EXPECT_FALSE(outline.at_left || outline.at_right || outline.at_top || outline.at_bottom);
    // The side at y = 2.47, away from its ends.
    double sum = 0;
    int count = 0;
    for (const glm::dvec2& p : outline.points) {
        if (p.x < 0 || std::abs(p.y) * truth.pixel > 1.2) continue;
        sum += p.x - 2.47 / truth.pixel;
        ++count;
    }
    ASSERT_GT(count, 20);
    EXPECT_NEAR(sum / count, 0, 4 * 0.025 / std::sqrt(count) + 0.01);
}

TEST(BackLitOutline, SaysWhyThereIsNone) {
    Photo photo;
    photo.width = photo.height = 50;
    photo.rgb.assign(3 * 2500, 0);
    EXPECT_NE(back_lit_outline(photo).trouble, "");
    photo.rgb.assign(3 * 2500, 0.7f);
    EXPECT_NE(back_lit_outline(photo).trouble, "");
}

// Corners between sides of under 18 pixels keep the lens's rounding. On the diagonal of a right
// angle a blur of one pixel reaches half where Phi(x)^2 = 1/2, 0.545 pixels from both sides: 0.77
// from the corner. Most corners of a stone are flatter, or their sides longer.
TEST(Turntable, IsFoundFromOutlinesAlone) {
    const Solid solid = stone_of_width("pear", 5);
    synthetic::TurntableTruth truth = small();
    truth.axis_px = 7.3;
    truth.roll = radians(0.8);
    truth.elevation = radians(1.5);
    const Turntable found = turntable_of(outlines_of(solid, 24, truth), radians(15));
    EXPECT_NEAR(found.axis_px, truth.axis_px, 0.1);
    EXPECT_NEAR(degrees(found.roll), 0.8, 0.1);
    EXPECT_NEAR(degrees(found.elevation), 1.5, 0.15);
    EXPECT_LT(found.residual_px, 0.77);
    EXPECT_EQ(found.trouble, "");
}

// As `ls` sorts them: turn-1, turn-10, turn-11, ..., turn-2, ...
TEST(Turntable, PicturesInTheShellsOrderAreSortedByTheirNumbers) {
    std::vector<std::string> names;
    for (int i = 1; i <= 24; ++i) names.push_back("turn-" + std::to_string(i) + ".png");
    std::vector<std::string> listed = names;
    std::sort(listed.begin(), listed.end());
    std::vector<std::string> sorted;
    for (const std::size_t i : order_of_numbers(listed)) sorted.push_back(listed[i]);
    EXPECT_EQ(sorted, names);
}

// In a wrong order the outlines fit no turning stone: the message states the figure.
TEST(Turntable, SaysThatPicturesOutOfOrderContradictEachOther) {
    std::vector<BackLitOutline> outlines = outlines_of(stone_of_width("pear", 5), 24, small());
    for (std::size_t i = 3; i < 12; ++i) std::swap(outlines[i], outlines[23 - i]);
    const Turntable found = turntable_of(outlines, radians(15));
    EXPECT_GT(found.residual_px, 1);
    EXPECT_NE(found.trouble.find("contradict each other"), std::string::npos) << found.trouble;
    EXPECT_NE(found.remedy.find("from behind"), std::string::npos) << found.remedy;
}

// A ball looks the same from everywhere, so the camera's pose is not identifiable.
TEST(Turntable, SaysThatABallDoesNotTellHowTheCameraStood) {
    BackLitOutline ball;
    for (int i = 0; i < 360; ++i) {
        const double a = 2 * std::numbers::pi * i / 360;
        ball.corners.push_back({100 * std::cos(a), 100 * std::sin(a)});
    }
    ball.points = ball.corners;
    const Turntable found = turntable_of(std::vector<BackLitOutline>(24, ball), radians(15));
    EXPECT_LT(found.residual_px, 1);
    EXPECT_NE(found.trouble.find("how the camera stood"), std::string::npos) << found.trouble;
}

TEST(Turntable, NeedsOppositePictures) {
    const Solid solid = stone_of_width("round-brilliant", 5);
    std::vector<BackLitOutline> outlines = outlines_of(solid, 24, small());
    outlines.resize(10);
    EXPECT_THROW(turntable_of(outlines, radians(15)), InputError);
    outlines.resize(2);
    EXPECT_THROW(turntable_of(outlines, radians(180)), InputError);
}

// Distance beyond the nearest edge of the stone's shadow, along `direction`; negative inside. The
// shadow is convex: its edges are the planes along the line of sight through two vertices that
// leave all others on one side.
double beyond_shadow(const Solid& solid, const Vec3& direction, const Vec3& point) {
    const Vec3 right = glm::normalize(glm::cross(Vec3(0, 0, 1), direction));
    const Vec3 up = glm::cross(direction, right);
    std::vector<cv::Point2f> all, hull;
    for (const Vec3& v : solid.vertices)
        all.emplace_back(float(glm::dot(v, right)), float(glm::dot(v, up)));
    cv::convexHull(all, hull);
    return -cv::pointPolygonTest(
        hull, cv::Point2f(float(glm::dot(point, right)), float(glm::dot(point, up))), true);
}

// Noise moves a point by 0.025 pixels (above), and four times that does not occur in 2000. A corner
// flatter than 8 degrees is rounded by a tenth of a pixel. The axis is off by at most 0.1, and
// tilts by 0.1 degrees of the stone's radius, 111 pixels: 0.2.
TEST(Turntable, PlacesOutlinesAroundTheStone) {
    const Solid solid = stone_of_width("princess", 5);
    synthetic::TurntableTruth truth = small();
    truth.axis_px = -4.2;
    truth.elevation = radians(1);
    const std::vector<BackLitOutline> outlines = outlines_of(solid, 24, truth);
    const Turntable table = turntable_of(outlines, radians(15));
    int points = 0;
    for (const PlacedOutline& outline : placed(outlines, radians(15), table, truth.pixel)) {
        for (const Vec3& p : outline.points) {
            EXPECT_NEAR(beyond_shadow(solid, outline.direction, p), 0,
                        (0.1 + 0.1 + 0.1 + 0.2) * truth.pixel);
            ++points;
        }
    }
    EXPECT_GT(points, 24 * 40);
}

TEST(Turntable, NeedsAnOutlineInEveryPicture) {
    std::vector<BackLitOutline> outlines =
        outlines_of(stone_of_width("round-brilliant", 5), 4, small());
    outlines[1] = BackLitOutline{};
    outlines[1].trouble = "the picture is black";
    try {
        turntable_of(outlines, radians(90));
        FAIL() << "a picture without an outline was taken";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "picture 2: the picture is black");
    }
}

}  // namespace
}  // namespace culet
