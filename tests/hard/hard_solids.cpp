#include "tests/hard/hard_solids.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <random>

#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"

namespace culet::hard {

namespace {

constexpr double k_pi = std::numbers::pi;

NamedPlane plane(const std::string& name, const Vec3& normal, double offset) {
    const double length = glm::length(normal);
    return {name, {normal / length, offset}};
}

std::vector<NamedPlane> box(double x, double y, double z) {
    return {plane("T", {0, 0, 1}, z / 2), plane("B", {0, 0, -1}, z / 2),
            plane("E", {1, 0, 0}, x / 2), plane("W", {-1, 0, 0}, x / 2),
            plane("N", {0, 1, 0}, y / 2), plane("S", {0, -1, 0}, y / 2)};
}

std::vector<NamedPlane> twins(const TomlTable& stone) {
    const double half = radians(stone.number("angle_deg").value_or(1)) / 2;
    std::vector<NamedPlane> planes = box(2, 2, 2);
    planes[0] = plane("T1", {std::sin(half), 0, std::cos(half)}, 1);
    planes.push_back(plane("T2", {-std::sin(half), 0, std::cos(half)}, 1));
    return planes;
}

std::vector<NamedPlane> nick(const TomlTable& stone) {
    const double size = 2 * std::sqrt(3.0) * stone.number("size").value_or(0.1);
    std::vector<NamedPlane> planes = box(2, 2, 2);
    // The edge at x = z = 1 loses a strip of that width, the corner at (-1, -1, 1) a triangle.
    planes.push_back(plane("edge", {1, 0, 1}, std::sqrt(2.0) - size / 2));
    planes.push_back(plane("corner", {-1, -1, 1}, std::sqrt(3.0) - size / std::sqrt(6.0)));
    return planes;
}

std::vector<NamedPlane> cone(int facets, double girdle, double turn, bool above) {
    std::vector<NamedPlane> planes;
    for (int k = 0; k < facets; ++k) {
        const double a = 2 * k_pi * (k + turn) / facets;
        const double down = above ? 1 : -1;
        const Vec3 n = glm::normalize(Vec3{std::cos(a), std::sin(a), down});
        // Through the unit circle's tangent at the girdle's upper or lower edge.
        planes.push_back({fmt::format("{}{}", above ? "C" : "P", k + 1),
                          {n, glm::dot(n, Vec3{std::cos(a), std::sin(a), down * girdle / 2})}});
    }
    return planes;
}

std::vector<NamedPlane> culet_stone(const TomlTable& stone) {
    const int facets = static_cast<int>(stone.number("facets").value_or(8));
    const double girdle = stone.number("girdle").value_or(0.1);
    const double miss = stone.number("miss").value_or(0);
    std::vector<NamedPlane> planes = cone(facets, girdle, 0, false);
    for (int k = 0; k < facets; ++k) planes[k].plane.offset -= 2 * miss * ((k * 7) % 5) / 4.0;
    for (int k = 0; k < facets; ++k) {
        const double a = 2 * k_pi * k / facets;
        planes.push_back(plane(fmt::format("G{}", k + 1), {std::cos(a), std::sin(a), 0}, 1));
    }
    planes.push_back(plane("T", {0, 0, 1}, girdle / 2));
    if (const auto culet = stone.number("culet")) {
        planes.push_back(plane("CU", {0, 0, -1}, 1 + girdle / 2 - *culet / 2));
    }
    return planes;
}

std::vector<NamedPlane> bipyramid(const TomlTable& stone) {
    const int facets = static_cast<int>(stone.number("facets").value_or(8));
    const double girdle = stone.number("girdle").value_or(0);
    std::vector<NamedPlane> planes = cone(facets, girdle, 0, false);
    for (NamedPlane& p : cone(facets, girdle, 0, true)) planes.push_back(std::move(p));
    for (int k = 0; k < facets && stone.boolean("with_girdle").value_or(true); ++k) {
        const double a = 2 * k_pi * k / facets;
        planes.push_back(plane(fmt::format("G{}", k + 1), {std::cos(a), std::sin(a), 0}, 1));
    }
    planes.push_back(plane("T", {0, 0, 1}, 0.5));
    return planes;
}

// Fibonacci lattice on the sphere.
std::vector<NamedPlane> sphere(const TomlTable& stone) {
    const int facets = static_cast<int>(stone.number("facets").value_or(100));
    std::vector<NamedPlane> planes;
    for (int k = 0; k < facets; ++k) {
        const double z = 1 - (2 * k + 1.0) / facets, a = k_pi * (3 - std::sqrt(5.0)) * k;
        const double r = std::sqrt(1 - z * z);
        planes.push_back(
            plane(fmt::format("F{}", k + 1), {r * std::cos(a), r * std::sin(a), z}, 1));
    }
    return planes;
}

std::vector<NamedPlane> random_planes(const TomlTable& stone) {
    const int facets = static_cast<int>(stone.number("facets").value_or(30));
    std::mt19937_64 random(static_cast<unsigned>(stone.integer("seed").value_or(1)));
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> offset(0.9, 1.1);
    std::vector<NamedPlane> planes = box(2.6, 2.6, 2.6);
    for (int k = 0; k < facets; ++k) {
        const Vec3 n{normal(random), normal(random), normal(random)};
        planes.push_back(plane(fmt::format("R{}", k + 1), n, offset(random)));
    }
    return planes;
}

std::vector<NamedPlane> catalogue_cut(const TomlTable& stone) {
    Solid solid = make_cut(stone.text("cut").value_or("round-brilliant"));
    std::vector<NamedPlane> planes;
    const double tilt = radians(stone.number("tilt_deg").value_or(0));
    const std::string which = stone.text("facet").value_or("");
    for (const Facet& facet : solid.facets) {
        Plane p = facet.plane;
        if (facet.name == which) {
            const Vec3 middle = corner_mean(solid, facet), old = p.normal;
            const Vec3 across = glm::normalize(glm::cross(old, Vec3{0.3, 0.2, 0.9}));
            p.normal = glm::normalize(std::cos(tilt) * old + std::sin(tilt) * across);
            p.offset += glm::dot(p.normal - old, middle);
        }
        planes.push_back({facet.name, p});
    }
    return planes;
}

}  // namespace

std::vector<NamedPlane> hard_planes(const TomlTable& stone) {
    using Make = std::vector<NamedPlane> (*)(const TomlTable&);
    static const std::map<std::string, Make> shapes{
        {"twins", twins},
        {"nick", nick},
        {"culet", culet_stone},
        {"sphere", sphere},
        {"bipyramid", bipyramid},
        {"random", random_planes},
        {"cut", catalogue_cut},
        {"box", [](const TomlTable& t) { return box(1, 1, t.number("aspect").value_or(1)); }}};
    stone.refuse_unknown({"shape", "angle_deg", "size", "facets", "miss", "girdle", "with_girdle",
                          "culet", "aspect", "seed", "cut", "facet", "tilt_deg", "scale", "shift",
                          "turn", "contract"});
    const auto shape = shapes.find(stone.text("shape").value_or(""));
    if (shape == shapes.end()) stone.fail("shape", "there is no such shape");
    std::vector<NamedPlane> planes = shape->second(stone);
    if (const auto seed = stone.integer("turn")) {
        const Turn turn = random_turn(static_cast<unsigned>(*seed));
        for (NamedPlane& p : planes) p.plane = turned(p.plane, turn);
    }
    const double scale = stone.number("scale").value_or(1);
    const Vec3 shift =
        stone.number("shift").value_or(0) * Vec3{0.8164965809, 0.40824829046, -0.40824829046};
    for (NamedPlane& p : planes) {
        p.plane.offset = scale * (p.plane.offset + glm::dot(p.plane.normal, shift));
    }
    return planes;
}

Solid hard_solid(const TomlTable& stone) {
    const Solid solid = intersect_half_spaces(hard_planes(stone)).solid;
    const auto contract = stone.number("contract");
    return contract ? contract_near_meets(solid, *contract * diameter(solid)).solid : solid;
}

Turn random_turn(unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const auto direction = [&] {
        return glm::normalize(Vec3{normal(random), normal(random), normal(random)});
    };
    Turn turn;
    turn.x = direction();
    turn.y = glm::normalize(glm::cross(turn.x, direction()));
    turn.z = glm::normalize(glm::cross(turn.x, turn.y));
    return turn;
}

Plane turned(const Plane& plane, const Turn& turn) {
    return {glm::normalize(turn(plane.normal)), plane.offset};
}

Solid turned(Solid solid, const Turn& turn) {
    for (Vec3& v : solid.vertices) v = turn(v);
    for (Facet& f : solid.facets) f.plane = turned(f.plane, turn);
    return solid;
}

Solid scaled(Solid solid, double factor) {
    for (Vec3& v : solid.vertices) v *= factor;
    for (Facet& f : solid.facets) f.plane.offset *= factor;
    return solid;
}

double nudged(double value, unsigned& state) {
    state = state * 1664525u + 1013904223u;
    if (value == 0) return 0;
    const double far = std::numeric_limits<double>::infinity();
    switch ((state >> 24) % 3) {
        case 0:
            return std::nextafter(value, far);
        case 1:
            return std::nextafter(value, -far);
        default:
            return value;
    }
}

Vec3 nudged(const Vec3& value, unsigned& state) {
    Vec3 result;
    for (int k = 0; k < 3; ++k) result[k] = nudged(value[k], state);
    return result;
}

}  // namespace culet::hard
