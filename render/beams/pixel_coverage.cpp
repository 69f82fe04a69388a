#include "render/beams/pixel_coverage.h"

#include <algorithm>
#include <cmath>

#include "render/beams/beam_shading.h"

namespace culet {

namespace {

// What rounding leaves of no area at all, and of a whole pixel.
constexpr float k_nothing = 1e-6f, k_whole = 1 - 4e-6f;

// Of numbers that are not negative.
int floor_of(float v) {
    return static_cast<int>(v);
}
int ceil_of(float v) {
    const int whole = static_cast<int>(v);
    return whole + (static_cast<float>(whole) < v);
}

// Adds, for each pixel of one row, the area to the right of an edge from x to x_next, which spans
// the signed height `d`; as differences from pixel to pixel.
void add_edge(float* row, float x, float x_next, float d) {
    const float low = std::min(x, x_next), high = std::max(x, x_next);
    const int first = floor_of(low), last = ceil_of(high);
    const float low_floor = static_cast<float>(first);
    if (last <= first + 1) {
        const float across = 0.5f * (x + x_next) - low_floor;
        row[first] += d - d * across;
        row[first + 1] += d * across;
        return;
    }
    const float slope = 1 / (high - low), in = low - low_floor,
                out = high - static_cast<float>(last) + 1;
    const float begin = 0.5f * slope * (1 - in) * (1 - in), end = 0.5f * slope * out * out;
    row[first] += d * begin;
    if (last == first + 2) {
        row[first + 1] += d * (1 - begin - end);
    } else {
        const float second = slope * (1.5f - in);
        row[first + 1] += d * (second - begin);
        for (int i = first + 2; i < last - 1; ++i) row[i] += d * slope;
        row[last - 1] += d * (1 - (second + static_cast<float>(last - first - 3) * slope) - end);
    }
    row[last] += d * end;
}

}  // namespace

void PixelCoverage::reserve(std::size_t pixels) {
    pixels += k_shading_room;
    if (found_.pixel.size() >= pixels) return;
    found_.pixel.resize(pixels);
    found_.x.resize(pixels);
    found_.y.resize(pixels);
    found_.share.resize(pixels);
}

AreaGrid PixelCoverage::areas(const ScreenPoint* corners, std::size_t count, int row_begin,
                              int row_end) {
    double x_low = corners[0].x, x_high = x_low, y_low = corners[0].y, y_high = y_low;
    for (std::size_t i = 1; i < count; ++i) {
        x_low = std::min(x_low, corners[i].x);
        x_high = std::max(x_high, corners[i].x);
        y_low = std::min(y_low, corners[i].y);
        y_high = std::max(y_high, corners[i].y);
    }
    const int x0 = std::clamp(static_cast<int>(std::floor(x_low)), 0, width_ - 1),
              x1 = std::clamp(static_cast<int>(std::ceil(x_high)), x0 + 1, width_),
              y0 = std::max(static_cast<int>(std::floor(y_low)), row_begin),
              y1 = std::min(static_cast<int>(std::ceil(y_high)), row_end);
    if (y0 >= y1) return {};
    const std::size_t stride = static_cast<std::size_t>(x1 - x0 + 2);
    sums_.assign(stride * static_cast<std::size_t>(y1 - y0), 0.0f);
    // In the region's own corner, where single precision has digits to spare.
    const auto local = [&](const ScreenPoint& p) {
        return std::pair{
            static_cast<float>(std::clamp(p.x - x0, 0.0, static_cast<double>(x1 - x0))),
            static_cast<float>(p.y - y0)};
    };
    const float height = static_cast<float>(y1 - y0);
    auto [xa, ya] = local(corners[count - 1]);
    for (std::size_t i = 0; i < count; ++i) {
        const auto [xb, yb] = local(corners[i]);
        if (ya != yb) {
            // Positively oriented: edges that run up (in y) have the region on their left.
            const float sign = ya < yb ? -1.0f : 1.0f;
            const float xt = ya < yb ? xa : xb, yt = ya < yb ? ya : yb, xe = ya < yb ? xb : xa,
                        ye = ya < yb ? yb : ya;
            if (ye > 0 && yt < height) {
                const float slope = (xe - xt) / (ye - yt);
                const float widest = static_cast<float>(x1 - x0);
                float y = std::max(yt, 0.0f);
                const int row0 = floor_of(y), row1 = std::min(y1 - y0, ceil_of(ye));
                float x = std::clamp(xt + (y - yt) * slope, 0.0f, widest);
                for (int row = row0; row < row1; ++row) {
                    const float until = std::min(static_cast<float>(row + 1), ye);
                    const float x_next =
                        until == ye ? xe : std::clamp(xt + (until - yt) * slope, 0.0f, widest);
                    add_edge(sums_.data() + static_cast<std::size_t>(row) * stride, x, x_next,
                             sign * (until - y));
                    x = x_next;
                    y = until;
                }
            }
        }
        xa = xb;
        ya = yb;
    }
    for (int row = 0; row < y1 - y0; ++row) {
        float* sums = sums_.data() + static_cast<std::size_t>(row) * stride;
        float area = 0;
        for (int column = 0; column < x1 - x0; ++column) {
            area += sums[column];
            sums[column] = area;
        }
    }
    return {x0, y0, x1 - x0, y1 - y0, sums_.data(), static_cast<int>(stride)};
}

const CoveredPixels& PixelCoverage::touched(const AreaGrid& grid, const ScreenPoint& reference) {
    reserve(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
    int *pixels = found_.pixel.data(), n = 0;
    float *xs = found_.x.data(), *ys = found_.y.data(), *shares = found_.share.data();
    const float x = static_cast<float>(grid.x + 0.5 - reference.x);
    for (int row = 0; row < grid.rows; ++row) {
        float* share = sums_.data() + static_cast<std::ptrdiff_t>(row) * grid.stride;
        for (int column = 0; column < grid.columns; ++column)
            share[column] = share[column] > k_whole ? 1.0f : share[column];
        const int pixel = (grid.y + row) * width_ + grid.x, before = n;
        for (int column = 0; column < grid.columns; ++column) {
            // Written always, kept if there is something.
            pixels[n] = pixel + column;
            xs[n] = x + static_cast<float>(column);
            shares[n] = share[column];
            n += share[column] > k_nothing;
        }
        std::fill(ys + before, ys + n, static_cast<float>(grid.y + row + 0.5 - reference.y));
    }
    found_.count = n;
    return found_;
}

const CoveredPixels& PixelCoverage::middles(const ScreenPoint* corners, std::size_t count,
                                            const ScreenPoint& reference, int row_begin,
                                            int row_end) {
    found_.count = 0;
    double y_low = corners[0].y, y_high = y_low;
    for (std::size_t i = 1; i < count; ++i) {
        y_low = std::min(y_low, corners[i].y);
        y_high = std::max(y_high, corners[i].y);
    }
    const auto first_middle = [](double v) { return static_cast<int>(std::ceil(v - 0.5)); };
    const int y0 = std::max(first_middle(y_low), row_begin),
              y1 = std::min(first_middle(y_high), row_end);
    if (y0 >= y1) return found_;
    left_.assign(static_cast<std::size_t>(y1 - y0), width_);
    right_.assign(static_cast<std::size_t>(y1 - y0), 0.0);
    for (std::size_t i = 0, j = count - 1; i < count; j = i++) {
        const bool down = corners[j].y < corners[i].y;
        const ScreenPoint &top = down ? corners[j] : corners[i],
                          &end = down ? corners[i] : corners[j];
        const int row0 = std::max(first_middle(top.y), y0),
                  row1 = std::min(first_middle(end.y), y1);
        if (row0 >= row1) continue;
        const double slope = (end.x - top.x) / (end.y - top.y);
        for (int row = row0; row < row1; ++row) {
            const double x = top.x + (row + 0.5 - top.y) * slope;
            double& border = (down ? right_ : left_)[static_cast<std::size_t>(row - y0)];
            border = x;
        }
    }
    for (int row = y0; row < y1; ++row) {
        const int x0 = std::max(first_middle(left_[static_cast<std::size_t>(row - y0)]), 0),
                  x1 = std::min(first_middle(right_[static_cast<std::size_t>(row - y0)]), width_);
        if (x0 >= x1) continue;
        reserve(static_cast<std::size_t>(found_.count + x1 - x0));
        const float y = static_cast<float>(row + 0.5 - reference.y);
        for (int x = x0; x < x1; ++x) {
            const std::size_t n = static_cast<std::size_t>(found_.count++);
            found_.pixel[n] = row * width_ + x;
            found_.x[n] = static_cast<float>(x + 0.5 - reference.x);
            found_.y[n] = y;
            found_.share[n] = 1;
        }
    }
    return found_;
}

}  // namespace culet
