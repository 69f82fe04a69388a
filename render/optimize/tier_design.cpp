#include "render/optimize/tier_design.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <set>

#include "stone/design/drawn_symmetry.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr Vec3 k_up{0, 0, 1};
// Gauss-Newton converges quadratically: from a miss of 1e-3, four steps reach rounding error.
constexpr int k_most_steps = 12;
// Relative to the stone's size: rounding error of offsets computed from some ten numbers.
constexpr double k_closed = 1e-13, k_not_above = 1e-10;
// Weight of angles (radians) against offsets (in sizes): a degree counts as much as the whole size,
// so that angles change only if meets tie them.
constexpr double k_angle_weight = 60;
// Smallest relative singular value: meets that tie angles to each other are dependent equations
// with smaller ones. Meets of real designs miss by up to 3e-4.
constexpr double k_dependent = 1e-7;
// Relative to the diameter: 0.04 mm of a stone of 8 mm, visible with a loupe, and ten times the
// largest miss that readers of designs accept (CutReading::meet_tolerance).
constexpr double k_least_edge = 0.005;

// Sets a facet's angle from the horizontal; pavilion normals still point down.
Vec3 tilted(const Vec3& normal, double angle) {
    const double level = std::hypot(normal.x, normal.y);
    const double side = normal.z < 0 ? -1 : 1;
    return {std::sin(angle) * normal.x / level, std::sin(angle) * normal.y / level,
            side * std::cos(angle)};
}

// Derivative of the normal with respect to the angle.
Vec3 slope_of(const Vec3& normal) {
    const double level = std::hypot(normal.x, normal.y), side = normal.z < 0 ? -1 : 1;
    return {std::abs(normal.z) * normal.x / level, std::abs(normal.z) * normal.y / level,
            -side * level};
}

double angle_of(const Vec3& normal) {
    return std::atan2(std::hypot(normal.x, normal.y), std::abs(normal.z));
}

double height_at(const Plane& plane, const Vec3& at) {
    return (plane.offset - plane.normal.x * at.x - plane.normal.y * at.y) / plane.normal.z;
}

}  // namespace

double mean_angle(const Solid& solid, const FacetTier& tier) {
    double sum = 0;
    for (const int f : tier.facets)
        sum += angle_of(solid.facets[static_cast<std::size_t>(f)].plane.normal);
    return sum / static_cast<double>(tier.facets.size());
}

struct TierDesign::Planes {
    std::vector<Plane> of;  // by facet
};

TierDesign::TierDesign(const Solid& solid) : solid_(solid), size_(diameter(solid)) {
    const std::size_t count = solid.facets.size();
    angle_is_free_.assign(count, false);
    offset_is_free_.assign(count, true);
    facets_at_.resize(solid.vertices.size());
    for (std::size_t f = 0; f < count; ++f) {
        for (const int corner : solid.facets[f].corners)
            facets_at_[static_cast<std::size_t>(corner)].push_back(static_cast<int>(f));
    }
    for (FacetTier& tier : tiers_of(solid, k_up)) {
        const bool slopes = tier.part == StonePart::crown || tier.part == StonePart::pavilion;
        for (const int f : tier.facets) {
            angle_is_free_[static_cast<std::size_t>(f)] = slopes;
            offset_is_free_[static_cast<std::size_t>(f)] = tier.part != StonePart::girdle;
        }
        if (slopes) tiers_.push_back(std::move(tier));
    }
    if (tiers_.empty()) throw InputError("has no facets of crown or pavilion to change");
    std::vector<std::vector<int>> orbits;
    for (const FacetOrbit& orbit :
         orbits_of(drawn_symmetry(solid, k_up, table_facet(solid, k_up)).group, count))
        orbits.push_back(orbit.facets);
    tie_tiers(orbits);
    put_in_order(std::move(orbits));
    const std::optional<Solid> start = with(std::vector<double>(tiers_.size(), 0));
    if (!start) throw InputError("its facets miss their meets by too much to change their angles");
    start_ = *start;
}

void TierDesign::tie_tiers(const std::vector<std::vector<int>>& orbits) {
    std::vector<int> orbit_of(solid_.facets.size());
    for (std::size_t o = 0; o < orbits.size(); ++o) {
        for (const int f : orbits[o]) orbit_of[std::size_t(f)] = static_cast<int>(o);
    }
    std::vector<std::set<int>> reached;  // orbits in each set
    for (std::size_t t = 0; t < tiers_.size(); ++t) {
        std::vector<int> together{static_cast<int>(t)};
        std::set<int> own;
        for (const int f : tiers_[t].facets) own.insert(orbit_of[std::size_t(f)]);
        for (std::size_t s = reached.size(); s-- > 0;) {
            if (std::none_of(own.begin(), own.end(),
                             [&](int orbit) { return reached[s].contains(orbit); }))
                continue;
            own.insert(reached[s].begin(), reached[s].end());
            together.insert(together.begin(), tied_[s].begin(), tied_[s].end());
            reached.erase(reached.begin() + std::ptrdiff_t(s));
            tied_.erase(tied_.begin() + std::ptrdiff_t(s));
        }
        reached.push_back(std::move(own));
        tied_.push_back(std::move(together));
    }
}

void TierDesign::put_in_order(std::vector<std::vector<int>> orbits) {
    const auto next_to_girdle = [&](const std::vector<int>& orbit) {
        double least = size_;
        for (const int f : orbit) {
            const Facet& facet = solid_.facets[static_cast<std::size_t>(f)];
            for (const int c : facet.corners) {
                const double z = solid_.vertices[static_cast<std::size_t>(c)].z;
                least = std::min(least, facet.plane.normal.z > 0 ? z : -z);
            }
        }
        return least;
    };
    for (std::vector<int>& orbit : orbits) {
        std::erase_if(orbit, [&](int f) { return !angle_is_free_[std::size_t(f)]; });
        if (!orbit.empty()) order_.push_back(std::move(orbit));
    }
    std::stable_sort(order_.begin(), order_.end(), [&](const auto& a, const auto& b) {
        return next_to_girdle(a) < next_to_girdle(b);
    });
}

TierDesign::Planes TierDesign::wanted(const std::vector<double>& steeper) const {
    Planes planes;
    std::vector<double> turn(solid_.facets.size(), 0);
    for (std::size_t t = 0; t < tiers_.size(); ++t) {
        for (const int f : tiers_[t].facets) turn[static_cast<std::size_t>(f)] = steeper[t];
    }
    for (const Facet& facet : solid_.facets) planes.of.push_back(facet.plane);
    std::vector<bool> done(solid_.facets.size(), false);
    // New position of a corner: at the height of the facets already turned.
    const auto moved = [&](int corner) {
        Vec3 at = solid_.vertices[static_cast<std::size_t>(corner)];
        double sum = 0;
        int of = 0;
        for (const int f : facets_at_[static_cast<std::size_t>(corner)]) {
            if (!done[static_cast<std::size_t>(f)]) continue;
            sum += height_at(planes.of[static_cast<std::size_t>(f)], at);
            ++of;
        }
        if (of > 0) at.z = sum / of;
        return at;
    };
    for (const std::vector<int>& orbit : order_) {
        for (const int f : orbit) {
            const Facet& facet = solid_.facets[static_cast<std::size_t>(f)];
            Plane& plane = planes.of[static_cast<std::size_t>(f)];
            const double side = facet.plane.normal.z > 0 ? 1 : -1;
            plane.normal = tilted(plane.normal, angle_of(plane.normal) + turn[std::size_t(f)]);
            int pivot = facet.corners.front();
            for (const int c : facet.corners) {
                if (side * solid_.vertices[std::size_t(c)].z <
                    side * solid_.vertices[std::size_t(pivot)].z)
                    pivot = c;
            }
            plane.offset = glm::dot(plane.normal, moved(pivot));
        }
        // Mark the orbit as a whole, so that no facet in it follows another.
        for (const int f : orbit) done[static_cast<std::size_t>(f)] = true;
    }
    for (std::size_t f = 0; f < planes.of.size(); ++f) {
        if (angle_is_free_[f] || !offset_is_free_[f]) continue;
        const std::vector<int>& corners = solid_.facets[f].corners;
        planes.of[f].offset = 0;
        for (const int c : corners)
            planes.of[f].offset += glm::dot(planes.of[f].normal, moved(c)) / double(corners.size());
    }
    return planes;
}

std::optional<TierDesign::Planes> TierDesign::closed(Planes planes) const {
    const Eigen::Index count = static_cast<Eigen::Index>(planes.of.size());
    Eigen::Index rows = 0;
    for (const std::vector<int>& facets : facets_at_)
        rows += std::max<Eigen::Index>(0, static_cast<Eigen::Index>(facets.size()) - 3);
    double before = size_;
    for (int step = 0; step < k_most_steps; ++step) {
        // Columns: angles in units of the weight, offsets in units of the size.
        Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows, 2 * count);
        Eigen::VectorXd misses(rows);
        Eigen::Index row = 0;
        for (const std::vector<int>& facets : facets_at_) {
            const Eigen::Index k = static_cast<Eigen::Index>(facets.size());
            if (k <= 3) continue;
            Eigen::MatrixXd normals(k, 3);
            Eigen::VectorXd offsets(k);
            for (Eigen::Index i = 0; i < k; ++i) {
                const Plane& plane = planes.of[static_cast<std::size_t>(facets[std::size_t(i)])];
                normals.row(i) << plane.normal.x, plane.normal.y, plane.normal.z;
                offsets(i) = plane.offset;
            }
            const PivotedQr qr(normals);
            const Eigen::Vector3d corner = qr.solve_one(offsets);
            const Eigen::MatrixXd q = qr.first(k);
            for (Eigen::Index m = 3; m < k; ++m, ++row) {
                misses(row) = q.col(m).dot(offsets) / size_;
                for (Eigen::Index i = 0; i < k; ++i) {
                    const auto f = static_cast<std::size_t>(facets[std::size_t(i)]);
                    if (offset_is_free_[f]) jacobian(row, count + Eigen::Index(f)) = q(i, m);
                    if (!angle_is_free_[f]) continue;
                    const Vec3 slope = slope_of(planes.of[f].normal);
                    jacobian(row, Eigen::Index(f)) =
                        -q(i, m) *
                        (slope.x * corner.x() + slope.y * corner.y() + slope.z * corner.z()) /
                        (size_ * k_angle_weight);
                }
            }
        }
        const double miss = rows == 0 ? 0 : misses.lpNorm<Eigen::Infinity>();
        if (miss < k_closed || (step > 2 && miss < 100 * k_closed && miss > before / 2))
            return planes;
        if (!std::isfinite(miss)) return std::nullopt;
        before = miss;
        const Eigen::VectorXd change = shortest_solution(jacobian, -misses, k_dependent);
        for (Eigen::Index f = 0; f < count; ++f) {
            Plane& plane = planes.of[static_cast<std::size_t>(f)];
            if (angle_is_free_[static_cast<std::size_t>(f)])
                plane.normal =
                    tilted(plane.normal, angle_of(plane.normal) + change(f) / k_angle_weight);
            plane.offset += size_ * change(count + f);
        }
    }
    return std::nullopt;
}

std::optional<Solid> TierDesign::solid_of(const Planes& planes) const {
    Solid result = solid_;
    for (std::size_t f = 0; f < planes.of.size(); ++f) result.facets[f].plane = planes.of[f];
    for (std::size_t v = 0; v < facets_at_.size(); ++v) {
        const std::vector<int>& facets = facets_at_[v];
        Eigen::MatrixXd normals(static_cast<Eigen::Index>(facets.size()), 3);
        Eigen::VectorXd offsets(normals.rows());
        for (std::size_t i = 0; i < facets.size(); ++i) {
            const Plane& plane = planes.of[static_cast<std::size_t>(facets[i])];
            normals.row(Eigen::Index(i)) << plane.normal.x, plane.normal.y, plane.normal.z;
            offsets(Eigen::Index(i)) = plane.offset;
        }
        const Eigen::Vector3d corner = PivotedQr(normals).solve_one(offsets);
        result.vertices[v] = {corner.x(), corner.y(), corner.z()};
    }
    // Require convexity and the same neighbours: nothing above a plane, every outline still turns
    // left, and no edge is too short.
    for (const Facet& facet : result.facets) {
        for (const Vec3& corner : result.vertices) {
            if (!(height_above(facet.plane, corner) <= k_not_above * size_)) return std::nullopt;
        }
        const std::size_t n = facet.corners.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Vec3 &a = result.vertices[std::size_t(facet.corners[i])],
                       &b = result.vertices[std::size_t(facet.corners[(i + 1) % n])],
                       &c = result.vertices[std::size_t(facet.corners[(i + 2) % n])];
            if (!(glm::dot(glm::cross(b - a, c - b), facet.plane.normal) > 0)) return std::nullopt;
            if (start_.facets.empty()) continue;  // closing the design's own meets
            const double was =
                glm::length(start_.vertices[std::size_t(facet.corners[i])] -
                            start_.vertices[std::size_t(facet.corners[(i + 1) % n])]);
            if (glm::length(b - a) < std::min(was / 2, k_least_edge * size_)) return std::nullopt;
        }
    }
    return result;
}

std::optional<Solid> TierDesign::with(const std::vector<double>& steeper) const {
    for (std::size_t t = 0; t < tiers_.size(); ++t) {
        for (const int f : tiers_[t].facets) {
            const double angle = angle_of(solid_.facets[std::size_t(f)].plane.normal) + steeper[t];
            if (!(angle > 0 && angle < std::acos(0.0))) return std::nullopt;
        }
    }
    const std::optional<Planes> planes = closed(wanted(steeper));
    return planes ? solid_of(*planes) : std::nullopt;
}

}  // namespace culet
