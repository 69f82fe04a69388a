// Expectations: rays refracted by Snell's law and reflected one by one, and differences of them.

#include "render/beams/pencil.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/render/beams/beam_scenes.h"

namespace {

using namespace culet;

constexpr double k_stone = 2.417;

struct Walk {
    Vec3 point, direction;
    std::vector<int> facets;
};

Vec3 snell(const Vec3& v, const Vec3& outwards, double n) {
    // Along the normal and across it: the part across shrinks by n.
    const double along = glm::dot(v, outwards);
    const Vec3 across = (v - along * outwards) / n;
    return across - std::sqrt(1 - glm::dot(across, across)) * outwards;
}

Vec3 onto(const Vec3& from, const Vec3& d, const Plane& plane) {
    return from - height_above(plane, from) / glm::dot(plane.normal, d) * d;
}

// Along given facets, as if their planes were infinite mirrors.
Walk walk_along(const EyeRay& ray, const std::vector<Plane>& planes, double n) {
    Walk walk;
    walk.point = onto(ray.origin, ray.direction, planes.front());
    walk.direction = snell(ray.direction, planes.front().normal, n);
    for (std::size_t i = 1; i < planes.size(); ++i) {
        if (i > 1) {
            const Vec3& m = planes[i - 1].normal;
            walk.direction -= 2 * glm::dot(walk.direction, m) * m;
        }
        walk.point = onto(walk.point, walk.direction, planes[i]);
    }
    return walk;
}

std::vector<Plane> planes_met(const Solid& solid, const EyeRay& ray, int depth, double n) {
    double entry = -1e300;
    const Plane* last = nullptr;
    for (const Facet& facet : solid.facets) {
        const double towards = glm::dot(facet.plane.normal, ray.direction);
        const double t = -height_above(facet.plane, ray.origin) / towards;
        if (towards < 0 && t > entry) {
            entry = t;
            last = &facet.plane;
        }
    }
    std::vector<Plane> met{*last};
    Vec3 at = ray.origin + entry * ray.direction, d = snell(ray.direction, last->normal, n);
    while (static_cast<int>(met.size()) < depth) {
        double exit = 1e300;
        for (const Facet& facet : solid.facets) {
            const double towards = glm::dot(facet.plane.normal, d);
            const double t = -height_above(facet.plane, at) / towards;
            if (towards > 0 && t < exit) {
                exit = t;
                last = &facet.plane;
            }
        }
        at += exit * d;
        d -= 2 * glm::dot(d, last->normal) * last->normal;
        met.push_back(*last);
    }
    return met;
}

// The tree's map at the ray's last facet.
PencilMap map_at(const ScreenView& view, const ScreenPoint& at, const std::vector<Plane>& met,
                 double n, Refraction refraction, const Pencil& about) {
    Folding folding;
    for (std::size_t i = 1; i + 1 < met.size(); ++i) folding = folding.mirrored(met[i]);
    const EyeRay ray{view.origin(at), glm::normalize(view.towards(at))};
    const Vec3 start = onto(ray.origin, ray.direction, met.front());
    double length = 0;
    std::vector<Plane> part{met.front()};
    Vec3 before = start;
    for (std::size_t i = 1; i < met.size(); ++i) {
        part.push_back(met[i]);
        const Walk walk = walk_along(ray, part, n);
        length += glm::length(walk.point - before);
        before = walk.point;
    }
    return map_of(about, refraction, folding, length * about.cos_t);
}

ScreenPoint seen(const PencilMap& map, const Vec3& p) {
    const ScreenImage image = map.of(p);
    return {image.x / image.z, image.y / image.z};
}

// Rays `step` pixels from the middle one must arrive where the map says.
void expect_exact_to_first_order(const Camera& camera, const Solid& solid, const ScreenPoint& at,
                                 int depth, double step, double most) {
    const ScreenView view = screen_view(camera);
    const EyeRays eyes(camera);
    const std::vector<Plane> met = planes_met(solid, eyes.through(at.x, at.y), depth, k_stone);
    const Pencil pencil = pencil_through(view, at, met.front(), k_stone);
    const PencilMap map = map_at(view, at, met, k_stone, Refraction::astigmatic, pencil);
    const auto image = [&](double dx, double dy) {
        return seen(map, walk_along(eyes.through(at.x + dx, at.y + dy), met, k_stone).point);
    };
    const ScreenPoint middle = image(0, 0);
    ASSERT_NEAR(middle.x, at.x, 1e-8) << "cosine " << pencil.cos_i;
    ASSERT_NEAR(middle.y, at.y, 1e-8);
    for (const auto& [dx, dy] : {std::pair{step, 0.0}, {0.0, step}, {step, step}}) {
        const ScreenPoint a = image(dx, dy), b = image(-dx, -dy);
        EXPECT_NEAR((a.x - b.x) / (2 * step), dx / step, most) << "cosine " << pencil.cos_i;
        EXPECT_NEAR((a.y - b.y) / (2 * step), dy / step, most) << "cosine " << pencil.cos_i;
    }
}

// Central differences are off by the third derivative times the step squared, plus the rounding
// error of pixel coordinates and of the path over the step.
TEST(PencilMaps, FollowRefractedAndReflectedRaysToFirstOrder) {
    std::mt19937_64 random(20270);
    std::uniform_real_distribution<double> pixel(150, 250);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE("seed 20270, case " + std::to_string(i));
        Scene scene = plain_scene(random_stone(random, 12));
        scene.camera.width = scene.camera.height = 400;
        // Diameters between 1.01 and 6: the stones reach out to 2.25 at most.
        look(scene, random_direction(random), i % 3 == 0 ? 3 : i % 3 == 1 ? 6 : 15, 1.2);
        expect_exact_to_first_order(scene.camera, scene.stone.solid, {pixel(random), pixel(random)},
                                    2 + i % 6, 1e-3, 1e-5);
    }
}

TEST(PencilMaps, At101DiametersFollowTheRaysToFirstOrder) {
    const Solid solid = round_brilliant();
    for (const Vec3& from :
         {Vec3{0, 0, 1}, Vec3{0.3, 0.2, 1}, Vec3{1, 0.2, 0.3}, Vec3{0, 0.1, -1}}) {
        for (int depth = 2; depth < 7; ++depth) {
            Scene scene = plain_scene(solid);
            scene.camera.width = scene.camera.height = 400;
            look(scene, from, 1.01 * 2);
            expect_exact_to_first_order(scene.camera, solid, {201.3, 188.7}, depth, 1e-3, 1e-5);
        }
    }
}

TEST(PencilMaps, AtNormalIncidenceHaveNoDirectionOfTheirOwn) {
    const Solid solid = round_brilliant();
    Scene scene = plain_scene(solid);
    scene.camera.width = scene.camera.height = 401;
    // Straight through the table's middle onto the culet; and slightly beside it.
    look(scene, {0, 0, 1}, 6);
    for (const double off : {0.0, 1e-12, 1e-9, 1e-6, 1e-3}) {
        SCOPED_TRACE(off);
        const ScreenView view = screen_view(scene.camera);
        const Plane table = solid.facets[static_cast<std::size_t>(find_facet(solid, "T"))].plane;
        const Pencil pencil = pencil_through(view, {200.5 + off, 200.5}, table, k_stone);
        EXPECT_NEAR(glm::length(pencil.tangential), 1, 1e-12);
        EXPECT_NEAR(glm::length(pencil.sagittal), 1, 1e-12);
        EXPECT_NEAR(glm::dot(pencil.tangential, table.normal), 0, 1e-10);
        // The limit of Coddington's two image distances: both are n times the eye's.
        EXPECT_NEAR(pencil.k_t / pencil.k_s, 1, 1e-6);
        expect_exact_to_first_order(scene.camera, solid, {200.5 + off, 200.5}, 2, 1e-3, 1e-5);
    }
}

TEST(PencilMaps, AtGrazingIncidenceFollowTheRaysToFirstOrder) {
    // A slab seen along its top: the cosine falls to 1e-4.
    const Solid solid = slab(1);
    for (const double height : {1.0, 0.1, 0.01, 1e-3}) {
        SCOPED_TRACE(height);
        Scene scene = plain_scene(solid);
        scene.camera.width = scene.camera.height = 400;
        scene.camera.position = {-10, 0, height};
        scene.camera.look_at = {0, 0, 0};
        scene.camera.up = {0, 0, 1};
        scene.camera.fov = 1e-3 * height;
        // The step is small compared with the remaining angle.
        expect_exact_to_first_order(scene.camera, solid, {200.5, 200.5}, 2, 1e-2, 1e-4);
        expect_exact_to_first_order(scene.camera, solid, {200.5, 200.5}, 3, 1e-2, 1e-4);
    }
}

// Parallel rays stay parallel at planes: every kind of map is exact everywhere, not only around its
// middle ray.
TEST(PencilMaps, OfAParallelCameraAreExactOfEveryKind) {
    std::mt19937_64 random(20271);
    std::uniform_real_distribution<double> pixel(150, 250);
    for (int i = 0; i < 30; ++i) {
        SCOPED_TRACE("seed 20271, case " + std::to_string(i));
        Scene scene = plain_scene(random_stone(random, 12));
        scene.camera.width = scene.camera.height = 400;
        look(scene, random_direction(random), 10);
        scene.camera.orthographic_width = 4;
        const ScreenView view = screen_view(scene.camera);
        const EyeRays eyes(scene.camera);
        const ScreenPoint at{pixel(random), pixel(random)};
        const std::vector<Plane> met =
            planes_met(scene.stone.solid, eyes.through(at.x, at.y), 2 + i % 6, k_stone);
        const Pencil pencil = pencil_through(view, at, met.front(), k_stone);
        const double x = pixel(random), y = pixel(random);
        const Vec3 point = walk_along(eyes.through(x, y), met, k_stone).point;
        for (const Refraction kind :
             {Refraction::astigmatic, Refraction::perspective, Refraction::parallel}) {
            const ScreenPoint p = seen(map_at(view, at, met, k_stone, kind, pencil), point);
            EXPECT_NEAR(p.x, x, 1e-8);
            EXPECT_NEAR(p.y, y, 1e-8);
        }
    }
}

// From a distance rays are nearly parallel: the three kinds differ by a map's depth over the
// distance, times the offset in pixels.
TEST(PencilMaps, OfAllKindsAgreeFromFarAway) {
    std::mt19937_64 random(20272);
    for (int i = 0; i < 10; ++i) {
        SCOPED_TRACE("seed 20272, case " + std::to_string(i));
        Scene scene = plain_scene(random_stone(random, 12));
        scene.camera.width = scene.camera.height = 400;
        look(scene, random_direction(random), 1e6, 1.2);
        const ScreenView view = screen_view(scene.camera);
        const EyeRays eyes(scene.camera);
        const ScreenPoint at{200.5, 200.5};
        const std::vector<Plane> met =
            planes_met(scene.stone.solid, eyes.through(at.x, at.y), 5, k_stone);
        const Pencil pencil = pencil_through(view, at, met.front(), k_stone);
        const Vec3 point = walk_along(eyes.through(230, 180), met, k_stone).point;
        for (const Refraction kind :
             {Refraction::astigmatic, Refraction::perspective, Refraction::parallel}) {
            const ScreenPoint p = seen(map_at(view, at, met, k_stone, kind, pencil), point);
            // Depths of some 10 over 1e6, at 30 pixels; grazing front facets of some stones make it
            // ten times more.
            EXPECT_NEAR(p.x, 230, 1e-2);
            EXPECT_NEAR(p.y, 180, 1e-2);
        }
    }
}

// A reflection is its own inverse and keeps the mirror's points in place.
TEST(Foldings, MirrorBackAndForth) {
    std::mt19937_64 random(20273);
    for (int i = 0; i < 20; ++i) {
        const Plane plane{random_direction(random), 0.7};
        const Folding once = Folding().mirrored(plane), twice = once.mirrored(plane);
        const Vec3 p = 3.0 * random_direction(random);
        EXPECT_NEAR(glm::length(twice.point(p) - p), 0, 1e-14);
        EXPECT_NEAR(height_above(plane, once.point(p)), -height_above(plane, p), 1e-14);
        const Vec3 on = p - height_above(plane, p) * plane.normal;
        EXPECT_NEAR(glm::length(once.point(on) - on), 0, 1e-14);
    }
}

}  // namespace
