#pragma once
// Stones for the tests of the fit, made from planes.

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "fit/fit.h"
#include "stone/solid/half_edges.h"
#include "stone/stone.h"
#include "tests/stone/enclosed.h"

namespace culet::test {

inline Vec3 direction(double inclination_deg, double azimuth_deg, bool below = false) {
    const double i = radians(inclination_deg), a = radians(azimuth_deg);
    return {std::sin(i) * std::cos(a), std::sin(i) * std::sin(a), (below ? -1 : 1) * std::cos(i)};
}

inline NamedPlane through(const std::string& name, const Vec3& normal, const Vec3& point) {
    const Vec3 n = glm::normalize(normal);
    return {name, {n, glm::dot(n, point)}};
}

/// A cube with edges of 2 about the origin: T at the top, B at the bottom, X+, Y+, X-, Y- around.
inline Solid cube() {
    return enclosed({{"T", {{0, 0, 1}, 1}},
                     {"X+", {{1, 0, 0}, 1}},
                     {"Y+", {{0, 1, 0}, 1}},
                     {"X-", {{-1, 0, 0}, 1}},
                     {"Y-", {{0, -1, 0}, 1}},
                     {"B", {{0, 0, -1}, 1}}});
}

/// A round brilliant with exact meets, in mm: T, C1.., S1.., U1.., G1.., L1.., P1... Facets of a
/// tier are numbered by azimuth. Computed from its meets: star tips, half tips, girdle.
struct BrilliantSize {
    double radius = 3, table = 0.57, crown_deg = 34.5, pavilion_deg = 40.8, star = 0.5,
           lower = 0.77, girdle = 0.1;
    int girdle_facets = 16;  ///< a multiple of 16, so that the girdle has corners at the tips
};

inline Solid brilliant(const BrilliantSize& size = {}) {
    const double pi = std::numbers::pi;
    const double r = size.radius, t = size.table * r;
    const auto at = [](double radius, double azimuth, double z) {
        return Vec3{radius * std::cos(azimuth), radius * std::sin(azimuth), z};
    };
    const double step = pi / 4;
    const double tan_c = std::tan(radians(size.crown_deg)),
                 tan_p = std::tan(radians(size.pavilion_deg));
    std::vector<NamedPlane> planes;
    // Bezel k at azimuth k * step passes through the middle of the girdle; the table cuts off its
    // tip.
    const double table_z = (r - t) * tan_c;
    planes.push_back({"T", {{0, 0, 1}, table_z}});
    const double low = -2 * size.girdle;
    std::vector<NamedPlane> c, s, u, g, l, p;
    const double apothem = t * std::cos(step / 2);  // of the table's edge, at the stars' azimuth
    // The star tip lies on both bezels k and k+1, part of the way down.
    const double tip_r = apothem + size.star * (r * std::cos(step / 2) - apothem) * 1.05;
    for (int k = 0; k < 8; ++k) {
        const double a = k * step, between = a + step / 2;
        c.push_back(
            {fmt::format("C{}", k + 1),
             {direction(size.crown_deg, 360 * k / 8.0), std::sin(radians(size.crown_deg)) * r}});
        // On bezel k: z = (r - x) tan_c, with x along its azimuth.
        const Vec3 tip = at(tip_r, between, (r - tip_r * std::cos(step / 2)) * tan_c);
        const Vec3 left = at(t, a, table_z), right = at(t, a + step, table_z);
        s.push_back(through(fmt::format("S{}", k + 1), glm::cross(right - left, tip - left), tip));
        if (s.back().plane.normal.z < 0) {
            s.back().plane.normal = -s.back().plane.normal;
            s.back().plane.offset = -s.back().plane.offset;
        }
        // Two upper halves between the bezels' girdle tips and the girdle's top in the middle.
        const Vec3 girdle_left = at(r, a, 0), girdle_right = at(r, a + step, 0),
                   girdle_middle = at(r, between, 0);
        const auto facing_out = [](NamedPlane plane, const Vec3& centre) {
            if (glm::dot(plane.plane.normal, centre) > plane.plane.offset) {
                plane.plane.normal = -plane.plane.normal;
                plane.plane.offset = -plane.plane.offset;
            }
            return plane;
        };
        const Vec3 inside{0, 0, -0.1 * r};
        const auto half = [&](const char* name, int number, const Vec3& a1, const Vec3& a2,
                              const Vec3& a3) {
            return facing_out(
                through(fmt::format("{}{}", name, number), glm::cross(a2 - a1, a3 - a1), a1),
                inside);
        };
        u.push_back(half("U", 2 * k + 1, girdle_left, girdle_middle, tip));
        u.push_back(half("U", 2 * k + 2, girdle_middle, girdle_right, tip));
        // Pavilion mains at the bezels' azimuths; lower halves up to a point on the edge between
        // mains.
        p.push_back({fmt::format("P{}", k + 1),
                     {direction(size.pavilion_deg, 360 * k / 8.0, true),
                      glm::dot(direction(size.pavilion_deg, 360 * k / 8.0, true), at(r, a, low))}});
        const double tip_p = (1 - size.lower) * r;
        const Vec3 lower_tip = at(tip_p, between, low - (r - tip_p * std::cos(step / 2)) * tan_p);
        const Vec3 down{0, 0, low};
        l.push_back(half("L", 2 * k + 1, girdle_left + down, girdle_middle + down, lower_tip));
        l.push_back(half("L", 2 * k + 2, girdle_middle + down, girdle_right + down, lower_tip));
    }
    for (int k = 0; k < size.girdle_facets; ++k) {
        const double width = 2 * pi / size.girdle_facets, a = (k + 0.5) * width;
        g.push_back(
            {fmt::format("G{}", k + 1), {direction(90, degrees(a)), r * std::cos(0.5 * width)}});
    }
    for (const auto* tier : {&s, &c, &u, &g, &l, &p}) {
        planes.insert(planes.end(), tier->begin(), tier->end());
    }
    return enclosed(planes);
}

/// Tilts and moves every plane independently, so that meets split. The table stays level.
inline Solid off_standard(const Solid& design, double tilt_deg, double shift, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::vector<NamedPlane> planes;
    for (const Facet& f : design.facets) {
        Vec3 n = f.plane.normal;
        if (f.name != "T") {
            n += radians(tilt_deg) * Vec3{normal(random), normal(random), normal(random)};
        }
        planes.push_back({f.name, {glm::normalize(n), f.plane.offset + shift * normal(random)}});
    }
    return intersect_half_spaces(planes).solid;
}

inline Stone stone_of(Solid solid, const std::string& up = "T") {
    Stone stone;
    stone.solid = std::move(solid);
    stone.up_facet = up;
    stone.material.density_g_cm3 = 3.5;
    return stone;
}

/// A stone of the same facets and meets with corner errors of `sigma`: its facets are no longer
/// planar.
inline Solid shaken(Solid solid, double sigma, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0, sigma);
    for (Vec3& v : solid.vertices) v += Vec3{normal(random), normal(random), normal(random)};
    for (Facet& facet : solid.facets) {
        std::vector<Vec3> loop;
        for (int corner : facet.corners) loop.push_back(solid.vertices[corner]);
        facet.plane = plane_through(loop);
    }
    return solid;
}

inline Reading reading(ReadingKind kind, std::vector<int> facets, double value, double sigma) {
    Reading r;
    r.id = std::string(name_of(kind));
    for (int f : facets) r.id += fmt::format(".{}", f);
    r.kind = kind;
    r.facets = std::move(facets);
    r.value = value;
    r.sigma = sigma;
    return r;
}

inline std::vector<Reading> all_angles(const Solid& solid, double sigma, const std::string& up) {
    std::vector<Reading> readings;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        if (solid.facets[f].name == up) continue;
        const Vec3& n = solid.facets[f].plane.normal;
        const int facet = static_cast<int>(f);
        readings.push_back(
            reading(ReadingKind::inclination, {facet}, inclination(n, Vec3{0, 0, 1}), sigma));
        if (std::hypot(n.x, n.y) > 1e-6) {
            readings.push_back(reading(ReadingKind::azimuth, {facet}, azimuth(n), sigma));
        }
    }
    return readings;
}

inline Reading width(const Solid& solid, double azimuth_deg, double sigma) {
    Reading r = reading(ReadingKind::width, {}, 0, sigma);
    r.azimuth = radians(azimuth_deg);
    r.id += fmt::format("@{}", azimuth_deg);
    r.value = width_along(solid, direction(90, azimuth_deg));
    return r;
}

inline Reading depth(const Solid& solid, double sigma) {
    return reading(ReadingKind::depth, {}, width_along(solid, {0, 0, 1}), sigma);
}

inline std::vector<Reading> all_edges(const Solid& solid, double sigma) {
    std::vector<Reading> readings;
    for (const Edge& e : half_edges(solid).edges) {
        readings.push_back(reading(ReadingKind::edge, {e.left, e.right},
                                   glm::length(solid.vertices[e.from] - solid.vertices[e.to]),
                                   sigma));
    }
    return readings;
}

inline std::vector<Reading> noisy(std::vector<Reading> readings, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (Reading& r : readings) {
        const double e = normal(random);
        if (!r.exact && !is_relation(r.kind)) r.value += r.sigma * e;
        // Instruments do not show more than 90 degrees.
        if (r.kind == ReadingKind::inclination) {
            const double right = std::numbers::pi / 2;
            r.value = right - std::abs(right - std::abs(r.value));
        }
    }
    return readings;
}

/// An instrument's readings of the true planes, without lengths, which belong to other corners:
/// angles of each plane and its distance from the table's middle, as a scan gives them.
inline std::vector<Reading> plane_readings(const Solid& design, const Solid& truth,
                                           double sigma_deg, double sigma) {
    const std::vector<Edge> design_edges = half_edges(design).edges;
    std::vector<Reading> readings;
    for (std::size_t f = 0; f < design.facets.size(); ++f) {
        const int t = find_facet(truth, design.facets[f].name);
        if (t < 0 || design.facets[f].name == "T") continue;
        const Vec3& n = truth.facets[std::size_t(t)].plane.normal;
        if (std::abs(n.z) > 0.1) {
            readings.push_back(reading(ReadingKind::inclination, {int(f)},
                                       inclination(n, Vec3{0, 0, 1}), radians(sigma_deg)));
        } else {
            // The inclination of a nearly upright facet does not say to which side it leans; the
            // angle to a neighbour does.
            for (const Edge& e : design_edges) {
                if (e.left != int(f) && e.right != int(f)) continue;
                const int g = e.left == int(f) ? e.right : e.left;
                const int u = find_facet(truth, design.facets[std::size_t(g)].name);
                if (u < 0 || std::abs(design.facets[std::size_t(g)].plane.normal.z) < 0.1) continue;
                const double c = glm::dot(n, truth.facets[std::size_t(u)].plane.normal);
                readings.push_back(reading(ReadingKind::dihedral, {int(f), g},
                                           std::numbers::pi - std::acos(c), radians(sigma_deg)));
                break;
            }
        }
        if (std::hypot(n.x, n.y) > 1e-6) {
            readings.push_back(
                reading(ReadingKind::azimuth, {int(f)}, azimuth(n), radians(sigma_deg)));
        }
    }
    readings.push_back(depth(truth, sigma));
    for (int k = 0; k < 16; ++k) readings.push_back(width(truth, 11.25 * k, sigma));
    std::map<std::pair<int, int>, double> lengths;
    for (const Edge& t : half_edges(truth).edges) {
        const int a = find_facet(design, truth.facets[std::size_t(t.left)].name),
                  b = find_facet(design, truth.facets[std::size_t(t.right)].name);
        lengths[std::minmax(a, b)] =
            glm::length(truth.vertices[std::size_t(t.from)] - truth.vertices[std::size_t(t.to)]);
    }
    for (const Edge& e : design_edges) {
        const auto found = lengths.find(std::minmax(e.left, e.right));
        if (found == lengths.end()) continue;
        readings.push_back(reading(ReadingKind::edge, {e.left, e.right}, found->second, sigma));
    }
    return readings;
}

/// Exact readings of every facet's angles, every edge and the depth.
inline std::vector<Reading> readings_of(const Solid& truth, double sigma_deg, double sigma) {
    std::vector<Reading> readings = all_angles(truth, radians(sigma_deg), "T");
    for (const Reading& r : all_edges(truth, sigma)) readings.push_back(r);
    readings.push_back(depth(truth, sigma));
    return readings;
}

}  // namespace culet::test
