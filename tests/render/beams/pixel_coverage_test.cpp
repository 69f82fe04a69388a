// Expectations: each pixel's square clipped by the polygon (Sutherland & Hodgman 1974, in double);
// and a tiling of the picture fills each pixel once.

#include "render/beams/pixel_coverage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>

#include "render/beams/beam_shading.h"

namespace {

using namespace culet;
using Polygon = std::vector<ScreenPoint>;

double area_of(const Polygon& p) {
    double sum = 0;
    for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++)
        sum += p[j].x * p[i].y - p[i].x * p[j].y;
    return 0.5 * sum;
}

// The part of the polygon where a x + b y + c >= 0.
Polygon clipped(const Polygon& p, double a, double b, double c) {
    Polygon kept;
    for (std::size_t i = 0, j = p.size() - 1; i < p.size(); j = i++) {
        const double here = a * p[i].x + b * p[i].y + c, before = a * p[j].x + b * p[j].y + c;
        if ((here < 0) != (before < 0)) {
            const double t = before / (before - here);
            kept.push_back({p[j].x + t * (p[i].x - p[j].x), p[j].y + t * (p[i].y - p[j].y)});
        }
        if (!(here < 0)) kept.push_back(p[i]);
    }
    return kept;
}
Polygon within_pixel(const Polygon& p, int x, int y) {
    Polygon kept = clipped(p, 1, 0, -x);
    if (!kept.empty()) kept = clipped(kept, -1, 0, x + 1);
    if (!kept.empty()) kept = clipped(kept, 0, 1, -y);
    if (!kept.empty()) kept = clipped(kept, 0, -1, y + 1);
    return kept;
}
double area_in_pixel(const Polygon& p, int x, int y) {
    const Polygon kept = within_pixel(p, x, y);
    return kept.size() < 3 ? 0 : area_of(kept);
}

// Centroid and covariances, from the polygon's triangles about its first corner.
struct Spread {
    double area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
};
Spread spread_of(const Polygon& p) {
    Spread s;
    for (std::size_t i = 2; i < p.size(); ++i) {
        const double ax = p[i - 1].x - p[0].x, ay = p[i - 1].y - p[0].y, bx = p[i].x - p[0].x,
                     by = p[i].y - p[0].y, w = 0.5 * (ax * by - bx * ay);
        s.area += w;
        s.x += w * (ax + bx) / 3;
        s.y += w * (ay + by) / 3;
        s.xx += w * (ax * ax + ax * bx + bx * bx) / 6;
        s.yy += w * (ay * ay + ay * by + by * by) / 6;
        s.xy += w * (2 * ax * ay + ax * by + bx * ay + 2 * bx * by) / 12;
    }
    s.x /= s.area;
    s.y /= s.area;
    s.xx = s.xx / s.area - s.x * s.x;
    s.xy = s.xy / s.area - s.x * s.y;
    s.yy = s.yy / s.area - s.y * s.y;
    s.x += p[0].x;
    s.y += p[0].y;
    return s;
}

// Positively oriented (from x to y): corners of a rotated ellipse.
Polygon random_polygon(std::mt19937_64& random, double cx, double cy, double rx, double ry) {
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    std::uniform_int_distribution<int> sides(3, 9);
    std::vector<double> angles(static_cast<std::size_t>(sides(random)));
    for (double& a : angles) a = angle(random);
    std::sort(angles.begin(), angles.end());
    const double turn = angle(random);
    Polygon polygon;
    for (double a : angles) {
        const double u = rx * std::cos(a), v = ry * std::sin(a);
        polygon.push_back({cx + u * std::cos(turn) - v * std::sin(turn),
                           cy + u * std::sin(turn) + v * std::cos(turn)});
    }
    return polygon;
}

// Coordinates relative to a corner of the polygon, `extent` pixels wide, are rounded to single
// precision: an area is off by a rounding unit of that per edge in the pixel, and the running sum
// of a row adds one of 1 per column.
double tolerance(double extent) {
    return 8 * 6e-8 * (extent + 2);
}

class Coverage : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override { ASSERT_TRUE(use_shading_target(GetParam())); }
    void TearDown() override { use_shading_target(shading_targets().front()); }

    static constexpr int k_width = 61, k_height = 47;
    PixelCoverage coverage_{k_width};

    void expect_exact(const Polygon& polygon, int row_begin, int row_end) {
        double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;
        for (const ScreenPoint& p : polygon) {
            low_x = std::min(low_x, p.x);
            high_x = std::max(high_x, p.x);
            low_y = std::min(low_y, p.y);
            high_y = std::max(high_y, p.y);
        }
        const double most = tolerance(std::max(high_x - low_x, high_y - low_y));
        const ScreenPoint reference{low_x, low_y};
        const CoveredPixels& covered =
            coverage_.areas(polygon.data(), polygon.size(), reference, row_begin, row_end);
        std::vector<double> found(static_cast<std::size_t>(k_width * k_height), 0.0);
        for (const PixelRun& run : covered.runs) {
            const int row = run.pixel / k_width;
            ASSERT_TRUE(row >= row_begin && row < row_end && run.count > 0);
            ASSERT_EQ((run.pixel + run.count - 1) / k_width, row) << "a run is in one row";
            ASSERT_LE(run.first + run.count, covered.count);
            for (int i = 0; i < run.count; ++i) {
                const auto at = static_cast<std::size_t>(run.first + i);
                found[static_cast<std::size_t>(run.pixel + i)] +=
                    static_cast<double>(covered.share[at]);
                const int x = (run.pixel + i) % k_width;
                ASSERT_NEAR(static_cast<double>(covered.x[at]), x + 0.5 - reference.x, 1e-5);
                ASSERT_NEAR(static_cast<double>(covered.y[at]), row + 0.5 - reference.y, 1e-5);
            }
        }
        double missed = 0;
        for (int y = row_begin; y < row_end; ++y) {
            for (int x = 0; x < k_width; ++x)
                missed =
                    std::max(missed, std::abs(found[static_cast<std::size_t>(y * k_width + x)] -
                                              area_in_pixel(polygon, x, y)));
        }
        // Shares that differ from 0 or 1 by rounding error only become 0 and 1.
        ASSERT_LE(missed, most + 4e-6)
            << polygon.size() << " corners, rows " << row_begin << ".." << row_end << ", from ("
            << polygon[0].x << ", " << polygon[0].y << ")";
    }
};

// Moments of a part are off by as much as its area, by which they are divided.
void expect_parts(const Polygon& polygon, const CoveredPixels& found, int width, double most) {
    int looked_at = 0;
    for (const PixelRun& run : found.runs) {
        for (int i = 0; i < run.count; ++i) {
            const auto at = static_cast<std::size_t>(run.first + i);
            const int x = (run.pixel + i) % width, y = run.pixel / width;
            const Polygon kept = within_pixel(polygon, x, y);
            const double area = kept.size() < 3 ? 0 : area_of(kept), off = 2 * most / area;
            if (!(area > 0) || off > 0.05) continue;
            ++looked_at;
            ASSERT_NEAR(static_cast<double>(found.share[at]), area, most);
            const Spread exact = spread_of(kept);
            const double xx = static_cast<double>(found.xx[at]),
                         yx = static_cast<double>(found.yx[at]),
                         yy = static_cast<double>(found.yy[at]);
            ASSERT_NEAR(static_cast<double>(found.x[at]), exact.x, off) << area;
            ASSERT_NEAR(static_cast<double>(found.y[at]), exact.y, off) << area;
            // Those of the square are 1/12 and 0; a mean's square is off by twice the mean.
            ASSERT_NEAR(xx * xx / 12, exact.xx, 2 * off) << area;
            ASSERT_NEAR(xx * yx / 12, exact.xy, 2 * off) << area;
            ASSERT_NEAR((yx * yx + yy * yy) / 12, exact.yy, 2 * off) << area;
            if (found.share[at] == 1) {
                ASSERT_EQ(xx, 1);
                ASSERT_EQ(yx, 0);
                ASSERT_EQ(yy, 1);
            }
        }
    }
    ASSERT_GT(looked_at, 0);
}

TEST_P(Coverage, HasTheMiddlesAndWidthsOfItsParts) {
    std::mt19937_64 random(20268);
    std::uniform_real_distribution<double> x(12, k_width - 12), y(12, k_height - 12), r(0.2, 11);
    for (int i = 0; i < 600; ++i) {
        SCOPED_TRACE("seed 20268, polygon " + std::to_string(i));
        const Polygon polygon = random_polygon(random, x(random), y(random), r(random), r(random));
        if (area_of(polygon) < 0.1) continue;
        expect_parts(polygon,
                     coverage_.areas(polygon.data(), polygon.size(), {0, 0}, 0, k_height, true),
                     k_width, tolerance(22) + 4e-6);
    }
}

TEST_P(Coverage, OfPartsWithoutWidthStaysInThePixel) {
    // A diagonal and an upright sliver, near or below the resolution of single precision.
    for (const double width : {1e-3, 1e-5, 1e-7, 1e-9}) {
        for (const Polygon& sliver : {Polygon{{3.1, 4.2}, {7.1 + width, 8.2}, {7.1, 8.2}},
                                      Polygon{{3.5, 4.2}, {3.5 + width, 4.2}, {3.5, 9.7}}}) {
            SCOPED_TRACE(width);
            const CoveredPixels& found =
                coverage_.areas(sliver.data(), sliver.size(), {0, 0}, 0, k_height, true);
            for (const PixelRun& run : found.runs) {
                for (int i = 0; i < run.count; ++i) {
                    const auto at = static_cast<std::size_t>(run.first + i);
                    EXPECT_NEAR(found.x[at], (run.pixel + i) % k_width + 0.5, 0.5);
                    EXPECT_NEAR(found.y[at], run.pixel / k_width + 0.5, 0.5);
                    EXPECT_TRUE(found.xx[at] >= 0 && found.xx[at] <= 1) << found.xx[at];
                    EXPECT_LE(std::abs(found.yx[at]), 1) << found.yx[at];
                    EXPECT_TRUE(found.yy[at] >= 0 && found.yy[at] <= 1) << found.yy[at];
                }
            }
        }
    }
}

TEST_P(Coverage, OfRandomPolygonsIsWhatClippingSays) {
    std::mt19937_64 random(20261);
    std::uniform_real_distribution<double> x(12, k_width - 12), y(12, k_height - 12), r(0.05, 11);
    for (int i = 0; i < 1500; ++i) {
        SCOPED_TRACE("seed 20261, polygon " + std::to_string(i));
        expect_exact(random_polygon(random, x(random), y(random), r(random), r(random)), 0,
                     k_height);
    }
}

TEST_P(Coverage, OfSliversIsWhatClippingSays) {
    std::mt19937_64 random(20262);
    std::uniform_real_distribution<double> x(24, k_width - 24), y(23, k_height - 23), r(0.1, 23),
        power(-12, -1);
    for (int i = 0; i < 1500; ++i) {
        SCOPED_TRACE("seed 20262, polygon " + std::to_string(i));
        expect_exact(
            random_polygon(random, x(random), y(random), r(random), std::pow(10, power(random))), 0,
            k_height);
    }
}

TEST_P(Coverage, OfPolygonsSmallerThanAPixelIsWhatClippingSays) {
    std::mt19937_64 random(20263);
    std::uniform_real_distribution<double> x(2, k_width - 2), y(2, k_height - 2), power(-9, 0);
    for (int i = 0; i < 1500; ++i) {
        SCOPED_TRACE("seed 20263, polygon " + std::to_string(i));
        const double r = std::pow(10, power(random));
        expect_exact(random_polygon(random, x(random), y(random), r, r), 0, k_height);
    }
}

TEST_P(Coverage, WithCornersOnPixelBordersIsWhatClippingSays) {
    std::mt19937_64 random(20264);
    std::uniform_real_distribution<double> x(12, k_width - 12), y(12, k_height - 12), r(0.5, 11);
    for (int i = 0; i < 1500; ++i) {
        SCOPED_TRACE("seed 20264, polygon " + std::to_string(i));
        Polygon polygon = random_polygon(random, x(random), y(random), r(random), r(random));
        // Halves: borders and centres. Rounding may make a polygon concave; clipping still gives
        // its areas unless it intersects itself.
        for (ScreenPoint& p : polygon) {
            p.x = std::round(2 * p.x) / 2;
            if (i % 2 == 0) p.y = std::round(2 * p.y) / 2;
        }
        if (polygon.size() > 3) polygon.resize(3);
        if (area_of(polygon) <= 0) continue;
        expect_exact(polygon, 0, k_height);
    }
}

TEST_P(Coverage, OfSomeRowsIsThatOfTheWhole) {
    std::mt19937_64 random(20265);
    std::uniform_real_distribution<double> x(20, k_width - 20), y(0, k_height), r(0.5, 19);
    std::uniform_int_distribution<int> row(0, k_height - 1);
    for (int i = 0; i < 1500; ++i) {
        SCOPED_TRACE("seed 20265, polygon " + std::to_string(i));
        const int a = row(random), b = row(random);
        expect_exact(random_polygon(random, x(random), y(random), r(random), r(random)),
                     std::min(a, b), std::max(a, b) + 1);
    }
}

// Regions end at the picture's borders, like beams.
TEST_P(Coverage, AtThePicturesBordersIsWhatClippingSays) {
    std::mt19937_64 random(20266);
    std::uniform_real_distribution<double> x(-5, k_width + 5), y(-5, k_height + 5), r(0.5, 19);
    for (int i = 0; i < 1500; ++i) {
        SCOPED_TRACE("seed 20266, polygon " + std::to_string(i));
        Polygon polygon = random_polygon(random, x(random), y(random), r(random), r(random));
        polygon = clipped(polygon, 1, 0, 0);
        if (!polygon.empty()) polygon = clipped(polygon, -1, 0, k_width);
        if (!polygon.empty()) polygon = clipped(polygon, 0, 1, 0);
        if (!polygon.empty()) polygon = clipped(polygon, 0, -1, k_height);
        if (polygon.size() < 3) continue;
        expect_exact(polygon, 0, k_height);
    }
}

TEST_P(Coverage, NearTheBorderIsWithinTheMargin) {
    std::mt19937_64 random(20269);
    std::uniform_real_distribution<double> x(12, k_width - 12), y(12, k_height - 12), r(0.5, 20),
        margin(0, 3);
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE("seed 20269, polygon " + std::to_string(i));
        Polygon polygon = random_polygon(random, x(random), y(random), r(random), r(random));
        polygon = clipped(polygon, 1, 0, 0);
        if (!polygon.empty()) polygon = clipped(polygon, -1, 0, k_width);
        if (polygon.size() < 3) continue;
        if (i % 5 == 0) {
            // A horizontal side on a row of pixel centres.
            polygon = clipped(polygon, 0, 1, -(std::floor(polygon[0].y) - 2.5));
            if (polygon.size() < 3) continue;
        }
        const double m = margin(random);
        const auto collected = [&](double by) {
            const CoveredPixels& found =
                coverage_.middles(polygon.data(), polygon.size(), {0, 0}, 0, k_height, by);
            std::vector<std::pair<int, bool>> pixels;
            for (const PixelRun& run : found.runs) {
                for (int k = 0; k < run.count; ++k)
                    pixels.push_back({run.pixel + k, run.first + k < found.near_border});
            }
            std::sort(pixels.begin(), pixels.end());
            return pixels;
        };
        const auto all = collected(std::numeric_limits<double>::infinity()), split = collected(m);
        ASSERT_EQ(split.size(), all.size());
        for (std::size_t k = 0; k < all.size(); ++k) {
            ASSERT_EQ(split[k].first, all[k].first);
            ASSERT_TRUE(all[k].second);
            const double px = all[k].first % k_width + 0.5, py = all[k].first / k_width + 0.5;
            double nearest = 1e9;
            for (std::size_t b = 0, a = polygon.size() - 1; b < polygon.size(); a = b++) {
                const double dx = polygon[b].x - polygon[a].x, dy = polygon[b].y - polygon[a].y,
                             length = std::hypot(dx, dy);
                if (length < 1e-9) continue;
                nearest = std::min(nearest,
                                   (dx * (py - polygon[a].y) - dy * (px - polygon[a].x)) / length);
            }
            // Up to a rounding unit, a centre is either near the border or not.
            if (std::abs(nearest - m) > 1e-9) {
                ASSERT_EQ(split[k].second, nearest < m);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(OnEach, Coverage, testing::ValuesIn(shading_targets()),
                         [](const auto& target) { return target.param; });

// The picture cut by lines, each cell by each line in turn. Both sides use the same evaluation of
// the line and the same crossings.
std::vector<Polygon> subdivision(double width, double height,
                                 const std::vector<std::array<double, 3>>& lines) {
    std::vector<Polygon> cells{{{0, 0}, {width, 0}, {width, height}, {0, height}}};
    for (const auto& [a, b, c] : lines) {
        std::vector<Polygon> next;
        for (const Polygon& cell : cells) {
            for (const double sign : {1.0, -1.0}) {
                Polygon part = clipped(cell, sign * a, sign * b, sign * c);
                if (part.size() > 2 && area_of(part) > 0) next.push_back(std::move(part));
            }
        }
        cells = std::move(next);
    }
    return cells;
}

void expect_tiling(const std::vector<Polygon>& cells, int width, int height, bool exact_middles) {
    PixelCoverage coverage(width);
    std::vector<double> sums(static_cast<std::size_t>(width * height), 0.0);
    std::vector<int> taken(sums.size(), 0);
    for (const Polygon& cell : cells) {
        const CoveredPixels& areas = coverage.areas(cell.data(), cell.size(), {0, 0}, 0, height);
        for (const PixelRun& run : areas.runs) {
            for (int i = 0; i < run.count; ++i)
                sums[static_cast<std::size_t>(run.pixel + i)] +=
                    static_cast<double>(areas.share[static_cast<std::size_t>(run.first + i)]);
        }
        const CoveredPixels& middles =
            coverage.middles(cell.data(), cell.size(), {0, 0}, 0, height);
        for (const PixelRun& run : middles.runs) {
            for (int i = 0; i < run.count; ++i) ++taken[static_cast<std::size_t>(run.pixel + i)];
        }
    }
    const double most =
        tolerance(width) * static_cast<double>(std::min<std::size_t>(cells.size(), 20));
    int none = 0, many = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        EXPECT_NEAR(sums[i], 1, most) << "pixel " << i;
        none += taken[i] == 0;
        many += taken[i] > 1;
    }
    if (exact_middles) {
        EXPECT_EQ(none, 0) << "middles that no cell takes, of " << cells.size() << " cells";
        EXPECT_EQ(many, 0) << "middles that several cells take, of " << cells.size() << " cells";
    }
}

TEST(Tiling, ByRandomLinesFillsEachPixelOnce) {
    std::mt19937_64 random(20267);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> x(0, 40), y(0, 31);
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE("seed 20267, subdivision " + std::to_string(i));
        std::vector<std::array<double, 3>> lines;
        for (int j = 0; j < 14; ++j) {
            const double a = normal(random), b = normal(random);
            lines.push_back({a, b, -a * x(random) - b * y(random)});
        }
        expect_tiling(subdivision(40, 31, lines), 40, 31, true);
    }
}

// Vertical, horizontal and diagonal lines through pixel centres, as in an odd-sized picture of a
// symmetric stone: crossings and centres are exact in double.
TEST(Tiling, ByLinesThroughPixelMiddlesTakesEachMiddleOnce) {
    const double m = 20.5;
    std::vector<std::array<double, 3>> lines{{1, 0, -m}, {0, 1, -m}, {1, -1, 0}, {1, 1, -2 * m}};
    for (int k = 1; k < 6; ++k) {
        lines.push_back({1, 0, -(m + 2 * k)});
        lines.push_back({0, 1, -(m - 3 * k)});
        lines.push_back({1, -1, 2.0 * k});
    }
    expect_tiling(subdivision(41, 41, lines), 41, 41, true);
}

TEST(Tiling, OfNoAreaTakesNothing) {
    PixelCoverage coverage(20);
    const Polygon point{{3.5, 3.5}, {3.5, 3.5}, {3.5, 3.5}}, level{{1, 4.5}, {9, 4.5}, {4, 4.5}};
    for (const Polygon& p : {point, level}) {
        EXPECT_EQ(coverage.middles(p.data(), p.size(), {0, 0}, 0, 20).count, 0);
        EXPECT_EQ(coverage.areas(p.data(), p.size(), {0, 0}, 0, 20).count, 0);
    }
}

}  // namespace
