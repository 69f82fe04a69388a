// Expectations: ConvexBody where the solid is convex; exact rational clipping; integral geometry
// (Cauchy, Crofton); solid angles; and hand calculation for small solids. Seeds are fixed and
// printed.

#include "render/geometry/polyhedron_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>
#include <thread>

#include "stone/text/errors.h"
#include "tests/render/carved_solids.h"

namespace {

using namespace culet;
using namespace culet::carved;

const double k_pi = std::acos(-1);

// ---- convex stones

class PolyhedronBodyConvex : public testing::TestWithParam<const char*> {};

TEST_P(PolyhedronBodyConvex, HitsAsTheConvexBodyDoes) {
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

// In special positions rounding may reorder crossings and twist the outline of a facet seen
// edge-on.
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

TEST(PolyhedronBody, StepsOfALineAddUpToNothingWhereverItPasses) {
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

// Exact length, in units of the direction, of the part of a line within a solid. The solid is the
// signed sum of the tetrahedra from the origin over its facets' fans.
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

TEST(PolyhedronBody, LengthsInsideAlongAChainOfHitsAreExact) {
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
            // A corner off by the rounding error of a coordinate moves a crossing by that over the
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

// Over isotropic uniform lines that meet a ball of radius R, the mean length inside is V / (pi R^2)
// and the mean number of stretches S / (4 pi R^2), so the mean stretch is 4 V / S (Cauchy 1841,
// Crofton 1868; Santalo 1976, ch. 14), convex or not.
TEST(PolyhedronBody, MeanChordsFollowVolumeAndSurface) {
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

TEST(PolyhedronBody, ContainsWhatTheSolidAngleSays) {
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

// ---- positions and sizes

TEST(PolyhedronBody, HitsTheSameFacetsFarAwaySmallAndLarge) {
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
            // A coordinate's rounding error over the size. Rays that pass an edge closer than that,
            // or meet a facet at so small an angle, may differ; none of these rays does.
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

TEST(PolyhedronBody, LengthOfTheDirectionDoesNotMatter) {
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

// ---- invalid calls

TEST(PolyhedronBody, OpenOrSenselessSolidsAreRefused) {
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

TEST(PolyhedronBody, SenselessRaysStillEnd) {
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

TEST(PolyhedronBody, ThreadsAndOtherBodiesChangeNothing) {
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
