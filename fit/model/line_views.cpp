#include "fit/model/line_views.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>

#include "fit/model/constants.h"
#include "fit/model/equations.h"
#include "fit/readings/seen_lines.h"

namespace culet {

namespace {

// A turn by the vector g = tan(angle / 2) axis (Rodrigues).
Vec3 turned(const Vec3& g, const Vec3& v) {
    return v + 2 / (1 + glm::dot(g, g)) * (glm::cross(g, v) + glm::cross(g, glm::cross(g, v)));
}

struct Motion {
    Vec3 turn, shift;
    double size;
    Motion(const Shape& shape, int first) {
        const double* x = &shape.extras[std::size_t(first)];
        turn = {x[0], x[1], x[2]};
        shift = {x[3], x[4], x[5]};
        size = std::exp(x[6]);
    }
    glm::dvec4 moved(const Vec3& normal, double offset) const {
        const Vec3 n = turned(turn, normal);
        return {n, -(size * offset + glm::dot(shift, n))};
    }
};

// p . pencil q is the determinant of the rows p, q, a and b, by Laplace's expansion.
glm::dmat4 pencil_of(const glm::dvec4& a, const glm::dvec4& b) {
    const auto minor = [&](int i, int k) { return a[i] * b[k] - a[k] * b[i]; };
    glm::dmat4 pencil(0.0);
    const auto put = [&](int row, int column, double value) {
        pencil[column][row] = value;
        pencil[row][column] = -value;
    };
    put(0, 1, minor(2, 3));
    put(0, 2, minor(3, 1));
    put(0, 3, minor(1, 2));
    put(1, 2, minor(0, 3));
    put(1, 3, minor(2, 0));
    put(2, 3, minor(0, 1));
    return pencil;
}

LineView view_of(const Frame& frame, const Reading& reading) {
    const SeenLine& line = *reading.seen_line;
    const double unit = frame.unit_of(reading);
    LineView view{reading.facets[0], reading.facets[1], -1, {}, line.reach / unit};
    // From inside to the mesh's own places.
    const double scale = frame.scale() / frame.mesh_scale();
    glm::dmat4 outside(glm::transpose(frame.turn_inside(Frame::From::mesh)) * scale);
    outside[3] = glm::dvec4(frame.middle(), 1);
    const glm::dmat4x3 projection = line.projection * outside;
    const glm::dvec2 &e = line.along, &m = line.middle;
    const auto row = [&](double x, double y, double z) {
        return Vec3(x, y, z) * projection;  // the row vector's product
    };
    const std::array<glm::dvec4, 3> rows{row(e.x, e.y, -glm::dot(e, m)) / unit,
                                         row(-e.y, e.x, e.y * m.x - e.x * m.y) / unit,
                                         row(0, 0, 1)};
    for (std::size_t k = 0; k < 3; ++k) {
        view.pencils[k] = pencil_of(rows[(k + 1) % 3], rows[(k + 2) % 3]);
    }
    return view;
}

// Component k of the picture with its slopes.
Quantity component(const LineView& view, int k, const Shape& shape) {
    const Motion motion(shape, view.motion);
    const std::array<int, 2> facets{view.left, view.right};
    std::array<glm::dvec4, 2> planes;
    for (std::size_t f = 0; f < 2; ++f) {
        planes[f] = motion.moved(shape.normals[std::size_t(facets[f])],
                                 shape.offsets[std::size_t(facets[f])]);
    }
    Vec3 l;
    for (int i = 0; i < 3; ++i) {
        l[i] = glm::dot(planes[0], view.pencils[std::size_t(i)] * planes[1]);
    }
    const double length = std::hypot(l.x, l.y);
    Quantity q{l[k] / length, {}};
    glm::dmat4 pencil = view.pencils[std::size_t(k)] / length;
    for (int i = 0; i < 2; ++i) {
        pencil -= q.value * l[i] / (length * length) * view.pencils[std::size_t(i)];
    }
    const std::array<glm::dvec4, 2> slopes{pencil * planes[1], -(pencil * planes[0])};
    Vec3 torque(0), shift(0);
    double size = 0;
    for (std::size_t f = 0; f < 2; ++f) {
        const Vec3 n(planes[f]);
        const double by_offset = -slopes[f].w;
        const Vec3 by_normal = Vec3(slopes[f]) + by_offset * motion.shift;
        const double offset = shape.offsets[std::size_t(facets[f])];
        q.add(Quantity::By::normal, facets[f], turned(-motion.turn, by_normal));
        q.add(Quantity::By::offset, facets[f], by_offset * motion.size);
        torque += glm::cross(n, by_normal);
        shift += by_offset * n;
        size += by_offset * motion.size * offset;
    }
    // The turn's vector g moves by dg where the planes turn by 2 / (1 + g.g) (dg + g x dg).
    const Vec3& g = motion.turn;
    const Vec3 turn = 2 / (1 + glm::dot(g, g)) * (torque - glm::cross(g, torque));
    for (int i = 0; i < 3; ++i) q.add(Quantity::By::extra, view.motion + i, turn[i]);
    for (int i = 0; i < 3; ++i) q.add(Quantity::By::extra, view.motion + 3 + i, shift[i]);
    q.add(Quantity::By::extra, view.motion + 6, size);
    return q;
}

}  // namespace

Vec3 picture_of(const LineView& view, const Shape& shape) {
    return {component(view, 0, shape).value, component(view, 1, shape).value,
            component(view, 2, shape).value};
}

LineViews::LineViews(const Frame& frame, const std::vector<Reading>& readings, Shape& shape)
    : know_up_(frame.up_facet() < 0), view_of_(readings.size(), -1) {
    std::map<std::string, int> motion_of;
    for (std::size_t r = 0; r < readings.size(); ++r) {
        if (!readings[r].seen_line) continue;
        const auto [at, is_new] =
            motion_of.emplace(readings[r].seen_line->series, int(shape.extras.size()));
        if (is_new) {
            motions_.push_back(at->second);
            shape.extras.resize(shape.extras.size() + k_unknowns, 0.0);
        }
        view_of_[r] = int(views_.size());
        views_.push_back(culet::view_of(frame, readings[r]));
        views_.back().motion = at->second;
    }
}

const LineView* LineViews::of(std::size_t reading) const {
    const int at = view_of_[reading];
    return at < 0 ? nullptr : &views_[std::size_t(at)];
}

std::array<double, LineViews::k_unknowns> following(const Shape& shape, int first, bool turns,
                                                    const Vec3& axis) {
    const Motion motion(shape, first);
    const Vec3 &g = motion.turn, along = -turned(g, axis), shift = motion.size * along;
    if (!turns) return {0, 0, 0, shift.x, shift.y, shift.z, 0};
    const Vec3 turn = 0.5 * (along + glm::dot(g, along) * g - glm::cross(g, along));
    return {turn.x, turn.y, turn.z, 0, 0, 0, 0};
}

std::vector<Equation> line_equations(const LineView& view, const Equation& base) {
    std::vector<Equation> both(2, base);
    // The distance of the points' middle from the line, and the line's slope.
    both[0].formula = [view](const Shape& shape) { return component(view, 2, shape); };
    both[1].formula = [view](const Shape& shape) {
        Quantity q;
        q.add(component(view, 0, shape), view.reach);
        return q;
    };
    return both;
}

std::vector<Equation> motion_equations(const LineViews& lines) {
    std::vector<Equation> all;
    for (const int first : lines.motions()) {
        for (int i = 0; i < LineViews::k_unknowns; ++i) {
            Equation e;
            e.role = Equation::Role::placed;
            e.sigma = k_shapes.motion_sigma;
            e.exact = lines.know_up() && i < 2;
            e.formula = extra_unknown(first + i);
            all.push_back(std::move(e));
        }
    }
    return all;
}

}  // namespace culet
