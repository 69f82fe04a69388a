// Expectations: ConvexBody where the solid is convex; exact rational clipping; integral geometry
// (Cauchy, Crofton); solid angles; and the hand for small solids. Seeds are fixed and printed.

#include "render/polyhedron_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <thread>

#include "stone/errors.h"
#include "tests/render/carved_solids.h"

namespace {

using namespace culet;
using namespace culet::carved;

const double k_pi = std::acos(-1);

struct Ray {
    Vec3 origin, direction;
};

Vec3 middle_of(const Solid& solid) {
    Vec3 low = solid.vertices[0], high = low;
    for (const Vec3& v : solid.vertices) {
        low = glm::min(low, v);
        high = glm::max(high, v);
    }
    return 0.5 * (low + high);
}

// From outside towards a random point near the solid.
Ray random_ray(const Solid& solid, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    const double size = diameter(solid);
    const Vec3 middle = middle_of(solid);
    const Vec3 to = middle + size * Vec3{uniform(random), uniform(random), uniform(random)};
    const Vec3 from = middle + 2 * size * random_direction(random);
    return {from, glm::normalize(to - from)};
}

// The solid angle of the stone's surface over 4 pi (van Oosterom & Strackee 1983): 1 inside.
double winding_of(const Solid& solid, const Vec3& point) {
    double sum = 0;
    for (const Facet& facet : solid.facets) {
        const auto arm = [&](std::size_t i) {
            return solid.vertices[static_cast<std::size_t>(facet.corners[i])] - point;
        };
        const Vec3 a = arm(0);
        for (std::size_t i = 1; i + 1 < facet.corners.size(); ++i) {
            const Vec3 b = arm(i), c = arm(i + 1);
            const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
            sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                                  la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la +
                                      glm::dot(c, a) * lb);
        }
    }
    return sum / (4 * k_pi);
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 edge = b - a;
    const double part = std::clamp(glm::dot(p - a, edge) / glm::dot(edge, edge), 0.0, 1.0);
    return glm::length(p - a - part * edge);
}

// How far a point is from a facet: 0 within its outline.
double distance_to_facet(const Solid& solid, int index, const Vec3& point) {
    const Facet& facet = solid.facets[static_cast<std::size_t>(index)];
    const double height = height_above(facet.plane, point);
    const Vec3 foot = point - height * facet.plane.normal;
    double angle = 0, nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < facet.corners.size(); ++i) {
        const auto at = [&](std::size_t k) {
            return solid
                .vertices[static_cast<std::size_t>(facet.corners[k % facet.corners.size()])];
        };
        const Vec3 a = at(i) - foot, b = at(i + 1) - foot;
        nearest = std::min(nearest, distance_to_segment(foot, at(i), at(i + 1)));
        angle += std::atan2(glm::dot(facet.plane.normal, glm::cross(a, b)), glm::dot(a, b));
    }
    return std::hypot(height, std::abs(angle) > k_pi ? 0 : nearest);
}

// ---- convex stones

class PolyhedronBodyConvex : public testing::TestWithParam<const char*> {};

TEST_P(PolyhedronBodyConvex, hits_as_the_convex_body_does) {
    const unsigned seed = 2201;
    std::mt19937_64 random(seed);
    const Solid solid = make_cut(GetParam());
    const ConvexBody convex(solid);
    const PolyhedronBody body(solid);
    const double size = diameter(solid);
    int hits = 0, misses = 0;
    for (int i = 0; i < 1500; ++i) {
        const Ray ray = random_ray(solid, random);
        const auto expected = convex.entry(ray.origin, ray.direction);
        const auto found = body.entry(ray.origin, ray.direction);
        ASSERT_EQ(found.has_value(), expected.has_value()) << "seed " << seed << " ray " << i;
        if (!found) {
            ++misses;
            continue;
        }
        ASSERT_EQ(found->facet, expected->facet) << "seed " << seed << " ray " << i;
        ASSERT_NEAR(found->distance, expected->distance, 1e-12 * size);
        Vec3 direction = ray.direction;
        Vec3 point = body.on_facet(found->facet, ray.origin + found->distance * direction);
        int from = found->facet;
        for (int bounce = 0; bounce < 10; ++bounce, ++hits) {
            const BodyHit next = convex.exit(point, direction);
            const BodyHit mine = body.exit(point, direction, from);
            ASSERT_EQ(mine.facet, next.facet) << "seed " << seed << " ray " << i << '.' << bounce;
            ASSERT_NEAR(mine.distance, next.distance, 1e-12 * size);
            ASSERT_FALSE(body.reentry(point, -direction, from).has_value());
            point = body.on_facet(next.facet, point + next.distance * direction);
            from = next.facet;
            direction = glm::reflect(direction, body.normal(from));
        }
    }
    EXPECT_GT(hits, 3000);
    EXPECT_GT(misses, 100);
}

INSTANTIATE_TEST_SUITE_P(Cuts, PolyhedronBodyConvex,
                         testing::Values("round-brilliant", "marquise", "pear", "cushion", "step",
                                         "princess"),
                         [](const auto& cut) {
                             std::string name = cut.param;
                             std::erase(name, '-');
                             return name;
                         });

// ---- watertight

enum class Position { general, special };

// In special positions rounding may reorder crossings, and twist the outline of a facet that is
// seen edge-on.
void expect_closed(const PolyhedronBody& body, const Ray& ray, const std::string& what,
                   Position position = Position::special) {
    int depth = 0;
    double before = -std::numeric_limits<double>::infinity();
    for (const LineCrossing& crossing : body.crossings(ray.origin, ray.direction)) {
        depth += crossing.step;
        ASSERT_TRUE(std::isfinite(crossing.distance)) << what;
        ASSERT_GE(crossing.distance, before) << what;
        if (position == Position::general) {
            ASSERT_TRUE(depth == 0 || depth == 1) << what;
            ASSERT_EQ(std::abs(crossing.step), 1) << what;
            ASSERT_EQ(crossing.step > 0, glm::dot(body.normal(crossing.facet), ray.direction) < 0)
                << what;
        }
        before = crossing.distance;
    }
    ASSERT_EQ(depth, 0) << what;
}

TEST(PolyhedronBody, steps_of_a_line_add_up_to_nothing_wherever_it_passes) {
    const unsigned seed = 2202;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 2);
    for (const bool turned : {false, true}) {
        for (const auto& [name, upright] : all()) {
            const Solid solid =
                turned ? moved(upright, random_turn(random), 1, {0.1, 0.2, 0.3}) : upright;
            const PolyhedronBody body(solid);
            const double size = diameter(solid);
            const std::string what = name + " seed " + std::to_string(seed);
            for (int i = 0; i < 500; ++i) {
                expect_closed(body, random_ray(solid, random), what, Position::general);
            }
            for (const Vec3& vertex : solid.vertices) {
                const Vec3 from = vertex + size * random_direction(random);
                expect_closed(body, {from, vertex - from}, what + " at a vertex");
                for (int axis = 0; axis < 3; ++axis) {
                    Vec3 direction{0, 0, 0};
                    direction[axis] = 1;
                    expect_closed(body, {vertex, direction}, what + " along an axis");
                    expect_closed(body, {vertex - direction, direction}, what + " along an axis");
                }
            }
            for (const Facet& facet : solid.facets) {
                for (std::size_t i = 0; i < facet.corners.size(); ++i) {
                    const auto corner = [&](std::size_t k) {
                        return solid.vertices[static_cast<std::size_t>(
                            facet.corners[k % facet.corners.size()])];
                    };
                    const Vec3 edge = corner(i + 1) - corner(i);
                    expect_closed(body, {corner(i), edge}, what + " along an edge");
                    expect_closed(body, {corner(i) - edge, edge}, what + " along an edge");
                    expect_closed(body, {corner(i) + uniform(random) * edge, edge},
                                  what + " along an edge");
                    // In the facet's plane, through a corner and not.
                    const Vec3 diagonal = corner(i + 2) - corner(i);
                    expect_closed(body, {corner(i) - diagonal, diagonal}, what + " in a facet");
                    const Vec3 within = glm::cross(facet.plane.normal, random_direction(random));
                    expect_closed(body, {corner(i) + uniform(random) * edge, within},
                                  what + " in a facet");
                    expect_closed(body, {corner(i) - within + 1e-17 * facet.plane.normal, within},
                                  what + " beside a facet");
                }
            }
        }
    }
}

// ---- lengths inside

using Rational = boost::multiprecision::cpp_rational;
using RationalVec = std::array<Rational, 3>;

RationalVec exactly(const Vec3& v) {
    return {Rational(v.x), Rational(v.y), Rational(v.z)};
}

Rational determinant(const RationalVec& a, const RationalVec& b, const RationalVec& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// Exact length, in lengths of the direction, of the part of a line within a solid: the solid is the
// sum of the tetrahedra, some negative, from the coordinates' origin over its facets' fans.
double exact_length_inside(const Solid& solid, const Ray& ray) {
    const RationalVec origin = exactly(ray.origin), direction = exactly(ray.direction);
    Rational sum = 0;
    for (const Facet& facet : solid.facets) {
        const auto corner = [&](std::size_t i) {
            return exactly(solid.vertices[static_cast<std::size_t>(facet.corners[i])]);
        };
        const RationalVec a = corner(0);
        for (std::size_t i = 1; i + 1 < facet.corners.size(); ++i) {
            const RationalVec b = corner(i), c = corner(i + 1);
            const Rational volume6 = determinant(a, b, c);
            if (volume6 == 0) continue;
            const int sign = volume6 > 0 ? 1 : -1;
            // Barycentric coordinates along the line: start + slope t >= 0.
            std::array<Rational, 4> start{determinant(origin, b, c), determinant(a, origin, c),
                                          determinant(a, b, origin), volume6};
            std::array<Rational, 4> slope{determinant(direction, b, c),
                                          determinant(a, direction, c),
                                          determinant(a, b, direction), 0};
            for (std::size_t k = 0; k < 3; ++k) {
                start[3] -= start[k];
                slope[3] -= slope[k];
            }
            bool none = false, first_known = false, last_known = false;
            Rational first, last;
            for (std::size_t k = 0; k < 4; ++k) {
                const Rational s = sign * start[k], m = sign * slope[k];
                if (m == 0) {
                    none = none || s < 0;
                    continue;
                }
                const Rational t = -s / m;
                if (m > 0 && (!first_known || t > first)) first = t, first_known = true;
                if (m < 0 && (!last_known || t < last)) last = t, last_known = true;
            }
            if (!none && first < last) sum += sign * (last - first);
        }
    }
    return static_cast<double>(sum);
}

TEST(PolyhedronBody, lengths_inside_along_a_chain_of_hits_are_exact) {
    const unsigned seed = 2203;
    std::mt19937_64 random(seed);
    for (const auto& [name, solid] : all()) {
        const PolyhedronBody body(solid);
        const double size = diameter(solid);
        int stretches = 0, again = 0;
        for (int i = 0; i < (solid.facets.size() < 30 ? 500 : 25); ++i) {
            const Ray ray = random_ray(solid, random);
            double inside = 0, least_cosine = 1;
            Vec3 point = ray.origin;
            auto hit = body.entry(point, ray.direction);
            for (int k = 0; hit && k < 100; ++k) {
                point = body.on_facet(hit->facet, point + hit->distance * ray.direction);
                const BodyHit out = body.exit(point, ray.direction, hit->facet);
                for (const int facet : {hit->facet, out.facet}) {
                    least_cosine = std::min(least_cosine,
                                            std::abs(glm::dot(body.normal(facet), ray.direction)));
                }
                inside += out.distance;
                ++stretches;
                again += k > 0;
                point = body.on_facet(out.facet, point + out.distance * ray.direction);
                hit = body.reentry(point, ray.direction, out.facet);
            }
            // A corner off by the rounding of a coordinate moves a crossing by that over the
            // cosine.
            ASSERT_NEAR(inside, exact_length_inside(solid, ray), 1e-14 * size / least_cosine)
                << name << " seed " << seed << " ray " << i;
        }
        EXPECT_GT(stretches, 5) << name;
        if (solid.facets.size() < 30) {
            EXPECT_GT(again, 0) << name << " is left and entered again";
        }
    }
}

// Over isotropic uniform lines that meet a ball of radius R, the mean length inside is
// V / (pi R^2) and the mean number of stretches S / (4 pi R^2), so that the mean stretch is 4 V / S
// (Cauchy 1841, Crofton 1868; Santalo 1976, ch. 14), convex or not.
TEST(PolyhedronBody, mean_chords_follow_volume_and_surface) {
    const unsigned seed = 2204;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform;
    for (const auto& [name, solid] : all()) {
        const PolyhedronBody body(solid);
        double surface = 0;
        for (const Facet& facet : solid.facets) surface += area(solid, facet);
        const double radius = 0.5 * diameter(solid) * (1 + 1e-9);
        const Vec3 middle = middle_of(solid);
        const int lines = 20000;
        double length_sum = 0, length_squares = 0, count_sum = 0, count_squares = 0;
        for (int i = 0; i < lines; ++i) {
            const glm::dmat3 turn = random_turn(random);
            const double r = radius * std::sqrt(uniform(random));
            const double angle = 2 * k_pi * uniform(random);
            const Vec3 direction = turn[2];
            Vec3 point = middle - 2 * radius * direction +
                         r * (std::cos(angle) * turn[0] + std::sin(angle) * turn[1]);
            double inside = 0, stretches = 0;
            auto hit = body.entry(point, direction);
            while (hit) {
                point = body.on_facet(hit->facet, point + hit->distance * direction);
                const BodyHit out = body.exit(point, direction, hit->facet);
                inside += out.distance;
                ++stretches;
                point = body.on_facet(out.facet, point + out.distance * direction);
                hit = body.reentry(point, direction, out.facet);
            }
            length_sum += inside;
            length_squares += inside * inside;
            count_sum += stretches;
            count_squares += stretches * stretches;
        }
        const double disc = k_pi * radius * radius;
        const auto expect_mean = [&](double sum, double squares, double expected) {
            const double mean = sum / lines;
            const double error = std::sqrt((squares / lines - mean * mean) / lines);
            EXPECT_NEAR(mean, expected, 5 * error) << name << " seed " << seed;
        };
        expect_mean(length_sum, length_squares, volume(solid) / disc);
        expect_mean(count_sum, count_squares, surface / (4 * disc));
    }
}

TEST(PolyhedronBody, contains_what_the_solid_angle_says) {
    const unsigned seed = 2205;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    for (const auto& [name, solid] : all()) {
        const PolyhedronBody body(solid);
        for (int i = 0; i < 300; ++i) {
            const Vec3 point =
                middle_of(solid) +
                diameter(solid) * Vec3{uniform(random), uniform(random), uniform(random)};
            ASSERT_EQ(body.contains(point), winding_of(solid, point) > 0.5)
                << name << " seed " << seed << " point " << i;
        }
    }
}

// ---- starts on edges and vertices

TEST(PolyhedronBody, starts_on_edges_and_vertices_stay_at_the_stone) {
    const unsigned seed = 2206;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform;
    for (const bool turned : {false, true}) {
        for (const auto& [name, upright] : all()) {
            const Solid solid =
                turned ? moved(upright, random_turn(random), 1, {0.1, 0.2, 0.3}) : upright;
            const PolyhedronBody body(solid);
            const double size = diameter(solid), rounding = 1e-13 * size;
            for (std::size_t f = 0; f < solid.facets.size(); ++f) {
                const Facet& facet = solid.facets[f];
                for (std::size_t k = 0; k < 4 * facet.corners.size(); ++k) {
                    const std::size_t count = facet.corners.size(), i = k % count;
                    const Vec3 a = solid.vertices[static_cast<std::size_t>(facet.corners[i])];
                    const Vec3 b =
                        solid.vertices[static_cast<std::size_t>(facet.corners[(i + 1) % count])];
                    const double part = k < count ? 0 : k < 2 * count ? 0.5 : uniform(random);
                    const Vec3 start = a + part * (b - a);
                    Vec3 direction = random_direction(random);
                    if (glm::dot(direction, facet.plane.normal) > 0) direction = -direction;
                    const std::string what = name + " seed " + std::to_string(seed) + " facet " +
                                             facet.name + " corner " + std::to_string(k);

                    const BodyHit out = body.exit(start, direction, static_cast<int>(f));
                    ASSERT_GE(out.facet, 0) << what;
                    ASSERT_GE(out.distance, 0) << what;
                    const Vec3 end = start + out.distance * direction;
                    const double slope = std::abs(glm::dot(direction, body.normal(out.facet)));
                    ASSERT_LT(distance_to_facet(solid, out.facet, end), rounding / slope) << what;
                    if (out.distance > 100 * rounding) {
                        ASSERT_GT(winding_of(solid, 0.5 * (start + end)), 0.5) << what;
                    }

                    const auto in = body.reentry(start, -direction, static_cast<int>(f));
                    if (!in) continue;
                    ASSERT_GE(in->distance, 0) << what;
                    const Vec3 there = start - in->distance * direction;
                    const double steep = std::abs(glm::dot(direction, body.normal(in->facet)));
                    ASSERT_LT(distance_to_facet(solid, in->facet, there), rounding / steep) << what;
                    if (in->distance > 100 * rounding) {
                        ASSERT_LT(winding_of(solid, 0.5 * (start + there)), 0.5) << what;
                    }
                }
            }
        }
    }
}

TEST(PolyhedronBody, start_beyond_a_convex_edge_leaves_at_once_and_leaps_over_no_gap) {
    // The inner wall of the left arm is facet 7 (x = 1), its top end facet 8 (y = 3).
    const Solid solid = u_prism();
    const PolyhedronBody body(solid);
    ASSERT_EQ(body.normal(7), (Vec3{1, 0, 0}));
    ASSERT_EQ(body.normal(8), (Vec3{0, 1, 0}));
    for (const double beyond : {0.0, 1e-16, 4e-16, 1e-15}) {
        // Starts on the end of the left arm, beyond its edge, and runs down into the gap.
        const Vec3 down = glm::normalize(Vec3{2, -1, 0});
        const BodyHit corner = body.exit({1 + beyond, 3, 0.5}, down, 8);
        EXPECT_EQ(corner.facet, 7) << beyond;
        EXPECT_LT(corner.distance, 1e-15);
        // And from there across the gap: into the right arm's wall x = 2, 1/2 further down.
        const auto across = body.reentry(body.on_facet(7, {1 + beyond, 3, 0.5}), down, 7);
        ASSERT_TRUE(across.has_value());
        EXPECT_EQ(body.normal(across->facet), (Vec3{-1, 0, 0}));
        EXPECT_NEAR(across->distance, std::sqrt(1.25), 1e-14);
    }
}

TEST(PolyhedronBody, start_beyond_a_concave_edge_goes_on_inside) {
    // The L's concave edge x = 1, y = 1: facet 4 above y = 1, facet 5 beside x = 1.
    const PolyhedronBody body(l_prism());
    ASSERT_EQ(body.normal(4), (Vec3{0, 1, 0}));
    ASSERT_EQ(body.normal(5), (Vec3{1, 0, 0}));
    for (const double beyond : {-1e-15, -1e-16, 0.0, 1e-16, 1e-15}) {
        // Down from y = 1 past the edge into the foot and out at y = 0.
        const BodyHit down = body.exit({1 + beyond, 1, 0.5}, {-0.6, -0.8, 0}, 4);
        EXPECT_EQ(body.normal(down.facet), (Vec3{0, -1, 0})) << beyond;
        EXPECT_NEAR(down.distance, 1.25, 1e-14);
        // From y = 1 to the left, hardly downwards, through the upright and out at x = 0.
        const Vec3 grazing = glm::normalize(Vec3{-1, -1e-9, 0});
        const BodyHit left = body.exit({1 + beyond, 1, 0.5}, grazing, 4);
        EXPECT_EQ(body.normal(left.facet), (Vec3{-1, 0, 0})) << beyond;
        EXPECT_NEAR(left.distance, 1, 1e-14);
        // Out into the corner, beside the edge: either goes free or enters at once.
        const auto out = body.reentry({1 + beyond, 1, 0.5}, {-0.6, 0.8, 0}, 4);
        ASSERT_TRUE(out.has_value()) << beyond;
        EXPECT_EQ(out->facet, 5);
        EXPECT_LT(out->distance, 1e-14);
        EXPECT_FALSE(body.reentry({1 + beyond, 1, 0.5}, {0.6, 0.8, 0}, 4).has_value());
    }
}

TEST(PolyhedronBody, ray_grazing_along_a_concave_edge) {
    const unsigned seed = 2207;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const PolyhedronBody body(l_prism());
    for (const double tilt : {0.0, 1e-300, 1e-20, 1e-17, 1e-16, 1e-15, 1e-12, 1e-8, 1e-4}) {
        for (int i = 0; i < 200; ++i) {
            const Vec3 direction =
                glm::normalize(Vec3{tilt * uniform(random), tilt * uniform(random), 1});
            const Vec3 below{1 + tilt * uniform(random), 1 + tilt * uniform(random), -1};
            const auto in = body.entry(below, direction);
            // Beside the edge three quarters of the plane are inside.
            for (const int from : {-1, 4, 5}) {
                const BodyHit out = body.exit({1, 1, 0.25}, direction, from);
                ASSERT_TRUE(out.facet == 0 || out.facet == 4 || out.facet == 5) << tilt;
                ASSERT_GE(out.distance, 0);
                ASSERT_LE(out.distance, 0.75 + 1e-7);
            }
            if (!in) continue;
            ASSERT_TRUE(in->facet == 1 || in->facet == 4 || in->facet == 5) << tilt;
            ASSERT_GE(in->distance, 1 - 1e-7);
            ASSERT_LE(in->distance, 2 + 1e-7);
        }
    }
}

TEST(PolyhedronBody, start_in_a_facet_seen_edge_on_runs_along_it) {
    // Inside by less than rounding along the side x = 3 of the L: out through the top.
    const PolyhedronBody body(l_prism());
    for (const double inwards : {1e-300, 1e-20, 1e-17, 1e-16}) {
        const BodyHit out = body.exit({3, 0.5, 0.25}, {-inwards, 0, 1}, 3);
        EXPECT_EQ(out.facet, 0) << inwards;
        EXPECT_EQ(out.distance, 0.75);
    }
}

TEST(PolyhedronBody, valley_of_a_notch_is_entered_again_at_once) {
    const PolyhedronBody body(notched_box());
    // Down through the hole of the top facet onto the apex, which the line goes through.
    const auto apex = body.entry({0, 0, 5}, {0, 0, -1});
    ASSERT_TRUE(apex.has_value());
    EXPECT_GE(apex->facet, 6);
    EXPECT_EQ(apex->distance, 6);
    EXPECT_EQ(body.exit({0, 0, -1}, {0, 0, -1}, apex->facet).facet, 1);
    // Across the notch close above the apex, where it is 2 h / 3 wide.
    for (const double h : {1.0, 1e-3, 1e-9, 1e-15}) {
        const BodyHit out = body.exit({-2, 0.1 * h, -1 + h}, {1, 0, 0}, 5);
        EXPECT_EQ(out.facet, 9);
        const Vec3 wall = body.on_facet(9, {-2 + out.distance, 0.1 * h, -1 + h});
        const auto in = body.reentry(wall, {1, 0, 0}, 9);
        ASSERT_TRUE(in.has_value());
        EXPECT_EQ(in->facet, 7);
        EXPECT_NEAR(in->distance, 2 * h / 3, 1e-15);
    }
    EXPECT_FALSE(body.contains({0, 0, -0.9}));
    EXPECT_FALSE(body.contains({0, 0, -1}));
    EXPECT_TRUE(body.contains({0, 0, -1.1}));
}

TEST(PolyhedronBody, facet_with_a_hole_lets_the_ray_through) {
    const PolyhedronBody body(ring());
    EXPECT_FALSE(body.entry({0, 0, 5}, {0, 0, -1}).has_value());
    EXPECT_FALSE(body.entry({0.9, 0.9, 5}, {0, 0, -1}).has_value());
    // Along the bridge between hole and outline.
    for (const double shift : {-1e-17, 0.0, 1e-17}) {
        const auto hit = body.entry({-2 + shift, -2, 5}, {0, 0, -1});
        ASSERT_TRUE(hit.has_value());
        EXPECT_EQ(hit->facet, 0);
        EXPECT_EQ(hit->distance, 4);
    }
    // In at the side, out into the hole, in again and out.
    const BodyHit wall = body.exit({-3, 0, 0.5}, {1, 0, 0}, 5);
    EXPECT_EQ(wall.facet, 9);
    EXPECT_EQ(wall.distance, 2);
    const auto again = body.reentry({-1, 0, 0.5}, {1, 0, 0}, 9);
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->facet, 7);
    EXPECT_EQ(again->distance, 2);
    EXPECT_FALSE(body.reentry({3, 0, 0.5}, {1, 0, 0}, 3).has_value());
}

TEST(PolyhedronBody, edge_that_four_facets_share) {
    const PolyhedronBody body(cubes_on_one_edge());
    // Through the edge: from one cube straight into the other, or out and in at once.
    const BodyHit hit = body.exit({-1, -1, 0.5}, glm::normalize(Vec3{1, 1, 0}), 9);
    EXPECT_NEAR(hit.distance, hit.distance > 2 ? 2 * std::sqrt(2.0) : std::sqrt(2.0), 1e-15);
    // Across it, through the two free quadrants.
    const auto miss = body.entry({-1, 1, 0.5}, glm::normalize(Vec3{1, -1, 0}));
    if (miss) {
        EXPECT_NEAR(miss->distance, std::sqrt(2.0), 1e-15);
    }
}

TEST(PolyhedronBody, thin_wedge_is_left_where_it_is_entered) {
    // A wedge of 1e-9 radians: near its edge, crossings are closer together than their rounding.
    const double thin = 1e-9;
    const PolyhedronBody body(prism({{0, 0}, {1, 0}, {1, thin}}, 0, 1));
    const unsigned seed = 2208;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 2000; ++i) {
        const double x = std::pow(10, -16 * uniform(random));
        Vec3 direction = random_direction(random);
        direction.y = std::abs(direction.y);
        const BodyHit out = body.exit({x, 0, uniform(random)}, direction, 2);
        ASSERT_GE(out.distance, 0);
        ASSERT_LE(out.distance, std::sqrt(2.0) + 1e-7);
        ASSERT_NE(out.facet, 2) << "seed " << seed << " ray " << i;
    }
}

TEST(PolyhedronBody, start_outside_by_rounding_in_the_middle_of_a_facet) {
    // Above the top by one rounding and running upwards: out at once. Downwards: in and through.
    const PolyhedronBody body(l_prism());
    const Vec3 above{0.5, 0.75, std::nextafter(1.0, 2.0)};
    for (const int from : {-1, 3}) {
        const BodyHit up = body.exit(above, {0.6, 0, 0.8}, from);
        EXPECT_EQ(up.facet, 0) << from;
        EXPECT_EQ(up.distance, 0);
        const BodyHit down = body.exit(above, {0, 0, -1}, from);
        EXPECT_EQ(down.facet, 1) << from;
        EXPECT_NEAR(down.distance, 1, 1e-15);
    }
}

TEST(PolyhedronBody, start_off_its_plane_by_rounding_and_grazing_keeps_its_distance) {
    // 1e-16 below y = 0 (facet 2) the ray rises by 1e-9 of its length: by the planes alone it would
    // come to its own facet after 1e-7, twice as far as the end at x = 1.
    const PolyhedronBody body(prism({{0, 0}, {1, 0}, {1, 1}}, 0, 1));
    const BodyHit hit = body.exit({1 - 5e-8, -1e-16, 0.5}, {1, 1e-9, 1}, 2);
    EXPECT_EQ(body.normal(hit.facet), (Vec3{1, 0, 0}));
    EXPECT_NEAR(hit.distance, 5e-8, 1e-15);
}

TEST(PolyhedronBody, ray_that_only_touches_an_edge_or_corner_does_not_enter) {
    const Solid cube = prism({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, -1, 1);
    const PolyhedronBody body(cube);
    for (int axis = 0; axis < 3; ++axis) {
        for (const int first : {-1, 1}) {
            for (const int second : {-1, 1}) {
                for (const double along : {-1.0, 0.25, 1.0}) {
                    Vec3 touch{0, 0, 0}, direction{0, 0, 0};
                    touch[axis] = along;
                    touch[(axis + 1) % 3] = first;
                    touch[(axis + 2) % 3] = second;
                    direction[(axis + 1) % 3] = first;
                    direction[(axis + 2) % 3] = -second;
                    EXPECT_FALSE(body.entry(touch - 2.0 * direction, direction).has_value());
                    EXPECT_FALSE(body.entry(touch + 2.0 * direction, -direction).has_value());
                }
            }
        }
    }
}

TEST(PolyhedronBody, side_of_an_edge_is_decided_exactly) {
    // With e = 2^-52, the edge from a to b passes the axis at e^2 / 2 on its right or, mirrored, on
    // its left; the two products of the side test are equal once rounded.
    const double e = std::numeric_limits<double>::epsilon();
    for (const double mirror : {1.0, -1.0}) {
        // A pyramid upside down, its top split along a b.
        std::vector<Vec3> vertices{
            {-(1 + e), -1, 1}, {1, -1, 1}, {1 + 2 * e, 1 + e, 1}, {-1, 1, 1}, {0.125, 0.25, -1}};
        Loops loops{{0, 1, 2}, {0, 2, 3}, {1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}};
        for (Vec3& vertex : vertices) vertex.x *= mirror;
        if (mirror < 0) {
            for (std::vector<int>& loop : loops) std::reverse(loop.begin(), loop.end());
        }
        // a.x b.y - a.y b.x = -mirror e^2: always on the side of vertex 1, in facet 0.
        const auto hit = PolyhedronBody(solid_of(vertices, loops)).entry({0, 0, 2}, {0, 0, -1});
        ASSERT_TRUE(hit.has_value());
        EXPECT_EQ(hit->facet, 0) << mirror;
    }
}

// ---- positions and sizes

TEST(PolyhedronBody, hits_the_same_facets_far_away_small_and_large) {
    const unsigned seed = 2209;
    std::mt19937_64 random(seed);
    const glm::dmat3 upright(1);
    struct Place {
        double scale;
        Vec3 shift;
    };
    for (const auto& [name, solid] : all()) {
        const PolyhedronBody body(solid);
        for (const Place& place : {Place{1, {1e6, -1e6, 1e6}}, Place{1e-6, {0, 0, 0}},
                                   Place{1e6, {0, 0, 0}}, Place{1e6, {-1e6, 1e6, 1e6}}}) {
            const PolyhedronBody other(moved(solid, upright, place.scale, place.shift));
            // A coordinate's rounding over the size: rays that pass closer than that to an edge, or
            // meet a facet at so small an angle, may differ, and none of these rays does.
            const double rounding = 1e-15 * (1 + glm::length(place.shift) / place.scale);
            for (int i = 0; i < 300; ++i) {
                const Ray ray = random_ray(solid, random);
                const Vec3 start = place.scale * ray.origin + place.shift;
                const auto a = body.entry(ray.origin, ray.direction);
                const auto b = other.entry(start, ray.direction);
                ASSERT_EQ(a.has_value(), b.has_value()) << name << " seed " << seed;
                if (!a) continue;
                ASSERT_EQ(a->facet, b->facet) << name << " seed " << seed;
                const Vec3 here = ray.origin + a->distance * ray.direction;
                const Vec3 there = start + b->distance * ray.direction;
                const BodyHit c = body.exit(here, ray.direction, a->facet);
                const BodyHit d = other.exit(there, ray.direction, b->facet);
                ASSERT_EQ(c.facet, d.facet) << name << " seed " << seed << " ray " << i;
                ASSERT_NEAR(c.distance * place.scale, d.distance,
                            1e4 * rounding * place.scale * diameter(solid));
            }
        }
    }
}

TEST(PolyhedronBody, length_of_the_direction_does_not_matter) {
    const unsigned seed = 2210;
    std::mt19937_64 random(seed);
    const Solid solid = make_cut("heart");
    const PolyhedronBody body(solid);
    for (int i = 0; i < 200; ++i) {
        const Ray ray = random_ray(solid, random);
        const auto unit = body.entry(ray.origin, ray.direction);
        const auto longer = body.entry(ray.origin, 1024.0 * ray.direction);
        ASSERT_EQ(unit.has_value(), longer.has_value());
        if (!unit) continue;
        EXPECT_EQ(unit->facet, longer->facet);
        EXPECT_DOUBLE_EQ(unit->distance, 1024 * longer->distance);
    }
}

// ---- what is asked by mistake

TEST(PolyhedronBody, open_or_senseless_solids_are_refused) {
    Solid open = l_prism();
    open.facets.pop_back();
    EXPECT_THROW(PolyhedronBody{open}, InputError);
    Solid wild = l_prism();
    wild.facets[3].corners[0] = 1000;
    EXPECT_THROW(PolyhedronBody{wild}, InputError);
    wild.facets[3].corners[0] = -1;
    EXPECT_THROW(PolyhedronBody{wild}, InputError);
    Solid flipped = l_prism();
    std::swap(flipped.facets[0].corners[0], flipped.facets[0].corners[1]);
    EXPECT_THROW(PolyhedronBody{flipped}, InputError);
    EXPECT_THROW(PolyhedronBody{Solid{}}, InputError);
}

TEST(PolyhedronBody, senseless_rays_still_end) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const PolyhedronBody body(l_prism());
    const std::array<Vec3, 8> odd{Vec3{nan, 0, 1},     Vec3{nan, nan, nan}, Vec3{0, 0, 0},
                                  Vec3{0, 0, 1e300},   Vec3{0, 0, 1e-300},  Vec3{infinity, 0, 0},
                                  Vec3{100, 200, 300}, Vec3{0.5, 0.5, 0.5}};
    for (const Vec3& origin : odd) {
        for (const Vec3& direction : odd) {
            for (const int from : {-1, 0, 4}) {
                const BodyHit hit = body.exit(origin, direction, from);
                EXPECT_GE(hit.facet, 0);
                EXPECT_LT(hit.facet, 8);
                EXPECT_GE(hit.distance, 0) << "not NaN";
                body.reentry(origin, direction, from);
                body.entry(origin, direction);
                body.contains(origin);
            }
        }
    }
}

TEST(PolyhedronBody, threads_and_other_bodies_change_nothing) {
    const std::vector<NamedSolid> solids = all();
    const auto run = [&](bool backwards) {
        std::vector<BodyHit> hits;
        for (std::size_t k = 0; k < solids.size(); ++k) {
            const Solid& solid = solids[backwards ? solids.size() - 1 - k : k].solid;
            const PolyhedronBody body(solid);
            std::mt19937_64 random(2211);
            std::vector<BodyHit> here;
            for (int i = 0; i < 200; ++i) {
                const Ray ray = random_ray(solid, random);
                here.push_back(body.entry(ray.origin, ray.direction).value_or(BodyHit{}));
            }
            hits.insert(backwards ? hits.begin() : hits.end(), here.begin(), here.end());
        }
        return hits;
    };
    std::vector<BodyHit> forwards, backwards;
    std::thread one([&] { forwards = run(false); }), two([&] { backwards = run(true); });
    one.join();
    two.join();
    const std::vector<BodyHit> alone = run(false);
    ASSERT_EQ(forwards.size(), alone.size());
    ASSERT_EQ(backwards.size(), alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i) {
        ASSERT_EQ(forwards[i].facet, alone[i].facet);
        ASSERT_EQ(forwards[i].distance, alone[i].distance);
        ASSERT_EQ(backwards[i].facet, alone[i].facet);
        ASSERT_EQ(backwards[i].distance, alone[i].distance);
    }
}

}  // namespace
