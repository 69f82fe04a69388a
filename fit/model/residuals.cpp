#include "fit/model/residuals.h"

#include <glm/geometric.hpp>

namespace culet {

namespace {

using By = Quantity::By;

}  // namespace

void Quantity::add(const Quantity& other, double factor) {
    value += factor * other.value;
    for (const Slope& s : other.slopes) add(s.by, s.index, factor * s.slope);
}

Vec3 place_of(const Shape& shape, const Corner& corner) {
    if (corner.point >= 0) return shape.points[corner.point];
    const auto& [i, j, k] = corner.planes;
    const Vec3 &a = shape.normals[i], &b = shape.normals[j], &c = shape.normals[k];
    const double det = glm::dot(a, glm::cross(b, c));
    return (shape.offsets[i] * glm::cross(b, c) + shape.offsets[j] * glm::cross(c, a) +
            shape.offsets[k] * glm::cross(a, b)) /
           det;
}

void add_corner(Quantity& quantity, const Shape& shape, const Corner& corner, const Vec3& slope) {
    if (corner.point >= 0) {
        quantity.add(By::point, corner.point, slope);
        return;
    }
    const Vec3 p = place_of(shape, corner);
    const auto& [i, j, k] = corner.planes;
    const Vec3 &a = shape.normals[i], &b = shape.normals[j], &c = shape.normals[k];
    const double det = glm::dot(a, glm::cross(b, c));
    const std::array<double, 3> y{glm::dot(slope, glm::cross(b, c)) / det,
                                  glm::dot(slope, glm::cross(c, a)) / det,
                                  glm::dot(slope, glm::cross(a, b)) / det};
    for (std::size_t m = 0; m < 3; ++m) {
        quantity.add(By::offset, corner.planes[m], y[m]);
        quantity.add(By::normal, corner.planes[m], -y[m] * p);
    }
}

Formula mean_of(std::vector<Formula> terms) {
    return [terms = std::move(terms)](const Shape& shape) {
        Quantity q;
        for (const Formula& term : terms) {
            q.add(term(shape), 1.0 / static_cast<double>(terms.size()));
        }
        return q;
    };
}

Formula weighted_sum(std::vector<std::pair<double, Formula>> terms) {
    return [terms = std::move(terms)](const Shape& shape) {
        Quantity q;
        for (const auto& [weight, term] : terms) q.add(term(shape), weight);
        return q;
    };
}

Formula extra_unknown(int extra) {
    return [=](const Shape& shape) {
        Quantity q{shape.extras[std::size_t(extra)], {}};
        q.add(By::extra, extra, 1);
        return q;
    };
}

Formula normal_difference(int f, int g, double sign, const Vec3& direction) {
    return [=](const Shape& shape) {
        Quantity q{glm::dot(direction, shape.normals[f] - sign * shape.normals[g]), {}};
        q.add(By::normal, f, direction);
        q.add(By::normal, g, -sign * direction);
        return q;
    };
}

Formula offset_difference(int f, int g, double sign) {
    return [=](const Shape& shape) {
        Quantity q{shape.offsets[f] - sign * shape.offsets[g], {}};
        q.add(By::offset, f, 1.0);
        q.add(By::offset, g, -sign);
        return q;
    };
}

Formula point_component(int point, const Vec3& direction, double value) {
    return [=](const Shape& shape) {
        Quantity q{glm::dot(direction, shape.points[point]) - value, {}};
        q.add(By::point, point, direction);
        return q;
    };
}

}  // namespace culet
