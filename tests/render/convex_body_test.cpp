// Expectation: the search over all planes, which uses no guess, to the bit.

#include "render/geometry/convex_body.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/render/ray_stones.h"

namespace {

using namespace culet;

void expect_same(const BodyHit& a, const BodyHit& b, const char* what) {
    EXPECT_EQ(a.facet, b.facet) << what;
    EXPECT_EQ(a.distance, b.distance) << what;
}

// Tries every guess for rays from inside, and the last ray's facet for rays from outside.
void expect_no_guess_matters(const Solid& solid, std::mt19937_64& random, const char* what) {
    const ConvexBody body(solid);
    const int facets = static_cast<int>(solid.facets.size());
    std::uniform_real_distribution<double> share(0, 1);
    EntryGuess last;
    for (int i = 0; i < 200; ++i) {
        EyeRay ray = random_ray(random);
        // Every third ray aims exactly at a corner, every other third at a point of an edge.
        const std::vector<int>& corners = solid.facets[i % facets].corners;
        if (i % 3 != 0) {
            const Vec3 &a = solid.vertices[corners[0]], &b = solid.vertices[corners[1]];
            const double t = i % 3 == 1 ? 0.0 : share(random);
            ray.direction = glm::normalize(a + t * (b - a) - ray.origin);
        }
        const auto plain = body.entry(ray.origin, ray.direction);
        const auto guessed = body.entry(ray.origin, ray.direction, last);
        ASSERT_EQ(plain.has_value(), guessed.has_value()) << what;
        if (!plain) continue;
        expect_same(*plain, *guessed, what);
        Vec3 at = body.on_facet(plain->facet, ray.origin + plain->distance * ray.direction);
        Vec3 direction = glm::normalize(ray.direction - 0.3 * body.normal(plain->facet));
        for (int hits = 0; hits < 4; ++hits) {
            const BodyHit all = body.exit(at, direction);
            for (int guess = 0; guess < facets; ++guess)
                expect_same(all, body.exit(at, direction, guess), what);
            at = body.on_facet(all.facet, at + all.distance * direction);
            const Vec3& n = body.normal(all.facet);
            direction = glm::normalize(direction - 2 * glm::dot(direction, n) * n);
        }
    }
}

TEST(ConvexBody, GuessesChangeNoAnswer) {
    const unsigned seed = 4127;
    std::mt19937_64 random(seed);
    for (int planes : {0, 10, 40})
        expect_no_guess_matters(random_stone(random, planes), random, "random stone");
}

TEST(ConvexBody, GuessesChangeNoAnswerInDegenerateStones) {
    std::mt19937_64 random(97);
    Solid stone = random_stone(random, 20);
    stone.facets.push_back(stone.facets[8]);
    expect_no_guess_matters(stone, random, "repeated plane");

    stone = random_stone(random, 20);
    Facet nearly = stone.facets[8];
    nearly.plane.normal = glm::normalize(nearly.plane.normal + Vec3{1e-10, -2e-10, 1e-10});
    stone.facets.push_back(nearly);
    expect_no_guess_matters(stone, random, "planes a 1e-10 apart");

    stone = random_stone(random, 20);
    Facet unused = stone.facets[8];
    unused.plane.offset += 0.5;
    stone.facets.push_back(unused);
    expect_no_guess_matters(stone, random, "plane that does not show");

    stone = random_stone(random, 20);
    for (Vec3& vertex : stone.vertices) vertex += 0.01 * random_direction(random);
    expect_no_guess_matters(stone, random, "corners off their planes");

    stone = random_stone(random, 20);
    const Vec3 shift{1e5, -2e5, 1e5};
    for (Vec3& vertex : stone.vertices) vertex += shift;
    for (Facet& facet : stone.facets) facet.plane.offset += glm::dot(facet.plane.normal, shift);
    const ConvexBody far_off(stone);
    EXPECT_EQ(far_off.exit(shift, {0, 0, 1}).facet, far_off.exit(shift, {0, 0, 1}, 3).facet);

    expect_no_guess_matters(slab(1e-3), random, "thin slab");
    stone.vertices.clear();
    for (Facet& facet : stone.facets) facet.corners.clear();
    const ConvexBody planes_only(stone);
    EXPECT_EQ(planes_only.exit(shift, {0, 0, 1}).facet,
              planes_only.exit(shift, {0, 0, 1}, 3).facet);
}

}  // namespace
