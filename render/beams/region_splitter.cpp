#include "render/beams/region_splitter.h"

#include <algorithm>

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
    // The same start for all that is split, whichever thread does it: ties must not depend on it.
    guess_.assign(static_cast<std::size_t>(net.facets()), -1);
}

int RegionSplitter::exit_of(int from, const Vec3& x, const Vec3& d) {
    int best = guess_[static_cast<std::size_t>(from)];
    if (best < 0) best = net_->edges(from).front().beyond;
    const auto towards = [&](int f) { return glm::dot(net_->plane(f).normal, d); };
    const auto below = [&](int f) {
        const Plane& plane = net_->plane(f);
        return std::max(0.0, plane.offset - glm::dot(plane.normal, x));
    };
    double top = towards(best), bottom = below(best);
    for (int step = 0; step < net_->facets(); ++step) {
        int better = -1;
        for (const NetEdge& edge : net_->edges(best)) {
            const double t = towards(edge.beyond), b = below(edge.beyond);
            if (t * bottom > top * b) {
                better = edge.beyond;
                top = t;
                bottom = b;
            }
        }
        if (better < 0) break;
        best = better;
    }
    guess_[static_cast<std::size_t>(from)] = best;
    return best;
}

const ScreenImage& RegionSplitter::image(int corner) {
    const std::size_t i = static_cast<std::size_t>(corner);
    if (stamp_of_corner_[i] != stamp_) {
        stamp_of_corner_[i] = stamp_;
        images_[i] = view_->map.of(net_->corners()[i]);
    }
    return images_[i];
}

const Vec3& RegionSplitter::line(const NetEdge& edge) {
    const std::size_t i = static_cast<std::size_t>(edge.line);
    if (stamp_of_line_[i] != stamp_) {
        stamp_of_line_[i] = stamp_;
        const int low = std::min(edge.from, edge.to), high = std::max(edge.from, edge.to);
        lines_[i] = glm::cross(image(low), image(high));
    }
    return lines_[i];
}

bool RegionSplitter::leads_out(int facet) const {
    const Plane& plane = net_->plane(facet);
    return glm::dot(plane.normal, view_->eye) - view_->eye_weight * plane.offset < 0;
}

// The facet in whose image the point lies, by walking over edges from `facet`.
int RegionSplitter::facet_around(int facet, const ScreenPoint& point) {
    for (int step = 0; step < 2 * net_->facets(); ++step) {
        const auto& edges = net_->edges(facet);
        const auto out = std::find_if(edges.begin(), edges.end(), [&](const NetEdge& edge) {
            const Vec3& l = line(edge);
            return inside_of(edge) * (l.x * point.x + l.y * point.y + l.z) < 0 &&
                   leads_out(edge.beyond);
        });
        if (out == edges.end()) break;
        facet = out->beyond;
    }
    return facet;
}

void RegionSplitter::clip(std::vector<ScreenPoint>& pool, const Region& region, int from, int facet,
                          std::vector<FacetRegion>& parts) {
    const std::vector<NetEdge>& edges = net_->edges(facet);
    cutter_.take(pool.data() + region.first, region.count, edges.size());
    for (const NetEdge& edge : edges) {
        // Where a ray left a facet it crossed that facet's edges on the right side.
        if (edge.beyond == from) continue;
        const auto [lowest, highest] =
            cutter_.measure(static_cast<double>(inside_of(edge)) * line(edge));
        // Beyond the outline of what the eye sees from within there is no other facet.
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
    open_.assign(1, facet_around(start, middle));
    seen_[static_cast<std::size_t>(open_.front())] = stamp_;
    while (!open_.empty()) {
        const int facet = open_.back();
        open_.pop_back();
        clip(pool, region, from, facet, parts);
    }
}

}  // namespace culet
