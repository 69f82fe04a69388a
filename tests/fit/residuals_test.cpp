// Checks every formula against a closed-form value on a known solid, and its slopes against central
// differences (error of order step^2 = 1e-10 for smooth formulas of size one).
#include "fit/model/residuals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "fit/model/linear.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;

constexpr double k_pi = std::numbers::pi;

Corner at(int point) {
    return {point, {-1, -1, -1}};
}
Corner crossing(int a, int b, int c) {
    return {-1, {a, b, c}};
}

Shape shape_of(const Solid& solid) {
    Shape shape;
    for (const Facet& facet : solid.facets) {
        shape.normals.push_back(facet.plane.normal);
        shape.offsets.push_back(facet.plane.offset);
    }
    shape.points = solid.vertices;
    return shape;
}

Shape retracted(const Shape& shape, const std::vector<double>& step) {
    return RowWriter(shape).parameters().retracted(shape, step);
}

// A brilliant in general position: no symmetry can hide a wrong sign.
Shape odd_shape() {
    Shape shape = shape_of(brilliant());
    const Layout layout = layout_of(shape);
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal(0, 0.03);
    std::vector<double> step(static_cast<std::size_t>(layout.size()));
    for (double& s : step) s = normal(random);
    shape = retracted(shape, step);
    shape.extras = {0.1, -0.2, 0.4};
    return shape;
}

std::shared_ptr<const Outline> outline_of(const Solid& solid) {
    auto outline = std::make_shared<Outline>();
    for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
        outline->corners.push_back(at(static_cast<int>(v)));
    }
    for (const Facet& facet : solid.facets) outline->loops.push_back(facet.corners);
    return outline;
}

void expect_slopes(const Formula& formula, const char* what) {
    const Shape shape = odd_shape();
    const Layout layout = layout_of(shape);
    std::vector<double> exact(static_cast<std::size_t>(layout.size()), 0.0);
    for (const Quantity::Slope& s : formula(shape).slopes) {
        switch (s.by) {
            case Quantity::By::normal: {
                const auto t = tangents(shape.normals[s.index]);
                exact[layout.tilt(s.index)] += glm::dot(t[0], s.slope);
                exact[layout.tilt(s.index) + 1] += glm::dot(t[1], s.slope);
                break;
            }
            case Quantity::By::offset:
                exact[layout.offset(s.index)] += s.slope.x;
                break;
            case Quantity::By::point:
                for (int k = 0; k < 3; ++k) exact[layout.point(s.index) + k] += s.slope[k];
                break;
            case Quantity::By::extra:
                exact[layout.extra(s.index)] += s.slope.x;
                break;
        }
    }
    const double h = 1e-5;
    double largest = 0;
    for (int i = 0; i < layout.size(); ++i) {
        std::vector<double> step(static_cast<std::size_t>(layout.size()), 0.0);
        step[i] = h;
        const double up = formula(retracted(shape, step)).value;
        step[i] = -h;
        const double down = formula(retracted(shape, step)).value;
        const double numeric = (up - down) / (2 * h);
        EXPECT_NEAR(exact[i], numeric, 1e-6 * (1 + std::abs(numeric))) << what << ", unknown " << i;
        largest = std::max(largest, std::abs(numeric));
    }
    EXPECT_GT(largest, 0) << what << " does not move at all";
}

TEST(Residuals, SlopesMatchDifferences) {
    const Solid solid = brilliant();
    const auto f = [&](const char* name) { return find_facet(solid, name); };
    const int c1 = f("C1"), u1 = f("U1"), p1 = f("P1"), s1 = f("S1"), l1 = f("L1"), t = f("T");
    expect_slopes(tilt_from_up(c1), "inclination of a crown facet");
    expect_slopes(tilt_from_up(p1), "inclination of a pavilion facet");
    expect_slopes(tilt_from_side(c1, 1), "inclination from above");
    expect_slopes(tilt_from_side(p1, -1), "inclination from below");
    expect_slopes(tilt_between(c1, s1), "inclination from a facet");
    expect_slopes(tilt_between(p1, t), "inclination of a pavilion facet from the table");
    expect_slopes(tilt_from_axis(c1, {f("G1"), f("G5"), f("G9"), f("G14")}), "from the axis");
    expect_slopes(tilt_from_plane(p1, {at(0), at(5), at(9), at(20), at(31)}), "from the girdle");
    expect_slopes(azimuth_error(u1, -1, 0.3), "azimuth");
    expect_slopes(azimuth_error(u1, l1, 0.3), "azimuth from a facet");
    expect_slopes(interior_angle(c1, u1), "dihedral");
    expect_slopes(extent(at(3), at(30), Vec3{0.6, 0.8, 0}), "width by points");
    expect_slopes(extent(crossing(t, c1, s1), crossing(p1, l1, f("P4")), Vec3{0.6, 0, 0.8}),
                  "width by crossings");
    expect_slopes(corner_distance(at(3), crossing(p1, l1, f("P3"))), "distance of corners");
    expect_slopes(edge_length(c1, u1, at(3), at(30)), "edge along the line of its planes");
    expect_slopes(edge_length(c1, c1, at(3), at(30)), "edge between facets of one plane");
    expect_slopes(height(c1, at(12)), "height");
    expect_slopes(corner_to_facet(c1, at(40)), "corner to facet");
    expect_slopes(corner_to_line(at(4), at(17), at(33)), "corner to line");
    expect_slopes(line_to_line(at(1), at(12), at(40), at(29)), "line to line");
    expect_slopes(spacing(t, p1, {at(0), at(1), at(2)}, {at(30), at(31), at(35)}), "spacing");
    expect_slopes(enclosed_volume(outline_of(solid)), "volume");
    expect_slopes(enclosed_area({at(0), at(7), at(30), crossing(t, c1, s1)}), "area");
    expect_slopes(mean_of({tilt_from_up(c1), tilt_from_up(s1)}), "mean");
    expect_slopes(horizontal_component(c1, 1), "horizontal component");
    expect_slopes(turned_normal(c1, f("C2"), 0.7, Vec3{0.6, 0, 0.8}), "turned normal");
    expect_slopes(turned_height({at(3), at(9), at(12)}, c1, 0.7, 0), "turned height");
    const MirrorPlane free{2, 0, 0}, fixed{-1, 1, 0.3};
    expect_slopes(mirrored_normal(c1, f("C2"), free, Vec3{0.6, 0, 0.8}), "mirrored normal");
    expect_slopes(mirrored_height({at(3), at(9)}, c1, free), "mirrored height");
    expect_slopes(mirrored_height({at(3), at(9)}, c1, fixed), "mirrored height, fixed plane");
    expect_slopes(across_mirror(c1, free), "across the mirror");
    expect_slopes(normal_difference(c1, f("P5"), -1, Vec3{0.6, 0.8, 0}), "parallel");
    expect_slopes(offset_difference(c1, f("P5"), -1), "coplanar");
    expect_slopes(point_component(3, Vec3{0, 1, 0}, 0.2), "prior");
}

// A cube of edge 2: every answer is known by hand.
class CubeReadings : public ::testing::Test {
protected:
    Solid solid_ = cube();
    Shape shape_ = shape_of(solid_);
    int facet(const char* name) const { return find_facet(solid_, name); }
    Corner vertex(double x, double y, double z) const {
        for (std::size_t v = 0; v < solid_.vertices.size(); ++v) {
            if (glm::length(solid_.vertices[v] - Vec3{x, y, z}) < 1e-12) {
                return at(static_cast<int>(v));
            }
        }
        ADD_FAILURE() << "no such corner";
        return at(0);
    }
    double value(const Formula& formula) const { return formula(shape_).value; }
};

TEST_F(CubeReadings, Angles) {
    EXPECT_NEAR(value(tilt_from_up(facet("X+"))), k_pi / 2, 1e-15);
    EXPECT_NEAR(value(tilt_from_up(facet("T"))), 0, 1e-15);
    EXPECT_NEAR(value(tilt_from_up(facet("B"))), 0, 1e-15);
    EXPECT_NEAR(value(tilt_between(facet("X+"), facet("Y+"))), k_pi / 2, 1e-15);
    EXPECT_NEAR(value(tilt_between(facet("X+"), facet("X-"))), 0, 1e-15);
    EXPECT_NEAR(value(azimuth_error(facet("Y+"), -1, 0)), k_pi / 2, 1e-15);
    EXPECT_NEAR(value(azimuth_error(facet("Y-"), -1, 0)), -k_pi / 2, 1e-15);
    EXPECT_NEAR(value(azimuth_error(facet("X-"), -1, radians(181))), -radians(1), 1e-14);
    EXPECT_NEAR(value(azimuth_error(facet("Y+"), facet("X+"), 0)), k_pi / 2, 1e-15);
    EXPECT_NEAR(value(interior_angle(facet("T"), facet("X+"))), k_pi / 2, 1e-15);
    EXPECT_NEAR(value(tilt_from_axis(facet("T"), {facet("X+"), facet("Y+")})), 0, 1e-14);
    EXPECT_NEAR(value(tilt_from_plane(facet("X+"), {vertex(1, 1, 1), vertex(1, -1, 1),
                                                    vertex(-1, -1, 1), vertex(-1, 1, 1)})),
                k_pi / 2, 1e-14);
}

TEST_F(CubeReadings, Lengths) {
    const Corner ppp = vertex(1, 1, 1), mmm = vertex(-1, -1, -1), pmp = vertex(1, -1, 1);
    EXPECT_NEAR(value(extent(ppp, mmm, {0, 0, 1})), 2, 1e-15);
    EXPECT_NEAR(value(corner_distance(ppp, mmm)), 2 * std::sqrt(3.0), 1e-15);
    EXPECT_NEAR(value(corner_distance(ppp, pmp)), 2, 1e-15);
    // The edge along z x x = y. With the facets exchanged its length is negative, and it passes
    // through zero between.
    EXPECT_NEAR(value(edge_length(facet("T"), facet("X+"), pmp, ppp)), 2, 1e-15);
    EXPECT_NEAR(value(edge_length(facet("T"), facet("X+"), ppp, pmp)), -2, 1e-15);
    EXPECT_EQ(value(edge_length(facet("T"), facet("X+"), ppp, ppp)), 0);
    EXPECT_NEAR(value(height(facet("B"), ppp)), -2, 1e-15);
    EXPECT_NEAR(value(corner_to_facet(facet("B"), ppp)), 2, 1e-15);
    EXPECT_NEAR(value(corner_to_line(mmm, ppp, pmp)), 2 * std::sqrt(2.0), 1e-15);
    // The edges T|X+ and B|Y- are skew lines, 2 apart along z.
    EXPECT_NEAR(value(line_to_line(ppp, pmp, vertex(1, -1, -1), mmm)), 2, 1e-15);
    EXPECT_NEAR(value(line_to_line(ppp, pmp, vertex(-1, 1, -1), mmm)), 2 * std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(value(spacing(facet("T"), facet("B"), {ppp, pmp}, {mmm})), 2, 1e-15);
    EXPECT_NEAR(place_of(shape_, crossing(facet("T"), facet("X-"), facet("Y+"))).x, -1, 1e-15);
}

TEST_F(CubeReadings, Volume) {
    EXPECT_NEAR(value(enclosed_volume(outline_of(solid_))), 8, 1e-14);
    EXPECT_NEAR(value(enclosed_area(
                    {vertex(1, 1, 1), vertex(-1, 1, 1), vertex(-1, -1, 1), vertex(1, -1, 1)})),
                4, 1e-14);
}

TEST_F(CubeReadings, Symmetry) {
    shape_.extras = {0, 0, 0};
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        EXPECT_NEAR(value(turned_normal(facet("X+"), facet("Y+"), k_pi / 2, axis)), 0, 1e-15);
        EXPECT_NEAR(value(mirrored_normal(facet("X+"), facet("X-"), {-1, 0, 0}, axis)), 0, 1e-15);
    }
    const std::vector<Corner> edge{vertex(1, 1, 1), vertex(1, -1, 1)};
    EXPECT_NEAR(value(turned_height(edge, facet("Y+"), k_pi / 2, 0)), 0, 1e-15);
    EXPECT_EQ(value(mirrored_height(edge, facet("X-"), {-1, 0, 0})), 0);
    EXPECT_EQ(value(across_mirror(facet("Y+"), {-1, 0, 0})), 0);
    // An axis through (0.25, 0): X+ is 0.75 from it, Y+ 1.
    shape_.extras = {0.25, 0, 0};
    EXPECT_NEAR(value(turned_height(edge, facet("Y+"), k_pi / 2, 0)), -0.25, 1e-15);
    // The mirror at x = 0.25 maps X+ (x = 1) to x = -0.5, which X- misses by half.
    EXPECT_NEAR(value(mirrored_height(edge, facet("X-"), {-1, 0, 0})), -0.5, 1e-15);
}

}  // namespace
}  // namespace culet
