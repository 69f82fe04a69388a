#include "fit/model/parameters.h"
#include "fit/model/constants.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "stone/text/errors.h"

namespace culet {

namespace {

// An orthonormal basis of the kept directions.
std::vector<Vec3> directions_of(const KeptDirections& kept) {
    switch (kept.kind) {
        case KeptDirections::Kind::all:
            return {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
        case KeptDirections::Kind::vertical_plane:
            return {kept.outward, Vec3{0, 0, 1}};
        case KeptDirections::Kind::axis:
            return {Vec3{0, 0, 1}};
    }
    return {};
}

Vec3 projected(const Vec3& v, const KeptDirections& kept) {
    Vec3 sum(0);
    for (const Vec3& d : directions_of(kept)) sum += glm::dot(d, v) * d;
    return sum;
}

}  // namespace

std::array<Vec3, 2> tilt_directions(const Vec3& normal, int count, const Vec3& outward) {
    if (count == 2) return tangents(normal);
    return {normal.z * outward - glm::dot(normal, outward) * Vec3{0, 0, 1}, Vec3(0)};
}

Parameters::Parameters(const Shape& shape, int up_facet, Orbits orbits,
                       const std::vector<bool>& fixed_extras)
    : layout_(layout_of(shape)), orbits_(std::move(orbits)), up_facet_(up_facet) {
    const auto facets = std::size_t(layout_.facets), points = std::size_t(layout_.points);
    normal_column_.assign(facets, -1);
    normal_count_.assign(facets, 0);
    offset_column_.assign(facets, -1);
    point_column_.assign(points, -1);
    point_count_.assign(points, 0);
    point_along_.resize(points);
    facet_images_.assign(facets, 1);
    point_images_.assign(points, 1);
    const auto take = [&](int count, double weight) {
        const int at = size_;
        size_ += count;
        metric_.resize(std::size_t(size_), weight);
        return at;
    };
    if (!orbits_.empty()) {
        std::fill(facet_images_.begin(), facet_images_.end(), 0);
        std::fill(point_images_.begin(), point_images_.end(), 0);
        for (const OrbitMember& m : orbits_.facets) ++facet_images_[m.first];
        for (const OrbitMember& m : orbits_.points) ++point_images_[m.first];
    }
    for (int f = 0; f < layout_.facets; ++f) {
        if (!is_first_facet(f)) continue;
        const KeptDirections kept = orbits_.empty() ? KeptDirections() : orbits_.kept_by_facet[f];
        normal_count_[f] = f == up_facet_ ? 0 : static_cast<int>(directions_of(kept).size()) - 1;
        const double images = facet_images_[f];
        normal_column_[f] = take(normal_count_[f], images);
        offset_column_[f] = take(1, images);
    }
    for (int p = 0; p < layout_.points; ++p) {
        if (!is_first_point(p)) continue;
        const std::vector<Vec3> along =
            directions_of(orbits_.empty() ? KeptDirections() : orbits_.kept_by_point[p]);
        std::copy(along.begin(), along.end(), point_along_[p].begin());
        point_count_[p] = static_cast<int>(along.size());
        point_column_[p] = take(point_count_[p], k_shapes.point_weight * point_images_[p]);
    }
    extra_column_.assign(std::size_t(layout_.extras), -1);
    for (std::size_t e = 0; e < extra_column_.size(); ++e) {
        if (!fixed_extras[e]) extra_column_[e] = take(1, 1);
    }
    for (int f = 0; f < layout_.facets; ++f) {
        if (is_first_facet(f)) continue;
        const int first = orbits_.facets[f].first;
        offset_column_[f] = offset_column_[first];
        normal_column_[f] = normal_column_[first];
        normal_count_[f] = normal_count_[first];
    }
    for (int p = 0; p < layout_.points; ++p) {
        if (is_first_point(p)) continue;
        const int first = orbits_.points[p].first;
        point_column_[p] = point_column_[first];
        point_count_[p] = point_count_[first];
    }
}

Parameters::TangentBasis Parameters::tangent_basis(const Shape& shape) const {
    TangentBasis tangent_basis;
    tangent_basis.offsets = &offset_column_;
    tangent_basis.extras = &extra_column_;
    tangent_basis.normals.resize(shape.normals.size());
    tangent_basis.points.resize(shape.points.size());
    for (int f = 0; f < layout_.facets; ++f) {
        Slots& slots = tangent_basis.normals[f];
        slots.column = normal_column_[f];
        slots.count = normal_count_[f];
        const int first = orbits_.empty() ? f : orbits_.facets[f].first;
        const Vec3& n = shape.normals[first];
        if (slots.count > 0) {
            const auto [t, u] = tilt_directions(
                n, slots.count, orbits_.empty() ? Vec3(0) : orbits_.kept_by_facet[first].outward);
            slots.along = {t, u, Vec3(0)};
        }
        if (first == f) continue;
        for (int k = 0; k < slots.count; ++k) {
            slots.along[std::size_t(k)] =
                orbits_.facets[f].from_first * slots.along[std::size_t(k)];
        }
    }
    for (int p = 0; p < layout_.points; ++p) {
        Slots& slots = tangent_basis.points[p];
        slots.column = point_column_[p];
        slots.count = point_count_[p];
        const int first = orbits_.empty() ? p : orbits_.points[p].first;
        slots.along = point_along_[first];
        if (first == p) continue;
        for (int k = 0; k < slots.count; ++k) {
            slots.along[std::size_t(k)] =
                orbits_.points[p].from_first * slots.along[std::size_t(k)];
        }
    }
    return tangent_basis;
}

Shape Parameters::retracted(const Shape& shape, std::span<const double> step) const {
    check(static_cast<int>(step.size()) == size_, "a step of other freedoms");
    Shape next = shape;
    const TangentBasis at = tangent_basis(shape);
    for (int f = 0; f < layout_.facets; ++f) {
        if (!is_first_facet(f)) continue;
        const Slots& slots = at.normals[f];
        for (int k = 0; k < slots.count; ++k) {
            next.normals[f] += step[slots.column + k] * slots.along[std::size_t(k)];
        }
        if (slots.count > 0) next.normals[f] = glm::normalize(next.normals[f]);
        next.offsets[f] += step[offset_column_[f]];
    }
    for (int p = 0; p < layout_.points; ++p) {
        if (!is_first_point(p)) continue;
        const Slots& slots = at.points[p];
        for (int k = 0; k < slots.count; ++k) {
            next.points[p] += step[slots.column + k] * slots.along[std::size_t(k)];
        }
    }
    for (std::size_t e = 0; e < extra_column_.size(); ++e) {
        if (extra_column_[e] >= 0) next.extras[e] += step[extra_column_[e]];
    }
    place_images(next);
    return next;
}

void Parameters::place_images(Shape& shape) const {
    if (orbits_.empty()) return;
    for (int f = 0; f < layout_.facets; ++f) {
        const OrbitMember& m = orbits_.facets[f];
        if (m.first == f) continue;
        shape.normals[f] = m.from_first * shape.normals[m.first];
        shape.offsets[f] = shape.offsets[m.first];
    }
    for (int p = 0; p < layout_.points; ++p) {
        const OrbitMember& m = orbits_.points[p];
        if (m.first != p) shape.points[p] = m.from_first * shape.points[m.first];
    }
}

Shape Parameters::retracted_with_turn(const Shape& shape, std::span<const double> step) const {
    if (!orbits_.empty()) return retracted(shape, step);
    double along = 0, size = 0;
    for (int p = 0; p < layout_.points; ++p) {
        const Vec3 turn{-shape.points[p].y, shape.points[p].x, 0};
        const int at = point_column_[p];
        along += turn.x * step[at] + turn.y * step[at + 1];
        size += glm::dot(turn, turn);
    }
    const double angle = size > 0 ? along / size : 0;
    std::vector<double> rest(step.begin(), step.end());
    for (int p = 0; p < layout_.points; ++p) {
        rest[point_column_[p]] += angle * shape.points[p].y;
        rest[point_column_[p] + 1] -= angle * shape.points[p].x;
    }
    for (int f = 0; f < layout_.facets; ++f) {
        if (normal_count_[f] != 2) continue;
        const Vec3 turn{-shape.normals[f].y, shape.normals[f].x, 0};
        const auto [t, u] = tangents(shape.normals[f]);
        rest[normal_column_[f]] -= angle * glm::dot(t, turn);
        rest[normal_column_[f] + 1] -= angle * glm::dot(u, turn);
    }
    return turned_about_z(retracted(shape, rest), angle);
}

Shape Parameters::symmetrised(const Shape& shape) const {
    Shape result = shape;
    if (up_facet_ >= 0) result.normals[up_facet_] = Vec3{0, 0, 1};
    if (orbits_.empty()) return result;
    std::vector<Vec3> normals(shape.normals.size(), Vec3(0)), points(shape.points.size(), Vec3(0));
    std::vector<double> offsets(shape.normals.size(), 0);
    for (int f = 0; f < layout_.facets; ++f) {
        const OrbitMember& m = orbits_.facets[f];
        normals[m.first] += glm::transpose(m.from_first) * result.normals[f];
        offsets[m.first] += shape.offsets[f] / facet_images_[m.first];
    }
    for (int p = 0; p < layout_.points; ++p) {
        const OrbitMember& m = orbits_.points[p];
        points[m.first] +=
            glm::transpose(m.from_first) * shape.points[p] / double(point_images_[m.first]);
    }
    for (int f = 0; f < layout_.facets; ++f) {
        const OrbitMember& m = orbits_.facets[f];
        if (m.first != f) continue;
        Vec3 n = projected(normals[f], orbits_.kept_by_facet[f]);
        if (!(glm::length(n) > 0)) n = Vec3{0, 0, offsets[f] < 0 ? -1.0 : 1.0};
        result.normals[f] = glm::normalize(n);
        result.offsets[f] = offsets[f];
    }
    for (int p = 0; p < layout_.points; ++p) {
        if (orbits_.points[p].first == p)
            result.points[p] = projected(points[p], orbits_.kept_by_point[p]);
    }
    place_images(result);
    return result;
}

void Parameters::Row::add(int column, double slope) {
    if (!used_[column]) {
        used_[column] = true;
        columns_.push_back(column);
    }
    sum_[column] += slope;
}

void Parameters::Row::normal(int facet, const Vec3& slope) {
    const Slots& slots = tangent_basis_.normals[facet];
    for (int k = 0; k < slots.count; ++k) {
        add(slots.column + k, glm::dot(slots.along[std::size_t(k)], slope));
    }
}

void Parameters::Row::offset(int facet, double slope) {
    add((*tangent_basis_.offsets)[facet], slope);
}

void Parameters::Row::point(int point, const Vec3& slope) {
    const Slots& slots = tangent_basis_.points[point];
    for (int k = 0; k < slots.count; ++k) {
        add(slots.column + k, glm::dot(slots.along[std::size_t(k)], slope));
    }
}

void Parameters::Row::quantity(const Quantity& quantity) {
    for (const Quantity::Slope& s : quantity.slopes) {
        switch (s.by) {
            case Quantity::By::normal:
                normal(s.index, s.slope);
                break;
            case Quantity::By::offset:
                offset(s.index, s.slope.x);
                break;
            case Quantity::By::point:
                point(s.index, s.slope);
                break;
            case Quantity::By::extra:
                if ((*tangent_basis_.extras)[s.index] >= 0)
                    add((*tangent_basis_.extras)[s.index], s.slope.x);
                break;
        }
    }
}

void Parameters::Row::close(JacobianRows& rows, double residual, double variance) {
    for (int column : columns_) {
        rows.add(column, sum_[column]);
        sum_[column] = 0;
        used_[column] = false;
    }
    columns_.clear();
    rows.close(residual, variance);
}

}  // namespace culet
