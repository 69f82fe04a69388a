// A stone from simulated frames of a turntable. Expectations: the stone, turns and camera with
// which the frames were drawn.

#include "refine/spin/spin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>

#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"
#include "stone/solid/caliper.h"
#include "stone/text/errors.h"
#include "tests/refine/spin_frames.h"

namespace culet {
namespace {

constexpr std::size_t k_held_out = 11;

struct SpinSeries {
    synthetic::SpinTruth truth = synthetic::lying_step_cut(64);
    std::vector<SpinFrame> frames = synthetic::frames_of(truth);
    SpinResult found;

    SpinSeries() {
        frames[k_held_out].held_out = true;
        found = spin(frames);
    }

    // Directions of the found stone as the turntable has them: the camera's axes of one frame, as
    // its projection has them, stand for the true ones.
    Vec3 on_turntable(const Vec3& v) const {
        const auto& p = found.frames[0].projection;
        const PictureAxes at = picture_axes(truth.series.camera, truth.series.turns[0]);
        const Vec3 row0(p[0][0], p[0][1], p[0][2]), row1(p[1][0], p[1][1], p[1][2]),
            row2(p[2][0], p[2][1], p[2][2]);
        const Vec3 across = glm::normalize(row0 - p[0][3] * row2),
                   along = glm::normalize(p[1][3] * row2 - row1);
        return glm::dot(v, across) * at.across + glm::dot(v, along) * at.along +
               glm::dot(v, glm::cross(across, along)) * glm::cross(at.across, at.along);
    }
};

double mean_turn_error(const SpinResult& found, const synthetic::SpinTruth& truth) {
    double sum = 0;  // which turn is 0, is not seen
    for (std::size_t f = 0; f < found.frames.size(); ++f)
        sum += *found.frames[f].turn - truth.series.turns[f];
    return sum / double(found.frames.size());
}

// Dust tells a turn to 0.03 degrees, `k_ground_turn_sigma`, and the camera to `k_ground_sigmas`:
// twice (root mean square) and three times that.
void expect_turns_and_camera_of_the_ground(const SpinSeries& series) {
    EXPECT_EQ(series.found.trouble, "");
    EXPECT_GT(series.found.ground_agreement, 0.5);
    EXPECT_NEAR(degrees(series.found.camera.elevation), 48, 0.15);
    EXPECT_NEAR(degrees(series.found.camera.roll), 0.4, 0.15);
    EXPECT_NEAR(series.found.camera.axis, 2.3, 0.3);
    const double mean = mean_turn_error(series.found, series.truth);
    double squares = 0;
    for (std::size_t f = 0; f < series.frames.size(); ++f) {
        const double off =
            degrees(*series.found.frames[f].turn - series.truth.series.turns[f] - mean);
        EXPECT_NEAR(off, 0, 0.3) << f;
        squares += off * off;
        EXPECT_EQ(series.found.frames[f].used, f != k_held_out);
    }
    EXPECT_LT(std::sqrt(squares / double(series.frames.size())), 0.06);
}

// Each side of an outline is off by about 0.25 pixels as a whole, since bright facets look larger
// than dark ones. As far as 14 points of a side are off together, a turn is sqrt(14) times less
// sure than 140 points alone would make it. Twice that.
TEST(Spin, TurnsAreThoseOfTheOutlinesOnBareGround) {
    synthetic::SpinTruth truth = synthetic::lying_step_cut(24);
    truth.specks = 0;
    const SpinResult found = spin(synthetic::frames_of(truth));
    EXPECT_EQ(found.trouble, "");
    double squares = 0, expected = 0;
    const double mean = mean_turn_error(found, truth);
    for (std::size_t f = 0; f < found.frames.size(); ++f) {
        const double turn = truth.series.turns[f];
        squares += std::pow(*found.frames[f].turn - turn - mean, 2) / 24;
        PicturePoints points;
        const PicturePoints corners =
            outline_in_picture(truth.solid.vertices, truth.series.camera, turn);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const glm::dvec2 &begin = corners[k], &end = corners[(k + 1) % corners.size()];
            for (double at = 1.5; at < glm::distance(begin, end); at += 3)
                points.push_back(begin + at * glm::normalize(end - begin));
        }
        expected +=
            fitted_turn(truth.solid.vertices, truth.series.camera, turn, points, 0.25).sigma / 24;
    }
    EXPECT_LT(std::sqrt(squares), 2 * std::sqrt(14.0) * expected);
    EXPECT_NEAR(degrees(found.camera.elevation), 48, 1);
}

// Within three times the sigma that the result itself gives. The blur of a side of 20 pixels shifts
// it by 0.25 pixels at one end and not at the other: 0.25 / 20, 0.7 degrees, twice.
void expect_facets_seen_edge_on(const SpinSeries& series) {
    int seen = 0;
    for (const Facet& facet : series.truth.solid.facets) {
        const double up = degrees(std::asin(facet.plane.normal.z));
        if (std::abs(up) > 0.9 * (90 - 48) || narrow_width(series.truth.solid, facet) < 20)
            continue;
        ++seen;
        double nearest = 180, sigma = 0;
        for (std::size_t f = 0; f < series.found.solid.facets.size(); ++f) {
            const double angle = degrees(
                angle_between(series.on_turntable(series.found.solid.facets[f].plane.normal),
                              facet.plane.normal));
            if (!(angle < nearest)) continue;
            nearest = angle;
            sigma = degrees(series.found.tilt_sigmas[f]);
        }
        EXPECT_LT(nearest, 3 * sigma) << facet.name;
        EXPECT_LT(nearest, 1.4) << facet.name;
    }
    EXPECT_GE(seen, 8);
}

// The corners of the true outline, of the frame left out, too, lie by the found stone's outline as
// its projection gives it: within a pixel (root mean square), as small facets that are not found
// cut off corners. Half of all edges are within half a pixel of the stone with its crown: the blur
// of a bright facet is wider.
void expect_outlines_from_projections(const SpinSeries& series) {
    std::vector<double> medians;
    for (std::size_t f = 0; f < series.frames.size(); ++f) {
        const auto& p = series.found.frames[f].projection;
        std::vector<cv::Point2f> mine, hull;
        for (const Vec3& v : series.found.solid.vertices) {
            const auto row = [&](std::size_t i) {
                return p[i][0] * v.x + p[i][1] * v.y + p[i][2] * v.z + p[i][3];
            };
            mine.emplace_back(float(row(0) / row(2)), float(row(1) / row(2)));
        }
        cv::convexHull(mine, hull);
        double squares = 0;
        const PicturePoints corners = outline_in_picture(
            series.truth.solid.vertices, series.truth.series.camera, series.truth.series.turns[f]);
        for (const glm::dvec2& c : corners) {
            const cv::Point2f corner(float(series.truth.size / 2.0 + c.x),
                                     float(series.truth.size / 2.0 - c.y));
            squares += std::pow(cv::pointPolygonTest(hull, corner, true), 2);
        }
        EXPECT_LT(std::sqrt(squares / double(corners.size())), 1) << f;
        medians.push_back(series.found.frames[f].median_px);
    }
    EXPECT_LT(upper_median(medians), 0.5);
}

// No outline shows the table: its edges move as it does. Four times its own sigma and that of the
// camera's elevation; its width three times its sigma and that of the stone's width, half a pixel
// on both sides.
void expect_table(const SpinSeries& series) {
    const int mine = find_facet(series.found.solid, "T");
    ASSERT_GE(mine, 0);
    const Facet& table = series.truth.solid.facets[0];
    ASSERT_EQ(table.name, "T");
    const double off = degrees(angle_between(
        series.on_turntable(series.found.solid.facets[std::size_t(mine)].plane.normal),
        table.plane.normal));
    EXPECT_LT(off, 4 * std::hypot(degrees(series.found.tilt_sigmas[std::size_t(mine)]), 0.05));
    double least = HUGE_VAL, most = -HUGE_VAL;
    const Vec3 across = series.on_turntable({1, 0, 0});
    for (const int c : table.corners) {
        const double x = glm::dot(across, series.truth.solid.vertices[std::size_t(c)]);
        least = std::min(least, x);
        most = std::max(most, x);
    }
    const double width = width_along(series.truth.solid, across);
    const SpinProportion* part = proportion(series.found.proportions, "table_pct");
    ASSERT_TRUE(part);
    EXPECT_NEAR(part->value, 100 * (most - least) / width,
                3 * std::hypot(part->sigma, 100 / width));
}

// Within three times their sigmas, if they were read; else by half a turn: its facets are off by
// 0.3 degrees, which moves edges of flat facets by up to 1 % of the width.
void expect_proportions(const SpinSeries& series) {
    const Solid& solid = series.truth.solid;
    const CaliperWidths calipers = caliper_widths(solid, solid.facets[0].plane.normal);
    const std::pair<const char*, double> expected[] = {
        {"width", calipers.least},
        {"length_to_width", calipers.length / calipers.least},
        {"depth_pct", 100 * width_along(solid, solid.facets[0].plane.normal) / calipers.least}};
    for (const auto& [name, value] : expected) {
        const SpinProportion* found = proportion(series.found.proportions, name);
        ASSERT_TRUE(found) << name;
        EXPECT_NEAR(found->value, value,
                    found->read ? 3 * found->sigma : std::max(3 * found->sigma, 0.01 * value))
            << name;
    }
}

TEST(Spin, FindsTheStoneWithWhichFramesWereDrawn) {
    const SpinSeries series;
    expect_turns_and_camera_of_the_ground(series);
    expect_facets_seen_edge_on(series);
    expect_outlines_from_projections(series);
    expect_table(series);
    expect_proportions(series);
}

// The same bytes from any number of threads.
TEST(Spin, DoesNotDependOnThreads) {
    const auto frames = synthetic::frames_of(synthetic::lying_step_cut(8));
    const SpinResult all = spin(frames), one = spin(frames, {0, {}, 1});
    ASSERT_EQ(one.solid.vertices.size(), all.solid.vertices.size());
    for (std::size_t i = 0; i < one.solid.vertices.size(); ++i)
        EXPECT_EQ(one.solid.vertices[i], all.solid.vertices[i]);
}

TEST(Spin, SaysWhichFrameShowsNoStone) {
    SpinFrame empty;
    empty.name = "empty.png";
    empty.picture = {60, 60, std::vector<std::uint8_t>(3 * 60 * 60, 190)};
    try {
        spin(std::vector<SpinFrame>(10, empty));
        FAIL() << "an empty ground was taken for a stone";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("empty.png"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace culet
