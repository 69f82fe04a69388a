// Uses circle patterns (Bobenko & Springborn 2004, section on orthogonal circles): one circle for
// each vertex and each facet. The circles of neighbouring vertices touch at the edge's point, as do
// those of neighbouring facets; the two pairs cross there at right angles. With one edge's point at
// infinity its four circles are lines, and the logarithms u of the other radii minimise a convex
// function whose gradient vanishes where
//
//     sum over crossing circles j of 2 atan(exp(u_j - u_i)) = 2 pi - pi (number of crossing lines)

#include "fit/model/canonical.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <numbers>

#include "fit/model/sparse_ldl.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

using Complex = std::complex<double>;
constexpr double k_pi = std::numbers::pi;

// Circles are numbered: vertices, then facets.
struct Pattern {
    int vertices = 0, circles = 0;
    std::vector<std::vector<int>> crossing;  // in cyclic order
    std::vector<std::vector<int>> between;   // between[i][k]: edge between crossing k and k + 1
    std::vector<bool> is_line;
};

Pattern pattern_of(const Solid& solid, const HalfEdges& half, int infinite) {
    Pattern pattern;
    pattern.vertices = static_cast<int>(solid.vertices.size());
    pattern.circles = pattern.vertices + static_cast<int>(solid.facets.size());
    pattern.crossing.resize(std::size_t(pattern.circles));
    pattern.between.resize(std::size_t(pattern.circles));
    pattern.is_line.assign(std::size_t(pattern.circles), false);
    std::map<std::pair<int, int>, int> edge_of;  // by its ends, in either direction
    std::map<std::pair<int, int>, int> edge_of_facets;
    for (std::size_t e = 0; e < half.edges.size(); ++e) {
        const Edge& edge = half.edges[e];
        edge_of[{edge.from, edge.to}] = edge_of[{edge.to, edge.from}] = static_cast<int>(e);
        edge_of_facets[{edge.left, edge.right}] = edge_of_facets[{edge.right, edge.left}] =
            static_cast<int>(e);
    }
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const int circle = pattern.vertices + static_cast<int>(f);
        const std::vector<int>& loop = solid.facets[f].corners;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            pattern.crossing[circle].push_back(loop[k]);
            pattern.between[circle].push_back(edge_of[{loop[k], loop[(k + 1) % loop.size()]}]);
        }
    }
    for (int v = 0; v < pattern.vertices; ++v) {
        const std::vector<int>& fan = half.facets_of_vertex[v];
        for (std::size_t k = 0; k < fan.size(); ++k) {
            pattern.crossing[v].push_back(pattern.vertices + fan[k]);
            pattern.between[v].push_back(edge_of_facets[{fan[k], fan[(k + 1) % fan.size()]}]);
        }
    }
    const Edge& edge = half.edges[infinite];
    for (int line :
         {edge.from, edge.to, pattern.vertices + edge.left, pattern.vertices + edge.right}) {
        pattern.is_line[line] = true;
    }
    return pattern;
}

// Hessian of the convex function. `index`: the unknown of each circle, -1 for lines.
void set_hessian(const Pattern& pattern, const std::vector<int>& index,
                 const std::vector<double>& at, Eigen::SparseMatrix<double>& hessian) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < pattern.circles; ++i) {
        if (index[i] < 0) continue;
        // Fix one circle's size: the pattern has no scale.
        double sum = index[i] == 0 ? 1.0 : 1e-14;
        for (int j : pattern.crossing[i]) {
            if (pattern.is_line[j]) continue;
            const double weight = 1 / std::cosh(at[j] - at[i]);
            sum += weight;
            if (index[j] < index[i]) entries.emplace_back(index[i], index[j], -weight);
        }
        entries.emplace_back(index[i], index[i], sum);
    }
    hessian.setFromTriplets(entries.begin(), entries.end());
}

// Minimises it by Newton's method; nothing when the pattern cannot be drawn.
std::optional<std::vector<double>> log_radii(const Pattern& pattern) {
    std::vector<int> index(std::size_t(pattern.circles), -1);
    int count = 0;
    for (int i = 0; i < pattern.circles; ++i) {
        if (!pattern.is_line[i]) index[i] = count++;
    }
    std::vector<double> u(std::size_t(pattern.circles), 0.0);
    const auto gradient = [&](const std::vector<double>& at, Eigen::VectorXd& g) {
        g.setZero(count);
        for (int i = 0; i < pattern.circles; ++i) {
            if (index[i] < 0) continue;
            double sum = 2 * k_pi;
            for (int j : pattern.crossing[i]) {
                sum -= pattern.is_line[j] ? k_pi : 2 * std::atan(std::exp(at[j] - at[i]));
            }
            g(index[i]) = sum;
        }
    };
    Eigen::VectorXd g;
    gradient(u, g);
    SparseLdl factors;
    Eigen::SparseMatrix<double> hessian(count, count);
    for (int round = 0; round < 60; ++round) {
        if (g.lpNorm<Eigen::Infinity>() < 1e-11) return u;
        set_hessian(pattern, index, u, hessian);
        if (round == 0) factors.analyse(hessian);
        if (!factors.factor(hessian)) return std::nullopt;
        const Eigen::VectorXd step = factors.solve(-g);
        if (!step.allFinite()) return std::nullopt;
        double factor = std::min(1.0, 3.0 / (1e-300 + step.lpNorm<Eigen::Infinity>()));
        bool better = false;
        for (int halving = 0; halving < 12; ++halving, factor /= 2) {
            std::vector<double> next = u;
            for (int i = 0; i < pattern.circles; ++i) {
                if (index[i] >= 0) next[i] += factor * step(index[i]);
            }
            Eigen::VectorXd there;
            gradient(next, there);
            if (there.norm() < g.norm()) {
                u = std::move(next);
                g = there;
                better = true;
                break;
            }
        }
        if (!better) break;
    }
    if (g.lpNorm<Eigen::Infinity>() < 1e-8) return u;
    return std::nullopt;
}

// Returns the touching points of all edges but the one at infinity.
std::optional<std::vector<Complex>> drawn(const Pattern& pattern, const std::vector<double>& u,
                                          std::size_t edges, int infinite) {
    std::vector<Complex> point(edges), centre(std::size_t(pattern.circles));
    std::vector<bool> known(edges, false), placed(std::size_t(pattern.circles), false);
    // A crossing circle of each placed circle, and the direction in which it sees it.
    std::vector<std::pair<int, double>> seen(std::size_t(pattern.circles));
    int first = -1;
    double largest = -1e300;
    for (int i = 0; i < pattern.circles; ++i) {
        if (!pattern.is_line[i] && u[i] > largest) {
            largest = u[i];
            first = i;
        }
    }
    placed[first] = true;
    seen[first] = {0, 0.0};
    std::vector<int> queue{first};
    const auto half_angle = [&](int i, int j) {
        return pattern.is_line[j] ? k_pi / 2 : std::atan(std::exp(u[j] - u[i]));
    };
    for (std::size_t q = 0; q < queue.size(); ++q) {
        const int i = queue[q];
        const std::vector<int>& around = pattern.crossing[i];
        const int count = static_cast<int>(around.size());
        const double radius = std::exp(u[i]);
        auto [k, angle] = seen[i];
        for (int turn = 0; turn < count; ++turn, k = (k + 1) % count) {
            const int j = around[k];
            if (!pattern.is_line[j] && !placed[j]) {
                placed[j] = true;
                centre[j] = centre[i] + std::polar(std::hypot(radius, std::exp(u[j])), angle);
                const std::vector<int>& back = pattern.crossing[j];
                const auto at = std::find(back.begin(), back.end(), i);
                seen[j] = {static_cast<int>(at - back.begin()), angle + k_pi};
                queue.push_back(j);
            }
            const int edge = pattern.between[i][k];
            angle += half_angle(i, j);
            if (!known[edge]) {
                known[edge] = true;
                point[edge] = centre[i] + std::polar(radius, angle);
            }
            angle += half_angle(i, around[(k + 1) % count]);
        }
    }
    for (std::size_t e = 0; e < edges; ++e) {
        if (!known[e] && static_cast<int>(e) != infinite) return std::nullopt;
    }
    return point;
}

// Moves the mean of points on the sphere to its centre by Moebius maps of the ball. Newton's
// method: to first order, mapping a to the centre moves p by -2 (a - (a.p) p).
bool centre_on_sphere(std::vector<Vec3>& points) {
    const double share = 1 / static_cast<double>(points.size());
    for (int round = 0; round < 200; ++round) {
        Vec3 mean(0);
        glm::dmat3 spread(0.0);
        for (const Vec3& p : points) {
            mean += share * p;
            spread += share * glm::outerProduct(p, p);
        }
        if (glm::length(mean) < 1e-12) return true;
        Vec3 a = 0.5 * (glm::inverse(glm::dmat3(1.0 + 1e-12) - spread) * mean);
        if (!std::isfinite(glm::dot(a, a))) a = mean;
        const double length = glm::length(a);
        if (length > 0.6) a *= 0.6 / length;
        const double aa = glm::dot(a, a);
        for (Vec3& p : points) {
            const Vec3 off = p - a;
            p = glm::normalize((1 - aa) * off / glm::dot(off, off) - a);
        }
    }
    return false;
}

// The edge between the facets with most corners: its four circles are large in any pattern.
int edge_at_infinity(const Solid& solid, const HalfEdges& half) {
    int infinite = 0;
    std::size_t most = 0;
    for (std::size_t e = 0; e < half.edges.size(); ++e) {
        const std::size_t corners = solid.facets[half.edges[e].left].corners.size() +
                                    solid.facets[half.edges[e].right].corners.size();
        if (corners > most) {
            most = corners;
            infinite = static_cast<int>(e);
        }
    }
    return infinite;
}

// Maps onto the sphere by stereographic projection; the edge at infinity touches at the pole.
std::vector<Vec3> on_sphere(const std::vector<Complex>& flat, int infinite) {
    Complex mean(0, 0);
    for (const Complex& z : flat) mean += z / double(flat.size());
    std::vector<double> reach;
    for (const Complex& z : flat) reach.push_back(std::abs(z - mean));
    const double scale = 1 / std::max(1e-300, upper_median(std::move(reach)));
    std::vector<Vec3> touch;
    for (std::size_t e = 0; e < flat.size(); ++e) {
        const Complex z = (flat[e] - mean) * scale;
        const double r2 = std::norm(z);
        // y changes sign because the pattern is seen from outside the sphere.
        touch.push_back(static_cast<int>(e) == infinite
                            ? Vec3{0, 0, 1}
                            : Vec3{2 * z.real(), -2 * z.imag(), r2 - 1} / (r2 + 1));
    }
    return touch;
}

}  // namespace

std::optional<Shape> canonical_polyhedron(const Solid& solid, const HalfEdges& half) {
    if (half.edges.size() < 6) return std::nullopt;
    const int infinite = edge_at_infinity(solid, half);
    const Pattern pattern = pattern_of(solid, half, infinite);
    const auto radii = log_radii(pattern);
    if (!radii) return std::nullopt;
    const auto flat = drawn(pattern, *radii, half.edges.size(), infinite);
    if (!flat) return std::nullopt;
    std::vector<Vec3> touch = on_sphere(*flat, infinite);
    if (!centre_on_sphere(touch)) return std::nullopt;

    Shape shape;
    const auto plane = [&](int circle) {
        std::vector<Vec3> loop;
        for (int e : pattern.between[circle]) loop.push_back(touch[e]);
        return plane_through(loop);
    };
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const Plane p = plane(pattern.vertices + static_cast<int>(f));
        if (!(p.offset > 0)) return std::nullopt;
        shape.normals.push_back(p.normal);
        shape.offsets.push_back(p.offset);
    }
    for (int v = 0; v < pattern.vertices; ++v) {
        const Plane p = plane(v);
        if (!(p.offset > 1e-9)) return std::nullopt;
        shape.points.push_back(p.normal / p.offset);
    }
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        for (int corner : solid.facets[f].corners) {
            const double off = glm::dot(shape.normals[f], shape.points[corner]) - shape.offsets[f];
            if (!(std::abs(off) < 1e-4)) return std::nullopt;
        }
    }
    return shape;
}

}  // namespace culet
