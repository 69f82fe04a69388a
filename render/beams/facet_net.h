#pragma once
// The facets of a convex stone with edges and neighbours, for walking from facet to facet.

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// An edge of a facet, counter-clockwise from outside.
struct NetEdge {
    int from = 0, to = 0;  ///< indices of corners
    int beyond = 0;        ///< facet on the other side
    int line = 0;          ///< the same for both facets that share the edge
};

struct NetNeighbour {
    Plane plane;
    int facet = 0;
};

/// Corners are where planes meet; the planes alone are exact. Meets that miss each other slightly
/// stay separate, with short edges between them. Edges shorter than the root of the rounding unit
/// times the diameter are collapsed, since rounding makes their directions meaningless; corners
/// move by at most that length.
class FacetNet {
public:
    /// Throws InputError if the planes bound no solid.
    explicit FacetNet(const Solid& convex);

    /// As many as the solid's. Facets without area have no edges.
    int facets() const { return static_cast<int>(planes_.size()); }
    int lines() const { return lines_; }
    const Plane& plane(int facet) const { return planes_[static_cast<std::size_t>(facet)]; }
    const std::vector<NetEdge>& edges(int facet) const {
        return edges_[static_cast<std::size_t>(facet)];
    }
    /// Per edge, in the same order.
    const std::vector<NetNeighbour>& neighbours(int facet) const {
        return neighbours_[static_cast<std::size_t>(facet)];
    }
    /// The facet through which a ray along `d` from `x` on facet `from` leaves the stone: that with
    /// the largest (n.d)/(c - n.x). Found by walking: a maximum among neighbours is the global one
    /// (a linear-fractional programme).
    int exit_of(int from, const Vec3& x, const Vec3& d) const {
        return walk(exits_[cell_of(from, d)], x, d);
    }
    const std::vector<Vec3>& corners() const { return corners_; }
    /// For a short edge, whose direction may be wrong after corners were merged: a distant point on
    /// the intersection of its planes, on the side of its higher corner.
    const std::optional<Vec3>& far_along(int line) const {
        return far_along_[static_cast<std::size_t>(line)];
    }
    double size() const { return size_; }

private:
    // Cells of directions, by x, y and the sign of z.
    static constexpr int k_cells = 6;
    static std::size_t cell_of(int from, const Vec3& d) {
        const auto step = [](double v) {
            const double cell = (v + 1) * (0.5 * k_cells);
            return cell > 0 ? static_cast<int>(std::min(cell, k_cells - 1.0)) : 0;
        };
        return static_cast<std::size_t>(((2 * from + (d.z < 0)) * k_cells + step(d.y)) * k_cells +
                                        step(d.x));
    }
    int walk(int start, const Vec3& x, const Vec3& d) const;
    void join_edges(const Solid& solid);
    void find_far_points(double too_short);
    void find_exits();

    std::vector<Plane> planes_;
    std::vector<std::vector<NetEdge>> edges_;
    std::vector<std::vector<NetNeighbour>> neighbours_;
    std::vector<std::optional<Vec3>> far_along_;
    std::vector<int> exits_;  // of rays from a facet's middle: where walks begin
    std::vector<Vec3> corners_;
    int lines_ = 0;
    double size_ = 0;
};

}  // namespace culet
