// Expected values of angles.

#include "fit/model/residuals.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "fit/model/eigenvector.h"

namespace culet {

namespace {

using By = Quantity::By;

// Acute angle between unit vectors, 0..pi/2, and its slopes. Both arguments of atan2 keep full
// precision near 0 and near pi/2. The slope is set to zero for parallel vectors.
struct AcuteAngle {
    double value;
    Vec3 by_a, by_b;
};
AcuteAngle acute_angle(const Vec3& a, const Vec3& b) {
    const double s = glm::length(glm::cross(a, b)), c = glm::dot(a, b);
    const double sign = c < 0 ? -1 : 1;
    AcuteAngle angle{std::atan2(s, std::abs(c)), Vec3(0), Vec3(0)};
    if (s > 0) {
        // d(angle) = -sign (b - c a)/s . da for steps da normal to a
        angle.by_a = -sign * (b - c * a) / s;
        angle.by_b = -sign * (a - c * b) / s;
    }
    return angle;
}

double wrapped(double angle) {
    const double pi = std::numbers::pi;
    double w = std::remainder(angle, 2 * pi);
    if (w <= -pi) w += 2 * pi;
    return w;
}

}  // namespace

Formula tilt_from_up(int facet) {
    return [=](const Shape& shape) {
        const AcuteAngle angle = acute_angle(shape.normals[facet], Vec3{0, 0, 1});
        Quantity q{angle.value, {}};
        q.add(By::normal, facet, angle.by_a);
        return q;
    };
}

Formula tilt_from_side(int facet, int side) {
    return [=](const Shape& shape) {
        const Vec3& n = shape.normals[facet];
        const double flat = std::hypot(n.x, n.y);
        Quantity q{std::atan2(flat, side * n.z), {}};
        // d(angle) = (side z d(flat) - side flat dz) on the unit circle of (flat, z)
        if (flat > 0) {
            q.add(By::normal, facet,
                  Vec3{side * n.z * n.x / flat, side * n.z * n.y / flat, -side * flat});
        }
        return q;
    };
}

Formula horizontal_component(int facet, int component) {
    return [=](const Shape& shape) {
        Vec3 direction(0);
        direction[component] = 1;
        Quantity q{shape.normals[facet][component], {}};
        q.add(By::normal, facet, direction);
        return q;
    };
}

Formula tilt_between(int facet, int datum) {
    return [=](const Shape& shape) {
        const AcuteAngle angle = acute_angle(shape.normals[facet], shape.normals[datum]);
        Quantity q{angle.value, {}};
        q.add(By::normal, facet, angle.by_a);
        q.add(By::normal, datum, angle.by_b);
        return q;
    };
}

Formula tilt_from_axis(int facet, std::vector<int> girdle_facets) {
    return [facet, girdle = std::move(girdle_facets)](const Shape& shape) {
        glm::dmat3 scatter(0.0);
        for (int g : girdle) {
            scatter += glm::outerProduct(shape.normals[g], shape.normals[g]);
        }
        const LeastEigenvector least = least_eigenvector(scatter);
        const AcuteAngle angle = acute_angle(shape.normals[facet], least.vector);
        Quantity q{angle.value, {}};
        q.add(By::normal, facet, angle.by_a);
        const Vec3 back = least.pseudo_inverse * angle.by_b;  // symmetric
        for (int g : girdle) {
            // d(vector) = -(S - l)^+ dS vector, with dS = dn n' + n dn'
            const Vec3& n = shape.normals[g];
            q.add(By::normal, g,
                  -(back * glm::dot(n, least.vector) + least.vector * glm::dot(n, back)));
        }
        return q;
    };
}

Formula tilt_from_plane(int facet, std::vector<Corner> corners) {
    return [facet, corners = std::move(corners)](const Shape& shape) {
        Vec3 mean(0);
        for (const Corner& c : corners) mean += place_of(shape, c);
        mean /= static_cast<double>(corners.size());
        glm::dmat3 scatter(0.0);
        for (const Corner& c : corners) {
            const Vec3 r = place_of(shape, c) - mean;
            scatter += glm::outerProduct(r, r);
        }
        const LeastEigenvector least = least_eigenvector(scatter);
        const AcuteAngle angle = acute_angle(shape.normals[facet], least.vector);
        Quantity q{angle.value, {}};
        q.add(By::normal, facet, angle.by_a);
        const Vec3 back = least.pseudo_inverse * angle.by_b;
        for (const Corner& c : corners) {
            // The mean's own derivative drops out: the r sum to zero.
            const Vec3 r = place_of(shape, c) - mean;
            add_corner(q, shape, c,
                       -(back * glm::dot(r, least.vector) + least.vector * glm::dot(r, back)));
        }
        return q;
    };
}

Formula azimuth_error(int facet, int datum, double value) {
    return [=](const Shape& shape) {
        const auto one = [&](Quantity& q, int f, double factor) {
            const Vec3& n = shape.normals[f];
            const double r2 = n.x * n.x + n.y * n.y;
            q.value += factor * std::atan2(n.y, n.x);
            if (r2 > 0) q.add(By::normal, f, factor * Vec3{-n.y, n.x, 0} / r2);
        };
        Quantity q{-value, {}};
        one(q, facet, 1);
        if (datum >= 0) one(q, datum, -1);
        q.value = wrapped(q.value);
        return q;
    };
}

Formula interior_angle(int facet, int other) {
    return [=](const Shape& shape) {
        const Vec3 &a = shape.normals[facet], &b = shape.normals[other];
        const double s = glm::length(glm::cross(a, b)), c = glm::dot(a, b);
        Quantity q{std::numbers::pi - std::atan2(s, c), {}};
        if (s > 0) {
            q.add(By::normal, facet, (b - c * a) / s);
            q.add(By::normal, other, (a - c * b) / s);
        }
        return q;
    };
}

}  // namespace culet
