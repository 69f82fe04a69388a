#pragma once
// Which pixels a beam's region touches, and how much of each it fills.

#include <cstddef>
#include <vector>

#include "render/beams/screen_view.h"

namespace culet {

/// Pixels of one region, row by row. The arrays keep their room and have some to spare.
struct CoveredPixels {
    std::vector<int> pixel;    ///< y * width + x
    std::vector<float> x, y;   ///< of the pixel's middle, from the point of reference
    std::vector<float> share;  ///< of the pixel's area
    int count = 0;
};

/// How much a region fills of each pixel of a rectangle.
struct AreaGrid {
    int x = 0, y = 0, columns = 0, rows = 0;
    const float* shares = nullptr;  ///< row by row
    int stride = 0;
    const float* row(int i) const { return shares + static_cast<std::ptrdiff_t>(i) * stride; }
};

class PixelCoverage {
public:
    explicit PixelCoverage(int width = 1) : width_(width) {}
    void set_width(int width) { width_ = width; }

    /// Exact areas, to single precision, of a convex, positively oriented region within rows
    /// [row_begin, row_end): every edge adds what lies to the right of it, row by row.
    AreaGrid areas(const ScreenPoint* corners, std::size_t count, int row_begin, int row_end);
    /// The pixels of which the grid's region, found last, fills anything; 1 where only rounding is
    /// missing.
    const CoveredPixels& touched(const AreaGrid& grid, const ScreenPoint& reference);
    /// Pixels whose middle is in the region, each with share 1. A middle on an edge belongs to the
    /// region on its right, or below.
    const CoveredPixels& middles(const ScreenPoint* corners, std::size_t count,
                                 const ScreenPoint& reference, int row_begin, int row_end);

private:
    void reserve(std::size_t pixels);
    int width_;
    std::vector<float> sums_;
    std::vector<double> left_, right_;
    CoveredPixels found_;
};

}  // namespace culet
