#include "render/beams/region_splitter.h"

#include <algorithm>
#include <cmath>

namespace culet {

void RegionSplitter::prepare(const FacetNet& net) {
    net_ = &net;
    if (stamp_of_corner_.size() != net.corners().size() ||
        stamp_of_line_.size() != static_cast<std::size_t>(net.lines()) ||
        seen_.size() != static_cast<std::size_t>(net.facets())) {
        images_.resize(net.corners().size());
        lines_.resize(static_cast<std::size_t>(net.lines()));
        stamp_of_corner_.assign(net.corners().size(), 0);
        stamp_of_line_.assign(lines_.size(), 0);
        seen_.assign(static_cast<std::size_t>(net.facets()), 0);
        stamp_ = 0;
    }
}

// The edge across which the point lies; null if it is on the facet.
const NetEdge* RegionSplitter::way_to(int facet, const ScreenPoint& point) {
    for (const NetEdge& edge : net_->edges(facet)) {
        const Vec3& l = line(edge);
        if (inside_of(edge) * (l.x * point.x + l.y * point.y + l.z) < 0 && leads_out(edge.beyond))
            return &edge;
    }
    return nullptr;
}

// The facet whose image contains the point. Walks over edges from `start`; if that fails, as it may
// from a facet seen from outside, tries all facets.
int RegionSplitter::facet_around(int start, const ScreenPoint& point) {
    int facet = start;
    for (int step = 0; step < net_->facets() && leads_out(facet); ++step) {
        const NetEdge* edge = way_to(facet, point);
        if (edge == nullptr) return facet;
        facet = edge->beyond;
    }
    for (int f = 0; f < net_->facets(); ++f) {
        if (!net_->edges(f).empty() && leads_out(f) && way_to(f, point) == nullptr) return f;
    }
    return start;
}

void RegionSplitter::clip(std::vector<ScreenPoint>& pool, const Region& region, int from, int facet,
                          std::vector<FacetRegion>& parts) {
    const std::vector<NetEdge>& edges = net_->edges(facet);
    cutter_.take(pool.data() + region.first, region.count, edges.size());
    for (const NetEdge& edge : edges) {
        // Rays that left a facet crossed its edges on the correct side.
        if (edge.beyond == from) continue;
        const auto [lowest, highest] =
            cutter_.measure(static_cast<double>(inside_of(edge)) * line(edge));
        // Beyond the outline of the facets seen from inside there is no other facet.
        if (!(lowest < 0) || !leads_out(edge.beyond)) continue;
        unsigned& seen = seen_[static_cast<std::size_t>(edge.beyond)];
        if (seen != stamp_) {
            seen = stamp_;
            open_.push_back(edge.beyond);
        }
        if (!(highest > 0)) return;
        cutter_.cut();
    }
    const double area = doubled_area(cutter_.corners(), cutter_.count());
    if (!(area > 0)) return;
    parts.push_back({facet, {pool.size(), cutter_.count()}, area});
    pool.insert(pool.end(), cutter_.corners(), cutter_.corners() + cutter_.count());
}

void RegionSplitter::split(const InsideView& view, std::vector<ScreenPoint>& pool,
                           const Region& region, int from, int start, const ScreenPoint& middle,
                           std::vector<FacetRegion>& parts) {
    view_ = &view;
    if (++stamp_ == 0) {
        std::fill(stamp_of_corner_.begin(), stamp_of_corner_.end(), 0u);
        std::fill(stamp_of_line_.begin(), stamp_of_line_.end(), 0u);
        std::fill(seen_.begin(), seen_.end(), 0u);
        stamp_ = 1;
    }
    const std::size_t parts_before = parts.size(), pool_before = pool.size();
    tile(pool, region, from, start, middle, parts);
    // Beyond the outline of the facets seen from inside, facets that are not neighbours may
    // overlap. If the parts' areas do not sum to the region's up to rounding, cut the region along
    // the outline first.
    const double whole = doubled_area(pool.data() + region.first, region.count);
    double sum = 0;
    for (std::size_t i = parts_before; i < parts.size(); ++i) sum += parts[i].doubled_area;
    if (std::abs(sum - whole) <= 1e-10 * whole + 1e-13) return;
    parts.resize(parts_before);
    pool.resize(pool_before);
    const Region within = cut_off_outline(pool, region, parts);
    if (within.count == 0) return;
    const ScreenPoint inner = middle_of(pool.data() + within.first, within.count);
    std::fill(seen_.begin(), seen_.end(), 0u);
    tile(pool, within, from, start, inner, parts);
}

void RegionSplitter::tile(std::vector<ScreenPoint>& pool, const Region& region, int from, int start,
                          const ScreenPoint& middle, std::vector<FacetRegion>& parts) {
    open_.assign(1, facet_around(start, middle));
    seen_[static_cast<std::size_t>(open_.front())] = stamp_;
    while (!open_.empty()) {
        const int facet = open_.back();
        open_.pop_back();
        clip(pool, region, from, facet, parts);
    }
}

// Assigns what lies beyond each edge of the outline to the facet within it; returns the rest.
Region RegionSplitter::cut_off_outline(std::vector<ScreenPoint>& pool, const Region& region,
                                       std::vector<FacetRegion>& parts) {
    Region left = region;
    for (int facet = 0; facet < net_->facets(); ++facet) {
        if (net_->edges(facet).empty() || !leads_out(facet)) continue;
        for (const NetEdge& edge : net_->edges(facet)) {
            if (leads_out(edge.beyond)) continue;
            const Vec3 inwards = static_cast<double>(inside_of(edge)) * line(edge);
            cutter_.take(pool.data() + left.first, left.count, 1);
            const auto [lowest, highest] = cutter_.measure(inwards);
            if (!(lowest < 0)) continue;
            Region within{pool.size(), 0};
            if (highest > 0) {
                cutter_.cut();
                within.count = cutter_.count();
                pool.insert(pool.end(), cutter_.corners(), cutter_.corners() + cutter_.count());
            }
            cutter_.take(pool.data() + left.first, left.count, 1);
            cutter_.measure(-1.0 * inwards);
            if (highest > 0) cutter_.cut();
            const double area = doubled_area(cutter_.corners(), cutter_.count());
            if (area > 0) {
                parts.push_back({facet, {pool.size(), cutter_.count()}, area});
                pool.insert(pool.end(), cutter_.corners(), cutter_.corners() + cutter_.count());
            }
            left = within;
            if (left.count < 3 || !(doubled_area(pool.data() + left.first, left.count) > 0))
                return {};
        }
    }
    return left;
}

}  // namespace culet
