#pragma once
// Which facets the rays of a region meet next, and where each does.

#include <algorithm>
#include <vector>

#include "render/beams/facet_net.h"
#include "render/beams/pencil.h"
#include "render/beams/screen_region.h"

namespace culet {

/// What the eye sees of the stone's inside through one beam.
struct InsideView {
    PencilMap map;
    /// The virtual eye, as a point times `eye_weight` (0: a direction away from the rays').
    Vec3 eye{0};
    double eye_weight = 0;
    int parity = 1;  ///< -1 where the picture is mirrored
};

struct FacetRegion {
    int facet = 0;
    Region region;
    double doubled_area = 0;
};

/// An edge's line is computed once, from its lower corner to its higher one, and taken with either
/// sign by the two facets that share it, so that parts tile the whole without an epsilon.
class RegionSplitter {
public:
    void prepare(const FacetNet& net);

    /// Splits a region of `pool`, of a beam that was at facet `from`; the parts' corners are
    /// appended to the pool. `start`: a facet next to that which `middle` sees.
    void split(const InsideView& view, std::vector<ScreenPoint>& pool, const Region& region,
               int from, int start, const ScreenPoint& middle, std::vector<FacetRegion>& parts);

private:
    // Kept here, where they can be compiled into their callers: they are asked a hundred times a
    // beam.
    const ScreenImage& image(int corner) {
        const std::size_t i = static_cast<std::size_t>(corner);
        if (stamp_of_corner_[i] != stamp_) {
            stamp_of_corner_[i] = stamp_;
            images_[i] = view_->map.of(net_->corners()[i]);
        }
        return images_[i];
    }
    const Vec3& line(const NetEdge& edge) {
        const std::size_t i = static_cast<std::size_t>(edge.line);
        if (stamp_of_line_[i] != stamp_) {
            stamp_of_line_[i] = stamp_;
            const int low = std::min(edge.from, edge.to), high = std::max(edge.from, edge.to);
            const std::optional<Vec3>& far = net_->far_along(edge.line);
            lines_[i] = glm::cross(image(low), far ? view_->map.of(*far) : image(high));
        }
        return lines_[i];
    }
    // Of the line's two sides, the one that the facet is on: +1 for the line as it is.
    int inside_of(const NetEdge& edge) const {
        return edge.from < edge.to ? view_->parity : -view_->parity;
    }
    // True when the view sees the facet from within.
    bool leads_out(int facet) const {
        const Plane& plane = net_->plane(facet);
        return glm::dot(plane.normal, view_->eye) - view_->eye_weight * plane.offset < 0;
    }
    const NetEdge* way_to(int facet, const ScreenPoint& point);
    int facet_around(int start, const ScreenPoint& point);
    void tile(std::vector<ScreenPoint>& pool, const Region& region, int from, int start,
              const ScreenPoint& middle, std::vector<FacetRegion>& parts);
    Region cut_off_outline(std::vector<ScreenPoint>& pool, const Region& region,
                           std::vector<FacetRegion>& parts);
    void clip(std::vector<ScreenPoint>& pool, const Region& region, int from, int facet,
              std::vector<FacetRegion>& parts);

    const FacetNet* net_ = nullptr;
    const InsideView* view_ = nullptr;
    RegionCutter cutter_;
    std::vector<int> open_;
    std::vector<ScreenImage> images_;
    std::vector<Vec3> lines_;
    std::vector<unsigned> stamp_of_corner_, stamp_of_line_, seen_;
    unsigned stamp_ = 0;
};

}  // namespace culet
