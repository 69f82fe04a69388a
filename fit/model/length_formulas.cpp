// Expected values of lengths, areas and volumes.

#include "fit/model/constants.h"
#include "fit/model/residuals.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace culet {

namespace {

using By = Quantity::By;

}  // namespace

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
        // Rounding decides the crossing line of such nearly coincident planes.
        if (sine < k_shapes.one_plane) return corner_distance(from, to)(shape);
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
        // The common normal is ill-defined for lines within a degree of parallel.
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
        // The shortest link runs from a + s u to c + t v along the unit common normal. Its length
        // changes only by the normal components of its ends' motions (envelope theorem).
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

}  // namespace culet
