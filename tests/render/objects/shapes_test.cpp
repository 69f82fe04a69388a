// Where rays meet spheres, planes, discs, boxes and meshes.

#include "render/objects/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/geometry/polyhedron_body.h"
#include "render/objects/mesh_tree.h"
#include "render/objects/object_world.h"
#include "tests/render/ray_stones.h"

namespace culet {
namespace {

// Elementary geometry: from 5 above a unit sphere; from its middle; past it; away from it.
TEST(Shapes, SpheresAreMetFromOutsideAndInside) {
    const SphereShape sphere{{0, 0, 1}, 2};
    const auto above = nearest_on(sphere, {0, 0, 8}, {0, 0, -1}, -1);
    ASSERT_TRUE(above);
    EXPECT_DOUBLE_EQ(above->distance, 5);
    EXPECT_EQ(above->normal, Vec3(0, 0, 1));
    const auto within = nearest_on(sphere, {0, 0, 1}, {1, 0, 0}, -1);
    ASSERT_TRUE(within);
    EXPECT_DOUBLE_EQ(within->distance, 2);
    EXPECT_FALSE(nearest_on(sphere, {2.1, 0, 8}, {0, 0, -1}, -1));
    EXPECT_FALSE(nearest_on(sphere, {0, 0, 8}, {0, 0, 1}, -1));
}

// A ray that starts on the surface does not meet its starting point again, whatever the rounding
// error; it meets the far side.
TEST(Shapes, ARayFromASphereMeetsItsFarSideAlone) {
    std::mt19937_64 random(1);
    const SphereShape sphere{{0.3, -0.2, 0.1}, 1.7};
    for (int i = 0; i < 10000; ++i) {
        const Vec3 n = random_direction(random), d = random_direction(random);
        const Vec3 start = on_surface(sphere, sphere.center + sphere.radius * n, 0);
        const auto hit = nearest_on(sphere, start, d, 0);
        // A chord is 2 r cos long.
        const double chord = -2 * sphere.radius * glm::dot(n, d);
        ASSERT_EQ(hit.has_value(), chord > 0);
        if (hit) {
            EXPECT_NEAR(hit->distance, chord, 1e-14);
        }
    }
}

TEST(Shapes, PlanesAndDiscs) {
    const PlaneShape plane{{0, 0, -1}, {0, 0, 1}};
    const Vec3 down = glm::normalize(Vec3{3, 0, -4});
    const auto hit = nearest_on(plane, {0, 0, 3}, down, -1);
    ASSERT_TRUE(hit);
    EXPECT_DOUBLE_EQ(hit->distance, 5);
    EXPECT_FALSE(nearest_on(plane, {0, 0, 3}, {1, 0, 0}, -1));
    EXPECT_FALSE(nearest_on(plane, {0, 0, -1}, down, 0));
    EXPECT_TRUE(nearest_on(plane, {0, 0, -2}, {0, 0, 1}, -1));
    EXPECT_TRUE(nearest_on(DiscShape{{3, 0, -1}, {0, 0, 1}, 0.01}, {0, 0, 3}, down, -1));
    EXPECT_FALSE(nearest_on(DiscShape{{3, 0.02, -1}, {0, 0, 1}, 0.01}, {0, 0, 3}, down, -1));
}

// An independent method: the same box as a solid of planes, intersected without an epsilon.
TEST(Shapes, BoxesAreMetAsTheSolidOfTheirPlanes) {
    std::mt19937_64 random(2);
    BoxShape box;
    box.center = {0.2, -0.1, 0.4};
    box.half = {0.5, 1, 0.8};
    box.axes[0] = glm::normalize(Vec3{1, 2, 0.5});
    box.axes[1] = glm::normalize(glm::cross(box.axes[0], Vec3{0, 0, 1}));
    box.axes[2] = glm::cross(box.axes[0], box.axes[1]);
    std::vector<NamedPlane> planes;
    for (int face = 0; face < 6; ++face) {
        const Vec3 n = (face % 2 == 1 ? 1.0 : -1.0) * box.axes[static_cast<std::size_t>(face / 2)];
        planes.push_back({"p", {n, glm::dot(n, box.center) + box.half[face / 2]}});
    }
    const ConvexBody body(intersect_half_spaces(planes).solid);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const EyeRay ray = random_ray(random);
        const auto hit = nearest_on(box, ray.origin, ray.direction, -1);
        const auto wanted = body.entry(ray.origin, ray.direction);
        ASSERT_EQ(hit.has_value(), wanted.has_value());
        if (!hit) continue;
        ++hits;
        EXPECT_NEAR(hit->distance, wanted->distance, 1e-13);
        EXPECT_NEAR(glm::length(hit->normal - body.normal(wanted->facet)), 0, 1e-14);
        // Inwards from there, and out again at the solid's exit.
        const Vec3 at = on_surface(box, ray.origin + hit->distance * ray.direction, hit->part);
        const auto out = nearest_on(box, at, ray.direction, hit->part);
        ASSERT_TRUE(out);
        EXPECT_NEAR(out->distance, body.exit(at, ray.direction).distance, 1e-13);
        // Reflected off the face, the ray does not meet the box again.
        const Vec3 away = ray.direction - 2 * glm::dot(ray.direction, hit->normal) * hit->normal;
        EXPECT_FALSE(nearest_on(box, at, away, hit->part));
    }
    EXPECT_GT(hits, 2000);
}

std::shared_ptr<const TriangleMesh> mesh_of(const Solid& solid) {
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->vertices = solid.vertices;
    for (const Facet& facet : solid.facets) {
        for (std::size_t i = 1; i + 1 < facet.corners.size(); ++i)
            mesh->triangles.push_back({facet.corners[0], facet.corners[i], facet.corners[i + 1]});
    }
    return mesh;
}

// An independent method: the same surface as a watertight polyhedron. Single precision finds the
// triangle; next to an edge it may find the neighbour instead, to within its rounding error.
TEST(Meshes, AreMetAsThePolyhedronOfTheirFaces) {
    std::mt19937_64 random(3);
    const Solid solid = random_stone(random, 40);
    const PolyhedronBody body(solid);
    const MeshTree tree({{MeshShape{mesh_of(solid)}, DiffuseMaterial{}}});
    constexpr double k_single = 1e-5;
    int hits = 0, differ = 0;
    for (int i = 0; i < 20000; ++i) {
        EyeRay ray = random_ray(random);
        ray.origin *= i % 2 == 0 ? 1 : 1e6;
        if (i % 2 == 1) ray.direction = glm::normalize(random_direction(random) - ray.origin);
        const auto hit = tree.nearest(ray.origin, ray.direction);
        const auto wanted = body.entry(ray.origin, ray.direction);
        if (hit.has_value() != wanted.has_value()) {
            ++differ;
            continue;
        }
        if (!hit) continue;
        ++hits;
        const double off = std::abs(hit->distance - wanted->distance);
        const bool same = glm::length(hit->normal - body.normal(wanted->facet)) < 1e-9;
        EXPECT_LT(off, same ? 1e-9 * wanted->distance : k_single);
    }
    EXPECT_GT(hits, 8000);
    // So few rays pass within 1e-6 of an edge of the outline, which is some 10 long.
    EXPECT_LE(differ, 2);
}

// Convex: no ray that leaves a triangle outwards meets the mesh again.
TEST(Meshes, AreNotMetWhereARayStarts) {
    std::mt19937_64 random(4);
    const Solid solid = random_stone(random, 40);
    Scene scene;
    scene.objects = {{MeshShape{mesh_of(solid)}, DiffuseMaterial{}}};
    const ObjectWorld world(scene);
    for (int i = 0; i < 20000; ++i) {
        const EyeRay ray = random_ray(random);
        const WorldHit hit = world.nearest(ray.origin, ray.direction, {});
        if (!hit.met()) continue;
        const Vec3 at = world.place(hit, ray.origin, ray.direction);
        Vec3 away = random_direction(random);
        if (glm::dot(away, hit.normal) < 0) away = -away;
        EXPECT_FALSE(world.nearest(at, away, {hit.object, hit.part, -1}).met());
        EXPECT_TRUE(world.nearest(at, -away, {hit.object, hit.part, -1}).met());
    }
}

}  // namespace
}  // namespace culet
