// Cases of kind "solid": planes in, a solid out. Expectations: 100-digit arithmetic
// (exact_solid.h), and that moving, turning, scaling or reordering the input has only that effect
// on the answer.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <random>

#include <fmt/format.h>

#include "render/geometry/convex_body.h"
#include "render/geometry/polyhedron_body.h"
#include "stone/mesh/mesh_io.h"
#include "stone/solid/checks.h"
#include "tests/hard/exact_solid.h"
#include "tests/hard/hard_kinds.h"
#include "tests/hard/hard_solids.h"

namespace culet::hard {

namespace {

struct Case {
    std::vector<NamedPlane> planes;
    Solid solid;
    ExactJudgement judgement;
    double reach = 0;  // largest coordinate: their rounding error is 2^-53 of it
};

std::vector<NamedPlane> by(std::vector<NamedPlane> planes, auto change) {
    for (NamedPlane& p : planes) change(p.plane);
    return planes;
}

Solid solid_of(const std::vector<NamedPlane>& planes) {
    return intersect_half_spaces(planes).solid;
}

// Facets of the same name have equally many corners, and every corner lies near one of the other's.
Measured same_solid(const Solid& a, const Solid& b, double unit) {
    if (a.facets.size() != b.facets.size() || a.vertices.size() != b.vertices.size()) {
        return {1e300, std::nan(""),
                fmt::format("{} facets and {} corners, not {} and {}", b.facets.size(),
                            b.vertices.size(), a.facets.size(), a.vertices.size())};
    }
    std::map<std::string, const Facet*> of_b;
    for (const Facet& f : b.facets) of_b[f.name] = &f;
    double worst = 0;
    for (const Facet& f : a.facets) {
        const auto other = of_b.find(f.name);
        if (other == of_b.end() || other->second->corners.size() != f.corners.size()) {
            return {1e300, std::nan(""), f.name + " is another facet"};
        }
        for (const int corner : f.corners) {
            double nearest = 1e300;
            for (const int o : other->second->corners) {
                nearest = std::min(nearest, glm::length(a.vertices[std::size_t(corner)] -
                                                        b.vertices[std::size_t(o)]));
            }
            worst = std::max(worst, nearest);
        }
    }
    return {worst / unit, std::nan(""), ""};
}

Measured sound(const Case& c) {
    std::vector<Fault> faults = find_faults(c.solid);
    // Two facets that a goniometer cannot distinguish deserve a note, but are no fault of the
    // solid.
    std::erase_if(faults, [](const Fault& f) { return f.kind == FaultKind::repeated_plane; });
    return {static_cast<double>(faults.size()), std::nan(""),
            faults.empty() ? "" : faults.front().what};
}

Measured volume_after(const Case& c, const std::vector<NamedPlane>& planes, double factor) {
    const double now = volume(solid_of(planes)) / (factor * factor * factor);
    return {std::abs(now / c.judgement.volume - 1), c.judgement.volume_condition, ""};
}

Measured worst_of(int times, auto measure) {
    Measured worst;
    for (int k = 0; k < times; ++k) {
        Measured m = measure(static_cast<unsigned>(k));
        if (!(m.error <= worst.error)) worst = m;
        worst.condition = m.condition;
    }
    return worst;
}

Measured read_back(const Case& c) {
    Measured worst;
    for (const MeshFormat format :
         {MeshFormat::obj, MeshFormat::off, MeshFormat::ply, MeshFormat::stl}) {
        const Solid back = parse_mesh(mesh_text(c.solid, format), format).solid;
        Measured m;
        if (format == MeshFormat::stl) {
            // A triangle soup without names and planes must still close. Facets that single
            // precision cannot distinguish become one.
            const double off = std::abs(volume(back) / volume(c.solid) - 1);
            m.error = is_closed(back) && off < 1e-6 ? 0 : 1e300;
        } else {
            m = same_solid(c.solid, back, c.reach);
        }
        m.about = fmt::format("format {}: {}", static_cast<int>(format), m.about);
        if (!(m.error <= worst.error)) worst = m;
    }
    return worst;
}

// A ray from inside leaves at the stone's surface: in long double the point lies on the plane of
// the reported facet, and above no other.
double misses(const Case& c, const Vec3& from, const Vec3& direction, const BodyHit& hit) {
    using Long = long double;
    const auto height = [&](const Plane& p) {
        Long sum = -Long(p.offset);
        for (int k = 0; k < 3; ++k) {
            sum += Long(p.normal[k]) * (Long(from[k]) + Long(hit.distance) * Long(direction[k]));
        }
        return static_cast<double>(sum);
    };
    double worst = std::abs(height(c.solid.facets[std::size_t(hit.facet)].plane));
    for (const Facet& f : c.solid.facets) worst = std::max(worst, height(f.plane));
    // The distance has the rounding error of its terms over the cosine to the facet's normal.
    const double steep = glm::dot(c.solid.facets[std::size_t(hit.facet)].plane.normal, direction);
    return worst * std::max(steep, 1e-3);
}

template <class Try>
void with_rays(const Case& c, int count, Try attempt) {
    std::mt19937_64 random(31);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> share(0.05, 0.95);
    const Vec3 middle = centroid(c.solid);
    for (int i = 0; i < count; ++i) {
        const Facet& facet = c.solid.facets[std::size_t(i) % c.solid.facets.size()];
        const Vec3 &a = c.solid.vertices[std::size_t(facet.corners[0])],
                   &b = c.solid.vertices[std::size_t(facet.corners[1])];
        const Vec3 from = middle + share(random) * (corner_mean(c.solid, facet) - middle);
        Vec3 direction{normal(random), normal(random), normal(random)};
        // Every third to a corner, every other third to an edge.
        if (i % 3 == 1) direction = a - from;
        if (i % 3 == 2) direction = a + share(random) * (b - a) - from;
        if (!(glm::length(direction) > 0)) continue;
        attempt(from, glm::normalize(direction));
    }
}

Measured rays_leave(const Case& c) {
    const ConvexBody body(c.solid);
    Measured worst;
    with_rays(c, 300, [&](const Vec3& from, const Vec3& direction) {
        if (!body.contains(from)) return;
        worst.error =
            std::max(worst.error, misses(c, from, direction, body.exit(from, direction)) / c.reach);
    });
    return worst;
}

// The watertight body for any solid against the one made of planes: the same exit.
Measured bodies_agree(const Case& c) {
    const ConvexBody planes(c.solid);
    const PolyhedronBody surface(c.solid);
    Measured worst;
    with_rays(c, 100, [&](const Vec3& from, const Vec3& direction) {
        if (!planes.contains(from) || !surface.contains(from)) return;
        const BodyHit a = planes.exit(from, direction), b = surface.exit(from, direction, -1);
        // At an edge they may leave through either facet, and each distance has the rounding error
        // of its facet's plane over the cosine to its normal.
        const double steep =
            std::min(glm::dot(c.solid.facets[std::size_t(a.facet)].plane.normal, direction),
                     glm::dot(c.solid.facets[std::size_t(b.facet)].plane.normal, direction));
        worst.error = std::max(worst.error,
                               std::abs(a.distance - b.distance) * std::max(steep, 0.0) / c.reach);
    });
    return worst;
}

Measured meets_in_doubles(const Case& c) {
    std::vector<std::vector<const Plane*>> sharers(c.solid.vertices.size());
    for (const Facet& f : c.solid.facets) {
        for (const int corner : f.corners) sharers[std::size_t(corner)].push_back(&f.plane);
    }
    Measured worst;
    for (std::size_t v = 0; v < sharers.size(); ++v) {
        const Plane &p = *sharers[v][0], &q = *sharers[v][1], &r = *sharers[v][2];
        const Vec3 qr = glm::cross(q.normal, r.normal);
        const Vec3 point = (p.offset * qr + q.offset * glm::cross(r.normal, p.normal) +
                            r.offset * glm::cross(p.normal, q.normal)) /
                           glm::dot(p.normal, qr);
        const double d = glm::length(point - c.solid.vertices[v]) / c.reach;
        if (std::isfinite(d)) worst.error = std::max(worst.error, d);
    }
    return worst;
}

}  // namespace

Subject solid_subject(const HardCase&, const HardPoint&, const TomlTable& parameters) {
    const auto c = std::make_shared<Case>();
    const TomlTable stone = parameters.table("stone").value();
    c->planes = hard_planes(stone);
    c->solid = solid_of(c->planes);
    c->reach = diameter(c->solid);
    for (const Vec3& v : c->solid.vertices) c->reach = std::max(c->reach, glm::length(v));
    c->judgement = judge_solid(c->planes, c->solid);
    Subject subject;
    auto& is = subject.invariants;
    is["closed_and_convex"] = [c] { return sound(*c); };
    is["exact_topology"] = [c] {
        return Measured{double(c->judgement.misplaced), std::nan(""), ""};
    };
    is["corners"] = [c] {
        return Measured{c->judgement.vertex_error / c->reach, std::nan(""), ""};
    };
    is["volume"] = [c] {
        return Measured{c->judgement.volume_error, c->judgement.volume_condition, ""};
    };
    is["planar"] = [c] { return Measured{planarity(c->solid) / c->reach, std::nan(""), ""}; };
    // Near meets joined: as many corners as the design intends, none farther off its planes.
    is["meets_join"] = [c, parameters] {
        const TomlTable expect = parameters.table("expect").value();
        const double within = expect.number("join").value() * diameter(c->solid);
        const ContractedSolid joined = contract_near_meets(c->solid, within);
        const double corners = double(joined.solid.vertices.size());
        const double meant = expect.number("corners").value_or(
            expect.number("corners_per_facet").value_or(0) *
            parameters.table("stone")->number("facets").value_or(1));
        const double extra = expect.number("and").value_or(0);
        const auto faults = find_faults(joined.solid, {.planarity = 1e-9 + within / c->reach});
        return Measured{
            std::abs(corners - meant - extra) + double(faults.size()) +
                (planarity(joined.solid) > 2 * within + 4e-16 * c->reach),
            std::nan(""),
            fmt::format("{} corners, {}", corners, faults.empty() ? "" : faults.front().what)};
    };
    is["reordered"] = [c] {
        return worst_of(3, [&](unsigned k) {
            std::vector<NamedPlane> planes = c->planes;
            std::shuffle(planes.begin(), planes.end(), std::mt19937_64(k));
            return same_solid(c->solid, solid_of(planes), c->reach);
        });
    };
    is["binary_units"] = [c] {
        return worst_of(2, [&](unsigned k) {
            const double factor = k == 0 ? 0x1p-40 : 0x1p+40;
            const Solid other = solid_of(by(c->planes, [&](Plane& p) { p.offset *= factor; }));
            return same_solid(c->solid, scaled(other, 1 / factor), c->reach);
        });
    };
    is["units"] = [c] {
        return worst_of(2, [&](unsigned k) {
            const double factor = k == 0 ? 1e-6 : 1e6;
            return volume_after(*c, by(c->planes, [&](Plane& p) { p.offset *= factor; }), factor);
        });
    };
    is["turned"] = [c] {
        return worst_of(3, [&](unsigned k) {
            const Turn turn = random_turn(100 + k);
            return volume_after(*c, by(c->planes, [&](Plane& p) { p = turned(p, turn); }), 1);
        });
    };
    is["last_digit"] = [c] {
        return worst_of(3, [&](unsigned k) {
            unsigned state = k;
            return volume_after(*c,
                                by(c->planes,
                                   [&](Plane& p) {
                                       p.normal = nudged(p.normal, state);
                                       p.offset = nudged(p.offset, state);
                                   }),
                                1);
        });
    };
    is["shaken_by_1e-12"] = [c] {
        return worst_of(3, [&](unsigned k) {
            std::mt19937_64 random(k);
            std::uniform_real_distribution<double> some(-1e-12, 1e-12);
            Measured m = volume_after(*c,
                                      by(c->planes,
                                         [&](Plane& p) {
                                             for (int i = 0; i < 3; ++i)
                                                 p.normal[i] += some(random);
                                             p.offset *= 1 + some(random);
                                         }),
                                      1);
            m.error /= 1e-12 * m.condition;  // relative to the effect of the change
            return m;
        });
    };
    is["files"] = [c] { return read_back(*c); };
    is["rays_leave"] = [c] { return rays_leave(*c); };
    is["bodies_agree"] = [c] { return bodies_agree(*c); };
    subject.contrasts.push_back(
        {"corners", "meet of three planes in doubles", [c] { return meets_in_doubles(*c); }});
    return subject;
}

}  // namespace culet::hard
