#pragma once
// Finds the pixels that a beam's region touches, and how much of each it fills.

#include <cstddef>
#include <limits>
#include <vector>

#include "render/beams/pixel_runs.h"
#include "render/beams/screen_view.h"

namespace culet {

/// Pixels of one region, row by row. The arrays keep their memory and have spare room.
struct CoveredPixels {
    PixelRuns runs;
    std::vector<float> x, y;   ///< of the pixel's middle, from the reference point
    std::vector<float> share;  ///< of the pixel's area
    /// On request, the part of each pixel that the region fills. x and y are then the part's
    /// middle, and (u, v) -> (xx u, yx u + yy v) maps a unit square to a parallelogram with the
    /// part's second moments.
    std::vector<float> xx, yx, yy;
    const ScreenPoint* corners = nullptr;  ///< of the region, while their owner keeps them
    std::size_t corner_count = 0;
    ScreenPoint reference{0, 0};
    int count = 0;
    int near_border = 0;  ///< number of values, at the front, whose middles are near the border
};

class PixelCoverage {
public:
    explicit PixelCoverage(int width = 1) : width_(width) {}
    void set_width(int width) { width_ = width; }

    /// Exact areas, to single precision, of a convex, positively oriented region within rows
    /// [row_begin, row_end). Each edge adds what lies to its right, row by row. Empty pixels are
    /// left out; shares that miss 1 by rounding only are 1.
    const CoveredPixels& areas(const ScreenPoint* corners, std::size_t count,
                               const ScreenPoint& reference, int row_begin, int row_end,
                               bool parts = false);
    /// Pixels whose middle is in the region, with share 1. A middle on an edge belongs to the
    /// region on its right or below. Near the border: within `margin` pixels.
    const CoveredPixels& middles(const ScreenPoint* corners, std::size_t count,
                                 const ScreenPoint& reference, int row_begin, int row_end,
                                 double margin = std::numeric_limits<double>::infinity());

    /// An edge from its upper to its lower end, relative to the corner of the region's pixels.
    struct Edge {
        float x_top, y_top, x_end, y_end, slope;
        float sign;  ///< +1: the region lies to the right of the edge
    };

    /// The same in double precision, relative to the picture's corner.
    struct Side {
        double x_top, y_top, y_end, slope;
        double x_per_distance;  ///< x distance over perpendicular distance
        bool right;             ///< the region lies to the left of the side
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
