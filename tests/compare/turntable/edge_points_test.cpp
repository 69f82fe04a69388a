// Expectations: the places at which edges are drawn.

#include "compare/turntable/edge_points.h"

#include <gtest/gtest.h>

#include <cmath>

namespace culet {
namespace {

constexpr int k_columns = 120;

// Levels by place, from the picture's middle, x to the right, y up.
template <class Level>
LevelPicture picture_of(const Level& level) {
    LevelPicture picture{k_columns, k_columns, {}};
    for (int y = 0; y < k_columns; ++y) {
        for (int x = 0; x < k_columns; ++x) {
            const double value = level(x - (k_columns - 1) / 2.0, (k_columns - 1) / 2.0 - y);
            picture.rgb.insert(picture.rgb.end(), 3, std::uint8_t(std::lround(value)));
        }
    }
    return picture;
}

// 0 far below, 1 far above, blurred by 0.7 pixels.
double step(double t) {
    return 0.5 * std::erfc(-t / (0.7 * std::sqrt(2.0)));
}

const std::vector<glm::dvec2> k_square{{-30, -30}, {30, -30}, {30, 30}, {-30, 30}};

// Of the points on the right side, away from corners.
double mean_at_right(const std::vector<glm::dvec2>& points) {
    double sum = 0;
    int count = 0;
    for (const glm::dvec2& p : points) {
        if (p.x < 20 || std::abs(p.y) > 20) continue;
        sum += p.x;
        ++count;
    }
    EXPECT_GT(count, 10);
    return sum / count;
}

// The level of a light, both 0 to 255: lenses blur light, not levels.
double level_of(double light) {
    return 255 * std::pow(light / 255, 1 / 2.2);
}

// Rounding to whole levels moves a place by 0.3 levels over the slope of 57 levels a pixel.
TEST(EdgePoints, LieOnABlurredEdge) {
    const LevelPicture picture =
        picture_of([](double x, double) { return level_of(200 - 100 * step(30.37 - x)); });
    EXPECT_NEAR(mean_at_right(edge_points(picture, k_square, 4)), 30.37, 0.02);
}

// A sharpened edge has a bright line 1.7 pixels outside, whose outer flank is less than half as
// steep as the edge.
TEST(EdgePoints, LieInsideOfAHalo) {
    const LevelPicture picture = picture_of([](double x, double) {
        return level_of(200 - 150 * step(29.6 - x) + 20 * (step(31.8 - x) - step(29.8 - x)));
    });
    EXPECT_NEAR(mean_at_right(edge_points(picture, k_square, 4)), 29.6, 0.2);
}

// The ground's own soft shadow, 2 levels a pixel, is no edge; nor is what lies beyond the reach.
TEST(EdgePoints, AreNotFoundInASoftShadowOrOutOfReach) {
    EXPECT_TRUE(
        edge_points(picture_of([](double x, double) { return 128 + 2 * x; }), k_square, 4).empty());
    const LevelPicture far = picture_of(
        [](double x, double y) { return std::max(std::abs(x), std::abs(y)) < 40 ? 50 : 200; });
    EXPECT_TRUE(edge_points(far, k_square, 4).empty());
}

// A square with bright stripes, a soft shadow beside it, grains of two levels on the ground. Edges
// spread by the blur and by opening and closing: two pixels.
TEST(CoarseOutline, IsThatOfTheSharpObject) {
    const LevelPicture picture = picture_of([](double x, double y) {
        const bool inside = std::abs(x) < 30 && std::abs(y) < 30;
        if (inside) return std::lround(x + 100) % 20 < 10 ? 40.0 : 230.0;
        return 190 - 40 * std::exp(-(x * x + (y + 30) * (y + 30)) / 2000) +
               (std::lround(3 * x + 5 * y) % 2 == 0 ? 1 : -1);
    });
    const CoarseOutline outline = coarse_outline(picture);
    ASSERT_EQ(outline.trouble, "");
    for (const glm::dvec2& c : outline.corners)
        EXPECT_NEAR(std::max(std::abs(c.x), std::abs(c.y)), 30, 2.5);
}

TEST(CoarseOutline, SaysWhyThereIsNone) {
    EXPECT_NE(coarse_outline(picture_of([](double, double) { return 190.0; })).trouble, "");
    const CoarseOutline cut_off =
        coarse_outline(picture_of([](double x, double) { return x > 20 ? 40.0 : 190.0; }));
    EXPECT_NE(cut_off.trouble, "");
}

}  // namespace
}  // namespace culet
