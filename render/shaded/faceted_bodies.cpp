#include "render/shaded/faceted_bodies.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include "stone/solid/facet_triangles.h"

namespace culet {

namespace {

constexpr int k_sphere_rows = 24;  // from pole to pole; twice as many around

using Faces = std::vector<std::vector<int>>;

Vec3 area_vector(const std::vector<Vec3>& vertices, const std::vector<int>& face) {
    Vec3 sum(0);
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
        sum += 0.5 * glm::cross(vertices[face[i]] - vertices[face[0]],
                                vertices[face[i + 1]] - vertices[face[0]]);
    return sum;
}

Vec3 unit_or(const Vec3& v, const Vec3& other) {
    const double length = glm::length(v);
    return length > 0 ? v / length : other;
}

// Gives vertices at the same place the same number.
std::vector<int> places_of(const std::vector<Vec3>& vertices) {
    std::map<std::tuple<double, double, double>, int> known;
    std::vector<int> places;
    for (const Vec3& v : vertices)
        places.push_back(
            known.emplace(std::tuple(v.x, v.y, v.z), static_cast<int>(known.size())).first->second);
    return places;
}

// `triangles`: per face.
FacetedBody body_of(std::vector<Vec3> vertices, const Faces& faces,
                    const std::vector<std::vector<std::array<int, 3>>>& triangles) {
    FacetedBody body;
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->vertices = std::move(vertices);
    const std::vector<int> places = places_of(mesh->vertices);
    std::vector<Vec3> sums(mesh->vertices.size(), Vec3(0));
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const Vec3 area = area_vector(mesh->vertices, faces[f]);
        FacetedBody::Face face;
        for (const int corner : faces[f]) {
            face.middle += mesh->vertices[corner] / static_cast<double>(faces[f].size());
            sums[places[corner]] += area;
        }
        face.normal = unit_or(area, face.normal);
        body.facets.push_back(face);
        for (const auto& t : triangles[f]) {
            mesh->triangles.push_back(t);
            body.facet_of.push_back(static_cast<int>(f));
        }
    }
    for (std::size_t t = 0; t < mesh->triangles.size(); ++t) {
        const Vec3 flat = body.facets[body.facet_of[t]].normal;
        std::array<Vec3, 3> normals;
        for (std::size_t k = 0; k < 3; ++k)
            normals[k] = unit_or(sums[places[mesh->triangles[t][k]]], flat);
        body.corner_normals.push_back(normals);
    }
    body.mesh = std::move(mesh);
    return body;
}

FacetedBody body_of(const Solid& solid) {
    Faces faces;
    std::vector<std::vector<std::array<int, 3>>> triangles;
    for (const Facet& facet : solid.facets) {
        faces.push_back(facet.corners);
        triangles.push_back(facet_triangles(solid, facet));
    }
    return body_of(solid.vertices, faces, triangles);
}

FacetedBody body_of(const TriangleMesh& mesh) {
    Faces faces;
    std::vector<std::vector<std::array<int, 3>>> triangles;
    for (const auto& t : mesh.triangles) {
        faces.push_back({t[0], t[1], t[2]});
        triangles.push_back({t});
    }
    FacetedBody body = body_of(mesh.vertices, faces, triangles);
    if (!mesh.corner_normals.empty()) body.corner_normals = mesh.corner_normals;
    return body;
}

FacetedBody body_of(const BoxShape& box) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        Vec3 corner = box.center;
        for (int axis = 0; axis < 3; ++axis)
            corner += ((i >> axis) % 2 == 1 ? 1.0 : -1.0) * box.half[axis] * box.axes[axis];
        corners.push_back(corner);
    }
    const Faces faces{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                      {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    std::vector<std::vector<std::array<int, 3>>> triangles;
    for (const auto& f : faces) triangles.push_back({{f[0], f[1], f[2]}, {f[0], f[2], f[3]}});
    return body_of(corners, faces, triangles);
}

FacetedBody body_of(const SphereShape& sphere) {
    constexpr int k_columns = 2 * k_sphere_rows;
    std::vector<Vec3> vertices{sphere.center + Vec3(0, 0, sphere.radius)};
    for (int row = 1; row < k_sphere_rows; ++row) {
        const double polar = std::numbers::pi * row / k_sphere_rows;
        for (int column = 0; column < k_columns; ++column) {
            const double azimuth = 2 * std::numbers::pi * column / k_columns;
            vertices.push_back(sphere.center +
                               sphere.radius * Vec3(std::sin(polar) * std::cos(azimuth),
                                                    std::sin(polar) * std::sin(azimuth),
                                                    std::cos(polar)));
        }
    }
    vertices.push_back(sphere.center - Vec3(0, 0, sphere.radius));
    const int last = static_cast<int>(vertices.size()) - 1;
    Faces faces;
    for (int column = 0; column < k_columns; ++column) {
        const int next = (column + 1) % k_columns;
        faces.push_back({0, 1 + column, 1 + next});
        for (int row = 0; row + 2 < k_sphere_rows; ++row) {
            const int above = 1 + row * k_columns, below = above + k_columns;
            faces.push_back({above + column, below + column, below + next, above + next});
        }
        faces.push_back({last, last - k_columns + next, last - k_columns + column});
    }
    std::vector<std::vector<std::array<int, 3>>> triangles;
    for (const auto& f : faces) {
        triangles.push_back({{f[0], f[1], f[2]}});
        if (f.size() == 4) triangles.back().push_back({f[0], f[2], f[3]});
    }
    return body_of(vertices, faces, triangles);
}

double size_of(const Shape& shape) {
    if (const auto* sphere = std::get_if<SphereShape>(&shape)) return 2 * sphere->radius;
    if (const auto* box = std::get_if<BoxShape>(&shape))
        return 2 * std::min({box->half.x, box->half.y, box->half.z});
    if (const auto* mesh = std::get_if<MeshShape>(&shape)) {
        Vec3 low(std::numeric_limits<double>::infinity()), high(-low);
        for (const Vec3& v : mesh->mesh->vertices) {
            low = glm::min(low, v);
            high = glm::max(high, v);
        }
        return std::min({high.x - low.x, high.y - low.y, high.z - low.z});
    }
    return 0;
}

}  // namespace

std::array<double, 3> FacetedBody::weights(int triangle, const Vec3& point) const {
    const auto& t = mesh->triangles[static_cast<std::size_t>(triangle)];
    const auto corner = [&](std::size_t k) { return mesh->vertices[t[k]]; };
    const Vec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    std::array<double, 3> parts;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = corner((k + 1) % 3), b = corner((k + 2) % 3);
        parts[k] = std::max(0.0, glm::dot(glm::cross(b - a, point - a), normal));
        sum += parts[k];
    }
    if (!(sum > 0)) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
    for (double& part : parts) part /= sum;
    return parts;
}

FacetedBodies::FacetedBodies(const Scene& scene, bool tessellated) {
    Scene furniture;
    furniture.stone.solid = {};
    for (const SceneObject& object : scene.objects) {
        std::unique_ptr<FacetedBody> body;
        if (const auto* mesh = std::get_if<MeshShape>(&object.shape)) {
            body = std::make_unique<FacetedBody>(body_of(*mesh->mesh));
        } else if (const auto* box = std::get_if<BoxShape>(&object.shape)) {
            body = std::make_unique<FacetedBody>(body_of(*box));
        } else if (const auto* sphere = std::get_if<SphereShape>(&object.shape);
                   sphere && tessellated) {
            body = std::make_unique<FacetedBody>(body_of(*sphere));
        }
        furniture.objects.push_back(object);
        if (body) furniture.objects.back().shape = MeshShape{body->mesh};
        bodies_.push_back(std::move(body));
        surfaces_.push_back(plain_surface(object.material, size_of(object.shape)));
    }
    const auto add_stone = [&](const Stone& stone) {
        auto body = std::make_unique<FacetedBody>(body_of(stone.solid));
        furniture.objects.push_back({MeshShape{body->mesh}, DiffuseMaterial{}});
        bodies_.push_back(std::move(body));
        surfaces_.push_back(plain_surface(stone));
    };
    if (scene.has_stone()) add_stone(scene.stone);
    for (const Stone& stone : scene.more_stones) add_stone(stone);
    world_ = std::make_unique<const ObjectWorld>(furniture);
}

Vec3 FacetedBodies::middle(int i) const {
    const Shape& shape = world_->objects()[static_cast<std::size_t>(i)].shape;
    if (const auto* plane = std::get_if<PlaneShape>(&shape)) return plane->point;
    if (const auto* disc = std::get_if<DiscShape>(&shape)) return disc->center;
    if (const auto* sphere = std::get_if<SphereShape>(&shape)) return sphere->center;
    return Vec3(0);
}

Vec3 middle_of(const Scene& scene) {
    Vec3 low(std::numeric_limits<double>::infinity()), high(-low);
    const auto include = [&](const Vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    };
    const auto include_ball = [&](const Vec3& center, double radius) {
        include(center - Vec3(radius));
        include(center + Vec3(radius));
    };
    for (const Vec3& v : scene.stone.solid.vertices) include(v);
    for (const Stone& stone : scene.more_stones) {
        for (const Vec3& v : stone.solid.vertices) include(v);
    }
    for (const SceneObject& object : scene.objects) {
        if (const auto* sphere = std::get_if<SphereShape>(&object.shape)) {
            include_ball(sphere->center, sphere->radius);
        } else if (const auto* disc = std::get_if<DiscShape>(&object.shape)) {
            include_ball(disc->center, disc->radius);
        } else if (const auto* box = std::get_if<BoxShape>(&object.shape)) {
            include_ball(box->center, glm::length(box->half));
        } else if (const auto* mesh = std::get_if<MeshShape>(&object.shape)) {
            for (const Vec3& v : mesh->mesh->vertices) include(v);
        }
    }
    return low.x <= high.x ? 0.5 * (low + high) : scene.camera.look_at;
}

}  // namespace culet
