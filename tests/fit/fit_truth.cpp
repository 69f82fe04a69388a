#include "tests/fit/fit_truth.h"

#include <fmt/format.h>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <stdexcept>

#include "stone/cuts/cuts.h"
#include "stone/solid/checks.h"
#include "stone/solid/half_edges.h"

namespace culet::bench {

namespace {

constexpr double k_pi = std::numbers::pi;
using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

void planes_from_corners(Solid& solid) {
    for (Facet& facet : solid.facets) {
        std::vector<Vec3> loop;
        for (int corner : facet.corners) loop.push_back(solid.vertices[corner]);
        facet.plane = plane_through(loop);
    }
}

Solid random_cut(TruthKind kind, Random& random) {
    const auto r = [&](double low, double high) { return uniform(random, low, high); };
    switch (kind) {
        case TruthKind::round:
            return make_cut("round-brilliant", {{"table", r(50, 64)},
                                                {"crown-angle", r(30, 38)},
                                                {"pavilion-angle", r(39.5, 43)},
                                                {"star", r(40, 60)},
                                                {"lower-half", r(70, 85)},
                                                {"girdle", r(2, 5)},
                                                {"girdle-segments", 1}});
        case TruthKind::step:
            return make_cut("step", {{"table", r(52, 66)},
                                     {"crown-angle", r(34, 42)},
                                     {"crown-spread", r(6, 11)},
                                     {"pavilion-angle", r(44, 52)},
                                     {"pavilion-spread", r(5, 10)},
                                     {"girdle", r(2.5, 5)},
                                     {"corner", r(18, 32)}});
        case TruthKind::pear:
            return make_cut("pear", {{"ratio", r(1.35, 1.65)},
                                     {"table", r(52, 62)},
                                     {"crown-angle", r(32, 37)},
                                     {"pavilion-angle", r(39, 43)}});
        case TruthKind::trillion:
            return make_cut("trillion", {{"table", r(50, 62)},
                                         {"bulge", r(7, 14)},
                                         {"crown-angle", r(31, 37)},
                                         {"pavilion-angle", r(38, 42)}});
    }
    return {};
}

WrittenReading written(std::string kind, std::vector<std::string> of, std::optional<double> value,
                       double sigma) {
    WrittenReading w;
    w.kind = std::move(kind);
    w.of = std::move(of);
    w.value = value;
    if (sigma > 0) {
        w.sigma = sigma;
    } else {
        w.exact = true;
    }
    return w;
}

void tilt_and_shift(Solid& solid, Random& random, double tilt, double shift) {
    std::normal_distribution<double> normal;
    for (Facet& facet : solid.facets) {
        const Vec3 middle = corner_mean(solid, facet);
        const Vec3 turn{normal(random), normal(random), normal(random)};
        Vec3 n = facet.plane.normal;
        if (facet.name != "T") n = glm::normalize(n + tilt * glm::cross(turn, n));
        facet.plane = {n, glm::dot(n, middle) + shift * normal(random)};
    }
}

}  // namespace

const char* name_of(TruthKind kind) {
    switch (kind) {
        case TruthKind::round:
            return "round";
        case TruthKind::step:
            return "step";
        case TruthKind::pear:
            return "pear";
        case TruthKind::trillion:
            return "trillion";
    }
    return "";
}

bool bring_to_meet(Solid& solid) {
    const int facets = static_cast<int>(solid.facets.size());
    const int size = 4 * facets + 3 * static_cast<int>(solid.vertices.size());
    for (int round = 0; round < 40; ++round) {
        std::vector<Eigen::Triplet<double>> entries;
        std::vector<double> left;
        for (int f = 0; f < facets; ++f) {
            const Plane& plane = solid.facets[f].plane;
            for (int corner : solid.facets[f].corners) {
                const Vec3& p = solid.vertices[corner];
                const int row = static_cast<int>(left.size());
                for (int k = 0; k < 3; ++k) {
                    entries.emplace_back(row, 4 * f + k, p[k]);
                    entries.emplace_back(row, 4 * facets + 3 * corner + k, plane.normal[k]);
                }
                entries.emplace_back(row, 4 * f + 3, -1.0);
                left.push_back(-(glm::dot(plane.normal, p) - plane.offset));
            }
            const int row = static_cast<int>(left.size());
            for (int k = 0; k < 3; ++k) entries.emplace_back(row, 4 * f + k, 2 * plane.normal[k]);
            left.push_back(1 - glm::dot(plane.normal, plane.normal));
        }
        const Eigen::Map<Eigen::VectorXd> residual(left.data(), Eigen::Index(left.size()));
        if (residual.lpNorm<Eigen::Infinity>() < 1e-14) return true;
        Eigen::SparseMatrix<double> a(Eigen::Index(left.size()), size);
        a.setFromTriplets(entries.begin(), entries.end());
        const Eigen::SparseMatrix<double> normal = a * a.transpose();
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(normal);
        if (factors.info() != Eigen::Success) return false;
        const Eigen::VectorXd step = a.transpose() * factors.solve(residual);
        if (!step.allFinite() || step.lpNorm<Eigen::Infinity>() > 1e3) return false;
        for (int f = 0; f < facets; ++f) {
            Plane& plane = solid.facets[f].plane;
            for (int k = 0; k < 3; ++k) plane.normal[k] += step(4 * f + k);
            plane.offset += step(4 * f + 3);
        }
        for (std::size_t v = 0; v < solid.vertices.size(); ++v) {
            for (int k = 0; k < 3; ++k) {
                solid.vertices[v][k] += step(4 * facets + 3 * int(v) + k);
            }
        }
        if (step.lpNorm<Eigen::Infinity>() < 1e-15 * diameter(solid)) return true;
    }
    return planarity(solid) < 1e-11 * diameter(solid);
}

Truth make_truth(TruthKind kind, bool symmetric, unsigned seed) {
    Random random(seed * 7919u + static_cast<unsigned>(kind));
    for (int attempt = 0; attempt < 200; ++attempt) {
        Truth truth;
        try {
            truth.stone.solid = random_cut(kind, random);
        } catch (const std::exception&) {
            continue;  // proportions that leave no room for a facet
        }
        Solid& solid = truth.stone.solid;
        truth.stone.up_facet = "T";
        truth.stone.material.density_g_cm3 = 3.5;
        if (!symmetric) tilt_and_shift(solid, random, radians(0.3), 0.015);
        if (!bring_to_meet(solid)) continue;
        if (!symmetric) {
            // The frame is defined by a level table.
            const Vec3 n = solid.facets[find_facet(solid, "T")].plane.normal;
            const Vec3 axis = glm::cross(n, Vec3{0, 0, 1});
            const auto level = [&](const Vec3& v) {
                return v * n.z + glm::cross(axis, v) + axis * (glm::dot(axis, v) / (1 + n.z));
            };
            for (Vec3& v : solid.vertices) v = level(v);
            for (Facet& f : solid.facets) f.plane.normal = glm::normalize(level(f.plane.normal));
        }
        if (!is_convex(solid)) continue;
        if (symmetric) {
            const auto exact = [&](const char* what, const char* of) {
                truth.symmetry.push_back(written(what, {of}, std::nullopt, 0));
            };
            if (kind == TruthKind::round) exact("rotation", "8");
            if (kind == TruthKind::step) exact("rotation", "2");
            if (kind == TruthKind::trillion) exact("rotation", "3");
            exact("mirror", "90");  // the plane contains x
        }
        return truth;
    }
    throw std::runtime_error("no such stone");
}

Truth make_tiered(int facets, unsigned seed) {
    Random random(seed * 104729u + static_cast<unsigned>(facets));
    // Tiers of about 3 sqrt(facets) / 2 facets each, from below the table to the bottom.
    const int tiers = std::max(3, static_cast<int>(std::lround(std::sqrt(facets / 5.0))));
    std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, 0.55}}};
    const int each = (facets - 1) / tiers;
    const double wide = uniform(random, 0.75, 0.95);
    for (int t = 0; t < tiers; ++t) {
        const double low = radians(38), high = radians(172);
        const double tilt = low + (high - low) * (t + uniform(random, -0.1, 0.1)) / (tiers - 1);
        const double phase = uniform(random, 0, 2 * k_pi);
        for (int k = 0; k < each; ++k) {
            const double a = phase + 2 * k_pi * (k + uniform(random, -0.12, 0.12)) / each;
            const double i = tilt + radians(uniform(random, -1.5, 1.5));
            const Vec3 n{std::sin(i) * std::cos(a), std::sin(i) * std::sin(a), std::cos(i)};
            // The ellipsoid's support function.
            const double reach = std::sqrt(n.x * n.x + wide * wide * n.y * n.y + 0.49 * n.z * n.z) *
                                 uniform(random, 0.999, 1.001);
            planes.push_back({fmt::format("F{}x{}", t, k), {n, reach}});
        }
    }
    for (NamedPlane& p : planes) p.plane.offset *= 4;
    Truth truth;
    const HalfSpaceSolid cut = intersect_half_spaces(planes);
    truth.stone.solid = contract_near_meets(cut.solid, 0).solid;
    truth.stone.up_facet = "T";
    bring_to_meet(truth.stone.solid);
    return truth;
}

std::vector<WrittenReading> read_azimuths(const Truth& truth, unsigned seed) {
    Random random(seed);
    std::normal_distribution<double> normal;
    std::vector<WrittenReading> readings;
    for (const Facet& f : truth.stone.solid.facets) {
        if (f.name == truth.stone.up_facet) continue;
        const Vec3& n = f.plane.normal;
        WrittenReading r;
        r.kind = "azimuth";
        r.of = {f.name};
        r.sigma = truth.angle_sigma_deg / std::hypot(n.x, n.y);
        r.value = degrees(std::atan2(n.y, n.x)) + *r.sigma * normal(random);
        readings.push_back(std::move(r));
    }
    return readings;
}

std::vector<WrittenReading> read_perfectly(const Truth& truth, int edges) {
    const Solid& solid = truth.stone.solid;
    std::vector<WrittenReading> readings = truth.symmetry;
    const bool symmetric = !truth.symmetry.empty();
    for (const Facet& f : solid.facets) {
        if (f.name == "T") continue;
        readings.push_back(written("inclination", {f.name},
                                   degrees(inclination(f.plane.normal, {0, 0, 1})),
                                   truth.angle_sigma_deg));
    }
    for (int k = 0; k < 8; ++k) {
        const double a = radians(22.5 * k);
        readings.push_back(written("width", {fmt::format("{}", 22.5 * k)},
                                   width_along(solid, {std::cos(a), std::sin(a), 0}),
                                   truth.length_sigma));
    }
    readings.push_back(written("depth", {}, width_along(solid, {0, 0, 1}), truth.length_sigma));
    std::vector<Edge> of = half_edges(solid).edges;
    if (symmetric && edges < 0) {
        // With symmetry some edges are enough: about as many as fit on a page.
        edges = std::min<int>(static_cast<int>(of.size()), 50);
    }
    const int count =
        edges < 0 ? static_cast<int>(of.size()) : std::min(edges, static_cast<int>(of.size()));
    for (int k = 0; k < count; ++k) {
        const Edge& e = of[std::size_t(k) * of.size() / std::size_t(count)];
        readings.push_back(written("edge", {solid.facets[e.left].name, solid.facets[e.right].name},
                                   glm::length(solid.vertices[e.from] - solid.vertices[e.to]),
                                   truth.length_sigma));
    }
    return readings;
}

std::vector<WrittenReading> read_by_instruments(const Truth& truth, unsigned seed, int edges) {
    std::vector<WrittenReading> readings = read_perfectly(truth, edges);
    Random random(seed);
    std::normal_distribution<double> normal;
    for (WrittenReading& r : readings) {
        if (!r.value) continue;
        *r.value += *r.sigma * normal(random);
        // Instruments do not show more than 90 degrees.
        if (r.kind == "inclination") r.value = 90 - std::abs(90 - std::abs(*r.value));
        if (r.kind == "edge") r.value = std::max(1e-4, *r.value);
    }
    return readings;
}

Stone noisy_mesh(const Stone& stone, double part, unsigned seed) {
    Stone mesh = stone;
    Random random(seed);
    std::normal_distribution<double> normal(0, part * diameter(stone.solid) / std::sqrt(3.0));
    for (Vec3& v : mesh.solid.vertices) v += Vec3{normal(random), normal(random), normal(random)};
    planes_from_corners(mesh.solid);
    return mesh;
}

Stone wrongly_drawn(const Stone& stone, double part, unsigned seed) {
    Stone mesh = stone;
    Random random(seed);
    std::normal_distribution<double> normal;
    Vec3 scale(1);
    for (int k = 0; k < 3; ++k) scale[k] = std::exp(2 * part * normal(random));
    const double above = std::exp(2 * part * normal(random)),
                 below = std::exp(2 * part * normal(random));
    std::vector<std::pair<double, double>> radii;  // height, factor
    const double size = diameter(stone.solid);
    for (Vec3& v : mesh.solid.vertices) {
        double factor = 0;
        for (const auto& [height, f] : radii) {
            if (std::abs(height - v.z) < 0.01 * size) factor = f;
        }
        if (factor == 0) {
            factor = std::exp(part * normal(random));
            radii.emplace_back(v.z, factor);
        }
        v = Vec3{v.x * factor, v.y * factor, v.z * (v.z > 0 ? above : below)} * scale;
        for (int k = 0; k < 3; ++k) v[k] += 0.3 * part * size / std::sqrt(3.0) * normal(random);
    }
    planes_from_corners(mesh.solid);
    return mesh;
}

Stone kicked_mesh(const Stone& stone, unsigned seed) {
    Stone mesh = stone;
    Random random(seed);
    std::vector<Vec3>& vertices = mesh.solid.vertices;
    const std::size_t at =
        std::uniform_int_distribution<std::size_t>(0, vertices.size() - 1)(random);
    double nearest = 1e300;
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        if (v != at) nearest = std::min(nearest, glm::length(vertices[v] - vertices[at]));
    }
    std::normal_distribution<double> normal;
    vertices[at] += nearest * glm::normalize(Vec3{normal(random), normal(random), normal(random)});
    planes_from_corners(mesh.solid);
    return mesh;
}

}  // namespace culet::bench
