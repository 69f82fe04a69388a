// Contracts the near-miss meets of a design.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "stone/numbers/dense_algebra.h"
#include "stone/solid/solid.h"

namespace culet {

namespace {

using Outline = std::vector<int>;

/// A corner, and the given solid's corners that it stands for.
struct MergedCorner {
    Vec3 position;
    std::vector<int> members;
};

Outline without_repeats(const Outline& outline) {
    Outline kept;
    for (const int corner : outline) {
        if (kept.empty() || kept.back() != corner) kept.push_back(corner);
    }
    while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
    return kept;
}

class Contraction {
public:
    explicit Contraction(const Solid& solid) : solid_(solid) {
        for (std::size_t i = 0; i < solid.vertices.size(); ++i) {
            corners_.push_back({solid.vertices[i], {static_cast<int>(i)}});
        }
        for (const Facet& facet : solid.facets) outlines_.push_back(facet.corners);
    }

    bool contract_shortest(double tolerance) {
        std::vector<std::tuple<double, int, int>> edges;
        for (const Outline& outline : outlines_) {
            for (std::size_t i = 0; i < outline.size(); ++i) {
                const int a = outline[i], b = outline[(i + 1) % outline.size()];
                const double length = glm::length(corners_[a].position - corners_[b].position);
                if (length <= tolerance && !refused_.contains(std::minmax(a, b))) {
                    edges.emplace_back(length, std::min(a, b), std::max(a, b));
                }
            }
        }
        std::sort(edges.begin(), edges.end());
        for (const auto& [length, a, b] : edges) {
            if (contract(a, b)) return true;
            refused_.insert(std::minmax(a, b));
        }
        return false;
    }

    ContractedSolid result(int contracted_edges) const {
        ContractedSolid out;
        out.contracted_edges = contracted_edges;
        std::vector<int> index(corners_.size(), -1);
        for (std::size_t f = 0; f < outlines_.size(); ++f) {
            if (outlines_[f].empty()) {
                out.vanished.push_back(solid_.facets[f].name);
                continue;
            }
            Facet facet = solid_.facets[f];
            facet.corners.clear();
            for (const int corner : outlines_[f]) {
                if (index[corner] < 0) {
                    index[corner] = static_cast<int>(out.solid.vertices.size());
                    // Facets may have vanished since the corner was made.
                    out.solid.vertices.push_back(corners_[corner].members.size() > 1
                                                     ? meet(corner)
                                                     : corners_[corner].position);
                }
                facet.corners.push_back(index[corner]);
            }
            out.solid.facets.push_back(std::move(facet));
        }
        return out;
    }

private:
    // Merges corner b into corner a unless a facet's outline would then touch itself.
    bool contract(int a, int b) {
        std::vector<Outline> merged = outlines_;
        for (Outline& outline : merged) {
            if (std::find(outline.begin(), outline.end(), b) == outline.end()) continue;
            std::replace(outline.begin(), outline.end(), b, a);
            outline = without_repeats(outline);
            if (outline.size() >= 3 && std::count(outline.begin(), outline.end(), a) > 1) {
                return false;
            }
        }
        outlines_ = std::move(merged);
        std::vector<int>& members = corners_[a].members;
        members.insert(members.end(), corners_[b].members.begin(), corners_[b].members.end());
        drop_vanished();
        corners_[a].position = meet(a);
        return true;
    }

    // A facet with two corners has no area. A corner with two facets lies within their common edge.
    void drop_vanished() {
        for (bool changed = true; changed;) {
            changed = false;
            std::vector<int> facet_count(corners_.size(), 0);
            for (Outline& outline : outlines_) {
                if (outline.size() < 3) outline.clear();
                for (const int corner : outline) ++facet_count[corner];
            }
            for (Outline& outline : outlines_) {
                changed |= std::erase_if(outline, [&](int c) { return facet_count[c] < 3; }) > 0;
            }
        }
    }

    // The least-squares meet of a corner's planes, starting from the mean of its members. Along
    // directions in which nearly parallel planes would move it further than the members are apart,
    // it keeps the mean.
    Vec3 meet(int corner) const {
        const std::vector<int>& members = corners_[corner].members;
        Vec3 mean{0, 0, 0};
        for (const int m : members) {
            mean += (solid_.vertices[m] - solid_.vertices[members.front()]) /
                    static_cast<double>(members.size());
        }
        mean += solid_.vertices[members.front()];
        double spread = 0;
        for (const int m : members) {
            spread = std::max(spread, 2 * glm::length(solid_.vertices[m] - mean));
        }
        std::vector<int> facets;
        for (std::size_t f = 0; f < outlines_.size(); ++f) {
            if (std::find(outlines_[f].begin(), outlines_[f].end(), corner) != outlines_[f].end()) {
                facets.push_back(static_cast<int>(f));
            }
        }
        if (facets.size() < 3) return mean;
        Eigen::MatrixXd normals(facets.size(), 3);
        Eigen::VectorXd misses(facets.size());
        for (std::size_t i = 0; i < facets.size(); ++i) {
            const Plane& plane = solid_.facets[facets[i]].plane;
            normals.row(static_cast<Eigen::Index>(i)) << plane.normal.x, plane.normal.y,
                plane.normal.z;
            misses[static_cast<Eigen::Index>(i)] = -height_above(plane, mean);
        }
        const SingularValues parts = singular_values(normals);
        const Eigen::VectorXd along = parts.u.transpose() * misses;
        Vec3 position = mean;
        for (Eigen::Index k = 0; k < along.size(); ++k) {
            const double step = along[k] / parts.values[k];
            if (!(std::abs(step) <= spread)) continue;
            position += step * Vec3(parts.v(0, k), parts.v(1, k), parts.v(2, k));
        }
        return position;
    }

    const Solid& solid_;
    std::vector<MergedCorner> corners_;
    std::vector<Outline> outlines_;  // empty: the facet has vanished
    std::set<std::pair<int, int>> refused_;
};

}  // namespace

ContractedSolid contract_near_meets(const Solid& solid, double tolerance) {
    Contraction contraction(solid);
    int contracted = 0;
    while (contraction.contract_shortest(tolerance)) ++contracted;
    return contraction.result(contracted);
}

}  // namespace culet
