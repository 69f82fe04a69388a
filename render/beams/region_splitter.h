#pragma once
// Splits a region by the facets that its rays meet next.

#include <algorithm>
#include <vector>

#include "render/beams/facet_net.h"
#include "render/beams/pencil.h"
#include "render/beams/screen_region.h"

namespace culet {

/// The stone's inside as seen through one beam.
struct InsideView {
    PencilMap map;
    /// The virtual eye times `eye_weight` (0: a direction, opposite to the rays').
    Vec3 eye{0};
    double eye_weight = 0;
    int parity = 1;  ///< -1: the picture is mirrored
};

struct FacetRegion {
    int facet = 0;
    Region region;
    double doubled_area = 0;
};

/// Computes each edge's line once for both its facets, so that parts tile the whole without an
/// epsilon (beam_tree.h).
class RegionSplitter {
public:
    void prepare(const FacetNet& net);

    /// Splits a region of `pool`, whose rays come from facet `from`; appends the parts' corners to
    /// the pool. `start`: a facet close to the one seen at `middle`.
    void split(const InsideView& view, std::vector<ScreenPoint>& pool, const Region& region,
               int from, int start, const ScreenPoint& middle, std::vector<FacetRegion>& parts);

private:
    // Inline, as these run a hundred times per beam.
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
    // The side of the line on which the facet lies: +1 for the line as it is.
    int inside_of(const NetEdge& edge) const {
        return edge.from < edge.to ? view_->parity : -view_->parity;
    }
    // True if the view sees the facet from inside.
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
