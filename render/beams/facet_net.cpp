#include "render/beams/facet_net.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "stone/text/errors.h"

namespace culet {

FacetNet::FacetNet(const Solid& convex) : size_(diameter(convex)) {
    std::vector<NamedPlane> planes;
    for (std::size_t i = 0; i < convex.facets.size(); ++i) {
        planes_.push_back(convex.facets[i].plane);
        planes.push_back({std::to_string(i), planes_.back()});
    }
    const HalfSpaceSolid bounded = intersect_half_spaces(planes);
    if (!bounded.bounded || bounded.empty)
        throw InputError("the facets' planes bound no solid; culet info says what is wrong");
    const double too_short = std::sqrt(std::numeric_limits<double>::epsilon()) * size_;
    const Solid solid = contract_near_meets(bounded.solid, too_short).solid;
    corners_ = solid.vertices;
    join_edges(solid);
    find_far_points(too_short);
    for (const std::vector<NetEdge>& edges : edges_) {
        std::vector<NetNeighbour>& beyond = neighbours_.emplace_back();
        for (const NetEdge& edge : edges) beyond.push_back({plane(edge.beyond), edge.beyond});
    }
    find_exits();
}

void FacetNet::join_edges(const Solid& solid) {
    edges_.resize(planes_.size());
    std::map<std::pair<int, int>, int> facet_at;
    for (const Facet& facet : solid.facets) {
        const int number = std::stoi(facet.name);
        for (std::size_t i = 0; i < facet.corners.size(); ++i) {
            const int from = facet.corners[i], to = facet.corners[(i + 1) % facet.corners.size()];
            facet_at[{from, to}] = number;
            edges_[static_cast<std::size_t>(number)].push_back({from, to, -1, -1});
        }
    }
    std::map<std::pair<int, int>, int> line_of;
    for (std::vector<NetEdge>& edges : edges_) {
        for (NetEdge& edge : edges) {
            const auto other = facet_at.find({edge.to, edge.from});
            check(other != facet_at.end(), "every edge of a closed solid has two facets");
            edge.beyond = other->second;
            const auto [line, fresh] = line_of.try_emplace(std::minmax(edge.from, edge.to), lines_);
            lines_ += fresh;
            edge.line = line->second;
        }
    }
}

void FacetNet::find_far_points(double too_short) {
    far_along_.resize(static_cast<std::size_t>(lines_));
    for (int f = 0; f < facets(); ++f) {
        for (const NetEdge& edge : edges(f)) {
            if (edge.from > edge.to) continue;
            const Vec3& low = corners_[static_cast<std::size_t>(edge.from)];
            const double length = glm::distance(low, corners_[static_cast<std::size_t>(edge.to)]);
            // Seen from outside, a facet's edges run along its normal x the neighbour's normal.
            const Vec3 along = glm::cross(plane(f).normal, plane(edge.beyond).normal);
            const double across = glm::length(along);
            const double turned_by_corners = too_short / length,
                         turned_by_planes = std::numeric_limits<double>::epsilon() / across;
            if (length * length < too_short * size_ && turned_by_planes < turned_by_corners) {
                far_along_[static_cast<std::size_t>(edge.line)] = low + (size_ / across) * along;
            }
        }
    }
}

void FacetNet::find_exits() {
    exits_.assign(cell_of(facets(), {-1, -1, 1}), 0);
    for (int from = 0; from < facets(); ++from) {
        if (edges(from).empty()) continue;
        Vec3 middle(0);
        for (const NetEdge& edge : edges(from))
            middle += corners_[static_cast<std::size_t>(edge.from)] /
                      static_cast<double>(edges(from).size());
        for (int cell = 0; cell < 2 * k_cells * k_cells; ++cell) {
            const double x = (cell % k_cells + 0.5) * 2 / k_cells - 1,
                         y = (cell / k_cells % k_cells + 0.5) * 2 / k_cells - 1,
                         z = std::sqrt(std::max(0.0, 1 - x * x - y * y));
            const Vec3 d(x, y, cell < k_cells * k_cells ? z : -z);
            exits_[static_cast<std::size_t>(2 * k_cells * k_cells * from + cell)] =
                walk(edges(from).front().beyond, middle, d);
        }
    }
}

int FacetNet::walk(int start, const Vec3& x, const Vec3& d) const {
    int best = start;
    const auto below = [&](const Plane& plane) {
        return std::max(0.0, plane.offset - glm::dot(plane.normal, x));
    };
    double top = glm::dot(plane(best).normal, d), bottom = below(plane(best));
    for (int step = 0; step < facets(); ++step) {
        int better = -1;
        for (const NetNeighbour& next : neighbours(best)) {
            const double t = glm::dot(next.plane.normal, d);
            if (t <= 0 && top > 0) continue;
            const double b = below(next.plane);
            if (t * bottom > top * b) {
                better = next.facet;
                top = t;
                bottom = b;
            }
        }
        if (better < 0) break;
        best = better;
    }
    return best;
}

}  // namespace culet
