#include "fit/findings/own_axis.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>

#include "fit/model/eigenvector.h"
#include "stone/design/tiers.h"

namespace culet {

namespace {

// Shapes further from a symmetry were not meant to have it (root mean square of corners, half
// diameter 1): a round stone is off by 1 %, an oval of 1.2 to 1 by 9 %.
constexpr double k_near_form = 0.05;
// Part of the total scatter by which the axis must be better than the next direction.
constexpr double k_least_gap = 1e-3;

std::string tier_name(const Solid& solid, const std::vector<FacetTier>& drawn,
                      const std::vector<int>& facets) {
    for (const FacetTier& tier : drawn) {
        if (!tier.pattern.empty() && std::is_permutation(tier.facets.begin(), tier.facets.end(),
                                                         facets.begin(), facets.end()))
            return tier.pattern;
    }
    const auto name = [&](int f) { return solid.facets[std::size_t(f)].name; };
    return name(facets.front()) + ".." + name(facets.back());
}

// One tier's scatter matrix, about the mean of its normals or about zero.
struct Part {
    Part(const Shape& shape, const std::vector<int>& of, bool about_mean) : facets(of) {
        for (const int f : facets) {
            if (about_mean) mean += shape.normals[f] / double(facets.size());
        }
        for (const int f : facets) {
            const Vec3 d = shape.normals[f] - mean;
            matrix += glm::outerProduct(d, d);
        }
    }

    std::vector<int> facets;
    Vec3 mean = Vec3(0);
    glm::dmat3 matrix{0.0};
    double weight = 1;
};

LeastEigenvector axis_of(const std::vector<Part>& parts) {
    glm::dmat3 s(0.0);
    for (const Part& part : parts) s += part.weight * part.matrix;
    return least_eigenvector(s);
}

double trace_of(const glm::dmat3& s) {
    return s[0][0] + s[1][1] + s[2][2];
}

// True if the direction of least scatter is distinct.
bool has_axis(const std::vector<Part>& parts) {
    double total = 0;
    for (const Part& part : parts) total += trace_of(part.matrix);
    // The trace of the pseudo-inverse gives the second smallest eigenvalue.
    const double inverse = trace_of(axis_of(parts).pseudo_inverse);
    return total > 0 && inverse > 0 && 1 / inverse > k_least_gap * total;
}

// Weights 1 / variance of a tier's inclinations about an axis, with a floor: equal facets of a
// design would get unbounded weights.
void weigh_about(const Vec3& axis, const Shape& shape, std::vector<Part>& parts) {
    double pooled = 0, count = 0;
    std::vector<double> squares, sines;
    for (const Part& part : parts) {
        double sine = 0;
        for (const int f : part.facets) {
            const double c = glm::dot(shape.normals[f], axis);
            sine += (1 - c * c) / double(part.facets.size());
        }
        sines.push_back(std::max(sine, 1e-6));
        squares.push_back(glm::dot(axis, part.matrix * axis) / sines.back());
        pooled += squares.back();
        count += double(part.facets.size());
    }
    // Half of the pooled variance stabilises small tiers; a millionth of a degree, perfect ones.
    pooled /= std::max(1.0, count - double(parts.size()) - 2);
    for (std::size_t t = 0; t < parts.size(); ++t) {
        const double n = double(parts[t].facets.size());
        parts[t].weight = 1 / ((squares[t] + 0.5 * pooled) / (n - 0.5) + 1e-16) / sines[t];
    }
}

LeastEigenvector weighted_axis(const Shape& shape, std::vector<Part>& parts) {
    LeastEigenvector least = axis_of(parts);
    for (int round = 0; round < 30; ++round) {
        const Vec3 last = least.vector;
        weigh_about(last, shape, parts);
        least = axis_of(parts);
        if (glm::length(least.vector - last) < 1e-13) break;
    }
    return least;
}

// The axis's component along a perpendicular, as a function of the facets' normals.
Quantity component_of(const LeastEigenvector& axis, const Shape& shape,
                      const std::vector<Part>& parts, const Vec3& along) {
    const Vec3 back = axis.pseudo_inverse * along;
    Quantity q;
    for (const Part& part : parts) {
        for (const int f : part.facets) {
            // d(a) = -(S - l)^+ dS a; the motion of the means drops out.
            const Vec3 d = shape.normals[f] - part.mean;
            q.add(
                Quantity::By::normal, f,
                -part.weight * (back * glm::dot(d, axis.vector) + axis.vector * glm::dot(d, back)));
        }
    }
    return q;
}

}  // namespace

AxisGroup form_group(const FitModel& model, const Shape& shape) {
    const std::vector<Automorphism> all = automorphisms(model.stone().solid);
    // Corners are the points nearest to their planes: points of released meets may be anywhere.
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < model.stone().solid.vertices.size(); ++v) {
        glm::dmat3 normals(0.0);
        Vec3 right(0);
        for (int f : model.edges().facets_of_vertex[v]) {
            const Vec3& n = shape.normals[std::size_t(f)];
            normals += glm::outerProduct(n, n);
            right += shape.offsets[std::size_t(f)] * n;
        }
        const bool crossing = glm::determinant(normals) > 1e-9;
        points.push_back(crossing ? glm::inverse(normals) * right : shape.points[v]);
    }
    return largest_group(motions_about_z(all, points), k_near_form);
}

std::vector<Tier> tiers_of(const FitModel& model, const Shape& shape, const AxisGroup& group) {
    const Solid& solid = model.stone().solid;
    const std::vector<FacetTier> drawn = culet::tiers_of(solid, model.stone().up);
    std::vector<Tier> tiers;
    for (const FacetOrbit& orbit : orbits_of(group, shape.normals.size())) {
        if (orbit.facets.size() < 2) continue;
        Tier tier;
        tier.facets = orbit.facets;
        std::sort(tier.facets.begin(), tier.facets.end());
        tier.name = tier_name(solid, drawn, tier.facets);
        tiers.push_back(std::move(tier));
    }
    return tiers;
}

AxisEstimate own_axis(const FitModel& model, const Shape& shape, const std::vector<Tier>& tiers,
                      const Covariance* covariance) {
    AxisEstimate estimate;
    OwnAxis& axis = estimate.axis;
    axis.sigma = axis.scatter_sigma = std::numeric_limits<double>::infinity();
    std::vector<Part> parts;
    for (const Tier& tier : tiers) parts.emplace_back(shape, tier.facets, true);
    axis.basis = "tiers";
    if (parts.empty() || !has_axis(parts)) {
        std::vector<int> girdle;
        for (std::size_t f = 0; f < shape.normals.size(); ++f) {
            if (model.frame().is_girdle(int(f))) girdle.push_back(int(f));
        }
        parts = {Part(shape, girdle, false)};
        axis.basis = "girdle";
        if (girdle.size() < 3 || !has_axis(parts)) {
            axis.basis = "neither tiers of like facets nor a girdle that could tell it";
            return estimate;
        }
    }
    const LeastEigenvector weighted = weighted_axis(shape, parts);
    axis.known = true;
    axis.direction = weighted.vector;
    axis.tilt = std::atan2(std::hypot(axis.direction.x, axis.direction.y), axis.direction.z);
    axis.azimuth = azimuth(Vec3{axis.direction.x, axis.direction.y, 0});
    // With weights of 1 / variance the matrix is the information on the axis.
    axis.scatter_sigma = std::sqrt(0.5 * trace_of(weighted.pseudo_inverse));
    estimate.east = glm::normalize(Vec3{1, 0, 0} - axis.direction.x * axis.direction);
    estimate.north = glm::cross(axis.direction, estimate.east);
    for (const Vec3& e : {estimate.east, estimate.north}) {
        estimate.across.push_back(component_of(weighted, shape, parts, e));
    }
    if (covariance) {
        const Eigen::MatrixXd cov =
            covariance->joint(covariance->linear().writer.functions(estimate.across));
        axis.sigma = std::sqrt(std::max(0.0, 0.5 * cov.trace()));
    }
    return estimate;
}

}  // namespace culet
