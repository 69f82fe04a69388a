// Deviations of facets from being each other's images.

#include "fit/model/residuals.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace culet {

namespace {

using By = Quantity::By;

Vec3 turned(const Vec3& v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

Vec3 mean_place(const Shape& shape, const std::vector<Corner>& corners) {
    Vec3 mean(0);
    for (const Corner& c : corners) {
        mean += place_of(shape, c) / static_cast<double>(corners.size());
    }
    return mean;
}

double mirror_azimuth(const Shape& shape, const MirrorPlane& plane) {
    return plane.azimuth < 0 ? plane.fixed_azimuth : shape.extras[plane.azimuth];
}

}  // namespace

Formula turned_normal(int f, int g, double angle, const Vec3& direction) {
    return [=](const Shape& shape) {
        Quantity q{glm::dot(direction, turned(shape.normals[f], angle) - shape.normals[g]), {}};
        q.add(By::normal, f, turned(direction, -angle));
        q.add(By::normal, g, -direction);
        return q;
    };
}

Formula turned_height(std::vector<Corner> corners, int g, double angle, int centre) {
    return [=, corners = std::move(corners)](const Shape& shape) {
        const Vec3 c{shape.extras[centre], shape.extras[centre + 1], 0};
        const Vec3 image = turned(mean_place(shape, corners) - c, angle) + c;
        const Vec3& n = shape.normals[g];
        Quantity q{glm::dot(n, image) - shape.offsets[g], {}};
        q.add(By::normal, g, image);
        q.add(By::offset, g, -1.0);
        const Vec3 back = turned(n, -angle);
        for (const Corner& corner : corners) {
            add_corner(q, shape, corner, back / static_cast<double>(corners.size()));
        }
        q.add(By::extra, centre, n.x - back.x);
        q.add(By::extra, centre + 1, n.y - back.y);
        return q;
    };
}

Formula mirrored_normal(int f, int g, const MirrorPlane& plane, const Vec3& direction) {
    return [=](const Shape& shape) {
        const double a = mirror_azimuth(shape, plane);
        const Vec3 m{std::cos(a), std::sin(a), 0}, dm{-std::sin(a), std::cos(a), 0};
        const Vec3& n = shape.normals[f];
        Quantity q{glm::dot(direction, n - 2 * glm::dot(m, n) * m - shape.normals[g]), {}};
        q.add(By::normal, f, direction - 2 * glm::dot(m, direction) * m);
        q.add(By::normal, g, -direction);
        if (plane.azimuth >= 0) {
            q.add(By::extra, plane.azimuth,
                  -2 * (glm::dot(dm, n) * glm::dot(direction, m) +
                        glm::dot(m, n) * glm::dot(direction, dm)));
        }
        return q;
    };
}

Formula mirrored_height(std::vector<Corner> corners, int g, const MirrorPlane& plane) {
    return [=, corners = std::move(corners)](const Shape& shape) {
        const double a = mirror_azimuth(shape, plane), e = shape.extras[plane.offset];
        const Vec3 m{std::cos(a), std::sin(a), 0}, dm{-std::sin(a), std::cos(a), 0};
        const Vec3 x = mean_place(shape, corners);
        const Vec3& n = shape.normals[g];
        const double above = glm::dot(m, x) - e;
        const Vec3 image = x - 2 * above * m;
        Quantity q{glm::dot(n, image) - shape.offsets[g], {}};
        q.add(By::normal, g, image);
        q.add(By::offset, g, -1.0);
        const Vec3 back = n - 2 * glm::dot(m, n) * m;
        for (const Corner& corner : corners) {
            add_corner(q, shape, corner, back / static_cast<double>(corners.size()));
        }
        q.add(By::extra, plane.offset, 2 * glm::dot(m, n));
        if (plane.azimuth >= 0) {
            q.add(By::extra, plane.azimuth,
                  -2 * (glm::dot(dm, x) * glm::dot(m, n) + above * glm::dot(dm, n)));
        }
        return q;
    };
}

Formula across_mirror(int f, const MirrorPlane& plane) {
    return [=](const Shape& shape) {
        const double a = mirror_azimuth(shape, plane);
        const Vec3 m{std::cos(a), std::sin(a), 0}, dm{-std::sin(a), std::cos(a), 0};
        Quantity q{glm::dot(m, shape.normals[f]), {}};
        q.add(By::normal, f, m);
        if (plane.azimuth >= 0) q.add(By::extra, plane.azimuth, glm::dot(dm, shape.normals[f]));
        return q;
    };
}

Formula turned_component(int f, double angle, const Vec3& direction) {
    return [=](const Shape& shape) {
        Quantity q{glm::dot(direction, turned(shape.normals[f], angle)), {}};
        q.add(By::normal, f, turned(direction, -angle));
        return q;
    };
}

}  // namespace culet
