#include "fit/residuals.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "fit/eigenvector.h"

namespace culet {

namespace {

// Sine between planes below which rounding has half the digits of the line they share.
constexpr double k_one_plane = 1e-8;

using By = Quantity::By;

// Angle between unit vectors, folded to 0..pi/2, and its slopes. Both atan2 arguments keep full
// precision near 0 and near pi/2. Where the vectors are parallel the slope is taken as zero.
struct FoldedAngle {
    double value;
    Vec3 by_a, by_b;
};
FoldedAngle folded_angle(const Vec3& a, const Vec3& b) {
    const double s = glm::length(glm::cross(a, b)), c = glm::dot(a, b);
    const double sign = c < 0 ? -1 : 1;
    FoldedAngle angle{std::atan2(s, std::abs(c)), Vec3(0), Vec3(0)};
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

void Quantity::add(const Quantity& other, double factor) {
    value += factor * other.value;
    for (const Slope& s : other.slopes) slopes.push_back({s.by, s.index, factor * s.slope});
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

Formula tilt_from_up(int facet) {
    return [=](const Shape& shape) {
        const FoldedAngle angle = folded_angle(shape.normals[facet], Vec3{0, 0, 1});
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
        const FoldedAngle angle = folded_angle(shape.normals[facet], shape.normals[datum]);
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
        const FoldedAngle angle = folded_angle(shape.normals[facet], least.vector);
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
        const FoldedAngle angle = folded_angle(shape.normals[facet], least.vector);
        Quantity q{angle.value, {}};
        q.add(By::normal, facet, angle.by_a);
        const Vec3 back = least.pseudo_inverse * angle.by_b;
        for (const Corner& c : corners) {
            // The mean's own motion drops out: the r sum to zero.
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

Formula extent(const Corner& a, const Corner& b, const Vec3& direction) {
    return [=](const Shape& shape) {
        Quantity q{glm::dot(direction, place_of(shape, a) - place_of(shape, b)), {}};
        add_corner(q, shape, a, direction);
        add_corner(q, shape, b, -direction);
        return q;
    };
}

Formula corner_distance(const Corner& a, const Corner& b) {
    return [=](const Shape& shape) {
        const Vec3 between = place_of(shape, a) - place_of(shape, b);
        const double length = glm::length(between);
        Quantity q{length, {}};
        const Vec3 along = length > 0 ? between / length : Vec3(0);
        add_corner(q, shape, a, along);
        add_corner(q, shape, b, -along);
        return q;
    };
}

Formula edge_length(int left, int right, const Corner& from, const Corner& to) {
    return [=](const Shape& shape) {
        const Vec3 &l = shape.normals[left], &r = shape.normals[right];
        const Vec3 across = glm::cross(l, r);
        const double sine = glm::length(across);
        // Planes this near to one plane cross along a line that rounding chooses.
        if (sine < k_one_plane) return corner_distance(from, to)(shape);
        const Vec3 along = across / sine, edge = place_of(shape, to) - place_of(shape, from);
        Quantity q{glm::dot(along, edge), {}};
        add_corner(q, shape, to, along);
        add_corner(q, shape, from, -along);
        const Vec3 aside = (edge - q.value * along) / sine;
        q.add(By::normal, left, glm::cross(r, aside));
        q.add(By::normal, right, glm::cross(aside, l));
        return q;
    };
}

Formula height(int facet, const Corner& corner) {
    return [=](const Shape& shape) {
        const Vec3 p = place_of(shape, corner);
        Quantity q{glm::dot(shape.normals[facet], p) - shape.offsets[facet], {}};
        q.add(By::normal, facet, p);
        q.add(By::offset, facet, -1.0);
        add_corner(q, shape, corner, shape.normals[facet]);
        return q;
    };
}

Formula corner_to_facet(int facet, const Corner& corner) {
    const Formula signed_height = height(facet, corner);
    return [=](const Shape& shape) {
        const Quantity h = signed_height(shape);
        Quantity q;
        q.add(h, h.value < 0 ? -1 : 1);
        return q;
    };
}

Formula corner_to_line(const Corner& corner, const Corner& from, const Corner& to) {
    return [=](const Shape& shape) {
        const Vec3 a = place_of(shape, from), b = place_of(shape, to);
        const Vec3 along = b - a, off = place_of(shape, corner) - a;
        const double length2 = glm::dot(along, along);
        const double t = length2 > 0 ? glm::dot(off, along) / length2 : 0;
        const Vec3 away = off - t * along;
        const double distance = glm::length(away);
        Quantity q{distance, {}};
        const Vec3 unit = distance > 0 ? away / distance : Vec3(0);
        add_corner(q, shape, corner, unit);
        add_corner(q, shape, from, -(1 - t) * unit);
        add_corner(q, shape, to, -t * unit);
        return q;
    };
}

Formula line_to_line(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    return [=](const Shape& shape) {
        const Vec3 pa = place_of(shape, a), pb = place_of(shape, b), pc = place_of(shape, c),
                   pd = place_of(shape, d);
        const Vec3 u = pb - pa, v = pd - pc;
        const Vec3 across = glm::cross(u, v);
        Quantity q;
        // Lines less than a degree from parallel have no well-defined common normal.
        if (glm::length(across) < 0.0175 * glm::length(u) * glm::length(v)) {
            const Vec3 middle = 0.5 * (pc + pd);
            const double t = glm::dot(middle - pa, u) / glm::dot(u, u);
            const Vec3 away = middle - pa - t * u;
            q.value = glm::length(away);
            const Vec3 unit = q.value > 0 ? away / q.value : Vec3(0);
            add_corner(q, shape, c, 0.5 * unit);
            add_corner(q, shape, d, 0.5 * unit);
            add_corner(q, shape, a, -(1 - t) * unit);
            add_corner(q, shape, b, -t * unit);
            return q;
        }
        // The shortest link runs from a + s u to c + t v along the unit common normal; moving the
        // ends moves it by the normal component of its own ends (envelope theorem).
        Vec3 unit = glm::normalize(across);
        if (glm::dot(unit, pc - pa) < 0) unit = -unit;
        q.value = glm::dot(unit, pc - pa);
        const Vec3 r = pc - pa;
        const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v);
        const double det = uu * vv - uv * uv;
        const double s = (glm::dot(r, u) * vv - glm::dot(r, v) * uv) / det;
        const double t = (glm::dot(r, u) * uv - glm::dot(r, v) * uu) / det;
        add_corner(q, shape, a, -(1 - s) * unit);
        add_corner(q, shape, b, -s * unit);
        add_corner(q, shape, c, (1 - t) * unit);
        add_corner(q, shape, d, t * unit);
        return q;
    };
}

Formula spacing(int facet, int other, std::vector<Corner> corners,
                std::vector<Corner> other_corners) {
    return [=, corners = std::move(corners),
            other_corners = std::move(other_corners)](const Shape& shape) {
        const auto one = [&](int f, const std::vector<Corner>& from) {
            Vec3 mean(0);
            const double share = 1.0 / static_cast<double>(from.size());
            for (const Corner& c : from) mean += share * place_of(shape, c);
            Quantity h{glm::dot(shape.normals[f], mean) - shape.offsets[f], {}};
            h.add(By::normal, f, mean);
            h.add(By::offset, f, -1.0);
            for (const Corner& c : from) add_corner(h, shape, c, share * shape.normals[f]);
            return h;
        };
        const Quantity a = one(facet, other_corners), b = one(other, corners);
        Quantity q;
        q.add(a, a.value < 0 ? -0.5 : 0.5);
        q.add(b, b.value < 0 ? -0.5 : 0.5);
        return q;
    };
}

Formula enclosed_volume(std::shared_ptr<const Outline> outline) {
    return [outline](const Shape& shape) {
        std::vector<Vec3> place(outline->corners.size()), slope(outline->corners.size(), Vec3(0));
        for (std::size_t i = 0; i < place.size(); ++i) {
            place[i] = place_of(shape, outline->corners[i]);
        }
        Quantity q;
        for (const std::vector<int>& loop : outline->loops) {
            for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
                const Vec3 &a = place[loop[0]], &b = place[loop[i]], &c = place[loop[i + 1]];
                q.value += glm::dot(a, glm::cross(b, c)) / 6;
                slope[loop[0]] += glm::cross(b, c) / 6.0;
                slope[loop[i]] += glm::cross(c, a) / 6.0;
                slope[loop[i + 1]] += glm::cross(a, b) / 6.0;
            }
        }
        for (std::size_t i = 0; i < place.size(); ++i) {
            add_corner(q, shape, outline->corners[i], slope[i]);
        }
        return q;
    };
}

Formula enclosed_area(std::vector<Corner> loop) {
    return [loop = std::move(loop)](const Shape& shape) {
        // Twice the area as a vector: sum of p_i x p_(i+1) about the first corner.
        const std::size_t count = loop.size();
        std::vector<Vec3> place;
        for (const Corner& c : loop) place.push_back(place_of(shape, c));
        Vec3 twice(0);
        for (std::size_t i = 1; i + 1 < count; ++i) {
            twice += glm::cross(place[i] - place[0], place[i + 1] - place[0]);
        }
        const double length = glm::length(twice);
        Quantity q{0.5 * length, {}};
        if (!(length > 0)) return q;
        const Vec3 unit = twice / length;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 chord = place[(i + 1) % count] - place[(i + count - 1) % count];
            add_corner(q, shape, loop[i], 0.5 * glm::cross(chord, unit));
        }
        return q;
    };
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
