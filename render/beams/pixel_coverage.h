#pragma once
// Which pixels a beam's region touches, and how much of each it fills.

#include <cstddef>
#include <limits>
#include <vector>

#include "render/beams/pixel_runs.h"
#include "render/beams/screen_view.h"

namespace culet {

/// Pixels of one region, row by row. The arrays keep their room and have some to spare.
struct CoveredPixels {
    PixelRuns runs;
    std::vector<float> x, y;   ///< of the pixel's middle, from the point of reference
    std::vector<float> share;  ///< of the pixel's area
    /// Where wanted, the part of each pixel that the region fills: x and y are of the part's middle
    /// then, and (u, v) -> (xx u, yx u + yy v) makes a square of side 1 as wide as the part, in
    /// that its second moments are the part's.
    std::vector<float> xx, yx, yy;
    const ScreenPoint* corners = nullptr;  ///< the region's, as long as its owner keeps them
    std::size_t corner_count = 0;
    ScreenPoint reference{0, 0};
    int count = 0;
    int near_border = 0;  ///< so many values, the first ones, are of middles near the border
};

class PixelCoverage {
public:
    explicit PixelCoverage(int width = 1) : width_(width) {}
    void set_width(int width) { width_ = width; }

    /// Exact areas, to single precision, of a convex, positively oriented region within rows
    /// [row_begin, row_end): every edge adds what lies to the right of it, row by row. Pixels of
    /// which it fills nothing are left out; a share is 1 where only rounding is missing.
    const CoveredPixels& areas(const ScreenPoint* corners, std::size_t count,
                               const ScreenPoint& reference, int row_begin, int row_end,
                               bool parts = false);
    /// Pixels whose middle is in the region, each with share 1. A middle on an edge belongs to the
    /// region on its right, or below. Near the border: within `margin` pixels.
    const CoveredPixels& middles(const ScreenPoint* corners, std::size_t count,
                                 const ScreenPoint& reference, int row_begin, int row_end,
                                 double margin = std::numeric_limits<double>::infinity());

    /// An edge from its upper end to its lower one, from the corner of the region's pixels.
    struct Edge {
        float x_top, y_top, x_end, y_end, slope;
        float sign;  ///< +1: the region lies to the right of it
    };

    /// The same in double precision, from the picture's corner.
    struct Side {
        double x_top, y_top, y_end, slope;
        double stretch;  ///< along x, of a distance from the side
        bool right;      ///< the region lies to the left of it
    };

private:
    void reserve(std::size_t pixels);
    int width_;
    std::vector<Edge> edges_;
    std::vector<float> crossings_;
    std::vector<Side> sides_;
    std::vector<double> spans_;
    CoveredPixels found_;
};

}  // namespace culet
