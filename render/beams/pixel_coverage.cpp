#include "render/beams/pixel_coverage.h"

#include <algorithm>
#include <cmath>

#include "render/beams/beam_shading.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/beams/pixel_coverage.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h; clang-format must not sort them.
#include "render/beams/vectors-inl.h"

#ifndef CULET_RENDER_BEAMS_PIXEL_COVERAGE
#define CULET_RENDER_BEAMS_PIXEL_COVERAGE
namespace culet {

struct RegionBox {
    int pixel = 0, width = 0;  // index of its first pixel; the picture's width
    int columns = 0, rows = 0;
    float x = 0, y = 0;  // middle of its first pixel, from the reference point
};

struct SpanRows {
    double first = 0, width = 0;
    std::size_t count = 0, stride = 0;
    double inner_low = 0, inner_high = 0;  // y
};

// Numbers stored per edge, or for the region, in each row of a vector.
constexpr std::size_t k_row_numbers = 6;

}  // namespace culet
#endif

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

// Zero area and a whole pixel, up to rounding.
constexpr float k_nothing = 1e-6f, k_whole = 1 - 4e-6f;

// Moments of a pixel's part about the pixel's middle, summed over edges: each adds what lies to its
// right, with its sign.
struct Moments {
    V area, x, y, xx, xy, yy;

    // Adds an edge that starts at its left end at height y0, rises by `rise`, and covers the signed
    // height h. The shares `before` and `until` lie left of the pixel and left of its right side; x
    // is the middle of what lies between. Closed forms of the integrals over y (Green 1828).
    HWY_INLINE void add(const V& h, const V& y0, const V& rise, const V& before, const V& until,
                        const V& middle, const V& reach) {
        const V third = number(1.0f / 3), half = number(0.5f), quarter = number(0.25f);
        // Where the edge lies left of the pixel, it covers the pixel's whole rows.
        const V slab = h * before, ys = hn::MulAdd(half * rise, before, y0),
                up = half * rise * before;
        const V in = h * (until - before), yi = hn::MulAdd(half * rise, before + until, y0),
                k = half * rise * (until - before);
        const V beside = half - middle, square = middle * middle, reach2 = reach * reach;
        const V width = half * (quarter - hn::MulAdd(third, reach2, square)),
                tilt = third * reach * k;
        area = area + hn::MulAdd(in, beside, slab);
        x = hn::MulAdd(in, width, x);
        y = y + hn::MulAdd(in, hn::MulSub(yi, beside, tilt), slab * ys);
        xx = xx +
             third * hn::MulAdd(in, number(0.125f) - middle * (square + reach2), quarter * slab);
        xy = hn::MulAdd(in, hn::NegMulAdd(middle, tilt, yi * width), xy);
        yy = yy + hn::MulAdd(in,
                             hn::NegMulAdd(number(2.0f) * yi, tilt,
                                           hn::MulAdd(third * k, k, yi * yi) * beside),
                             slab * hn::MulAdd(third * up, up, ys * ys));
    }
};

// The part in CoveredPixels' form; the whole pixel where not `cut`.
struct Part {
    V x, y, xx, yx, yy;

    HWY_INLINE Part(const Moments& m, const M& cut) {
        const V zero = number(0.0f), one = number(1.0f), half = number(0.5f), twelve = number(12);
        // For tiny areas rounding dominates; clamp to the pixel.
        const V over = one / hn::Max(m.area, number(1e-12f));
        x = hn::IfThenElseZero(cut, hn::Clamp(m.x * over, hn::Neg(half), half));
        y = hn::IfThenElseZero(cut, hn::Clamp(m.y * over, hn::Neg(half), half));
        const V wide = clamped_to_unit(twelve * hn::NegMulAdd(x, x, m.xx * over)),
                high = clamped_to_unit(twelve * hn::NegMulAdd(y, y, m.yy * over));
        const V along = hn::Sqrt(wide), most = hn::Sqrt(high);
        const V turned =
            hn::Clamp(twelve * hn::NegMulAdd(x, y, m.xy * over) / hn::Max(along, number(1e-12f)),
                      hn::Neg(most), most);
        xx = hn::IfThenElse(cut, along, one);
        yx = hn::IfThenElseZero(cut, turned);
        yy = hn::IfThenElse(cut, hn::Sqrt(hn::Max(hn::NegMulAdd(turned, turned, high), zero)), one);
    }
};

// `numbers` needs room for `edge_count` + 1 blocks of k_row_numbers * lanes.
void FindAreas(const PixelCoverage::Edge* edges, std::size_t edge_count, const RegionBox& box,
               bool parts, float* numbers, CoveredPixels& found) {
    using Edge = PixelCoverage::Edge;
    const std::size_t lanes = hn::Lanes(k_floats), block = k_row_numbers * lanes;
    const V zero = number(0.0f), one = number(1.0f);
    const float widest = static_cast<float>(box.columns);
    float *xs = found.x.data(), *ys = found.y.data(), *shares = found.share.data();
    int n = 0;
    for (int row0 = 0; row0 < box.rows; row0 += static_cast<int>(lanes)) {
        // For each edge and many rows: the range of x that it crosses, and its signed height.
        const V top = hn::Iota(k_floats, static_cast<float>(row0)), end = top + one;
        V left = number(widest), right = zero, full_left = zero, full_right = left, height = zero;
        for (std::size_t e = 0; e < edge_count; ++e) {
            const Edge& edge = edges[e];
            const V x_end = number(edge.x_end), y_end = number(edge.y_end),
                    x_top = number(edge.x_top), y_top = number(edge.y_top);
            const V ya = hn::Max(y_top, top), yb = hn::Min(y_end, end);
            const V over = hn::Max(yb - ya, zero);
            const M active = over > zero;
            const V slope = number(edge.slope);
            const V widest_x = number(widest);
            const V xa = hn::Min(hn::Max(hn::MulAdd(ya - y_top, slope, x_top), zero), widest_x);
            const V xb = hn::IfThenElse(
                yb == y_end, x_end,
                hn::Min(hn::Max(hn::MulAdd(yb - y_top, slope, x_top), zero), widest_x));
            const V low = hn::Min(xa, xb);
            // Give an upright edge the width of rounding.
            const V high =
                hn::Max(hn::Max(xa, xb), hn::MulAdd(low, number(1.2e-7f), low) + number(1e-7f));
            float* of_edge = numbers + e * block;
            hn::StoreU(low, k_floats, of_edge);
            hn::StoreU(one / (high - low), k_floats, of_edge + lanes);
            hn::StoreU(number(0.5f) * (high - low), k_floats, of_edge + 2 * lanes);
            hn::StoreU(number(edge.sign) * over, k_floats, of_edge + 3 * lanes);
            // Relative to the row's middle.
            const V half_row = top + number(0.5f);
            const M falls = xb < xa;
            hn::StoreU(hn::IfThenElse(falls, yb, ya) - half_row, k_floats, of_edge + 4 * lanes);
            hn::StoreU(hn::IfThenElse(falls, hn::Neg(over), over), k_floats, of_edge + 5 * lanes);
            left = hn::Min(left, hn::IfThenElse(active, low, left));
            right = hn::Max(right, hn::IfThenElseZero(active, high));
            if (edge.sign > 0) {
                full_left = hn::Max(full_left, hn::IfThenElseZero(active, high));
                height = height + over;
            } else {
                full_right = hn::Min(full_right, hn::IfThenElse(active, low, full_right));
            }
        }
        float* of_rows = numbers + edge_count * block;
        hn::StoreU(hn::Floor(left), k_floats, of_rows);
        hn::StoreU(hn::Min(hn::Ceil(right), number(widest)), k_floats, of_rows + lanes);
        hn::StoreU(hn::Ceil(full_left), k_floats, of_rows + 2 * lanes);
        hn::StoreU(hn::Floor(full_right), k_floats, of_rows + 3 * lanes);
        hn::StoreU(height, k_floats, of_rows + 4 * lanes);

        const int rows = std::min(static_cast<int>(lanes), box.rows - row0);
        for (int row = 0; row < rows; ++row) {
            const float* of_row = of_rows + row;
            const float first = of_row[0], last = of_row[lanes], full_first = of_row[2 * lanes],
                        full_last = of_row[3 * lanes];
            if (!(first < last)) continue;
            const V y = number(box.y + static_cast<float>(row0 + row));
            const V all = number(of_row[4 * lanes]);
            const float step = static_cast<float>(lanes);
            int at = n;
            for (float x = first; x < last; x += step, at += static_cast<int>(lanes)) {
                const V pixel = hn::Iota(k_floats, x);
                V share = all;
                const bool full = x >= full_first && x + step <= full_last;
                Moments moments{zero, zero, zero, zero, zero, zero};
                if (parts && !(full && of_row[4 * lanes] > k_whole)) {
                    for (std::size_t e = 0; e < edge_count; ++e) {
                        const float* of_edge = numbers + e * block + row;
                        const V in = pixel - number(of_edge[0]), width = number(of_edge[lanes]),
                                half = number(of_edge[2 * lanes]);
                        const V before = clamped_to_unit(in * width),
                                until = clamped_to_unit((in + one) * width);
                        moments.add(number(of_edge[3 * lanes]), number(of_edge[4 * lanes]),
                                    number(of_edge[5 * lanes]), before, until,
                                    hn::MulSub(half, before + until, in + number(0.5f)),
                                    half * (until - before));
                    }
                    share = hn::Max(moments.area, zero);
                } else if (!full) {
                    share = zero;
                    for (std::size_t e = 0; e < edge_count; ++e) {
                        const float* of_edge = numbers + e * block + row;
                        // Shares of the edge left of the pixel and left of its right side.
                        const V in = pixel - number(of_edge[0]);
                        const V over_width = number(of_edge[lanes]);
                        const V before = clamped_to_unit(in * over_width),
                                until = clamped_to_unit((in + one) * over_width);
                        const V beside =
                            hn::NegMulAdd(number(of_edge[2 * lanes]), before + until, in + one);
                        share = hn::MulAdd(number(of_edge[3 * lanes]),
                                           hn::MulAdd(until - before, beside, before), share);
                    }
                    share = hn::Max(share, zero);
                }
                share = hn::IfThenElse(share > number(k_whole), one, share);
                hn::StoreU(share, k_floats, shares + at);
                V middle_x = pixel + number(box.x), middle_y = y;
                if (parts) {
                    const Part part(moments, share < one);
                    middle_x = middle_x + part.x;
                    middle_y = middle_y + part.y;
                    hn::StoreU(part.xx, k_floats, found.xx.data() + at);
                    hn::StoreU(part.yx, k_floats, found.yx.data() + at);
                    hn::StoreU(part.yy, k_floats, found.yy.data() + at);
                }
                hn::StoreU(middle_x, k_floats, xs + at);
                hn::StoreU(middle_y, k_floats, ys + at);
            }
            const int columns = static_cast<int>(last - first);
            int count = columns, skipped = 0;
            while (count > 0 && !(shares[n + count - 1] > k_nothing)) --count;
            while (skipped < count && !(shares[n + skipped] > k_nothing)) ++skipped;
            if (skipped == count) continue;
            found.runs.push_back(
                {box.pixel + (row0 + row) * box.width + static_cast<int>(first) + skipped,
                 n + skipped, count - skipped});
            // Skipped pixels stay in the arrays with share 0.
            for (int i = 0; i < skipped; ++i) shares[n + i] = 0;
            n += count;
        }
    }
    found.count = found.near_border = n;
}

#if HWY_HAVE_FLOAT64
using Doubles = hn::ScalableTag<double>;
using D = hn::Vec<Doubles>;
constexpr Doubles k_doubles;

// For each row the columns whose middles are in the region, and those farther than `margin` from
// its border. `spans` needs room for 4 numbers per row, and one more vector for each of the four.
void FindSpans(const PixelCoverage::Side* sides, std::size_t count, const SpanRows& rows,
               double margin, double* spans) {
    const std::size_t lanes = hn::Lanes(k_doubles);
    const D half = hn::Set(k_doubles, 0.5), zero = hn::Zero(k_doubles),
            width = hn::Set(k_doubles, rows.width), by = hn::Set(k_doubles, margin);
    const auto first_middle = [&](const D& x) HWY_ATTR {
        // Clamp first: a nearly level side leaves the picture by more than the integers can hold
        // through which some processors round.
        return hn::Ceil(hn::Min(hn::Max(x - half, zero), width));
    };
    for (std::size_t row0 = 0; row0 < rows.count; row0 += lanes) {
        const D y = hn::Iota(k_doubles, rows.first + static_cast<double>(row0) + 0.5);
        D left = width, right = zero, inner_left = zero, inner_right = width;
        for (std::size_t i = 0; i < count; ++i) {
            const PixelCoverage::Side& side = sides[i];
            // Computed identically for both regions that share the side.
            const D x = hn::Set(k_doubles, side.x_top) +
                        (y - hn::Set(k_doubles, side.y_top)) * hn::Set(k_doubles, side.slope);
            const D moved = by * hn::Set(k_doubles, side.x_per_distance);
            // Middles level with the upper end belong to the side, those level with the lower end
            // do not.
            const auto here =
                hn::And(y >= hn::Set(k_doubles, side.y_top), y < hn::Set(k_doubles, side.y_end));
            if (side.right) {
                right = hn::IfThenElse(here, x, right);
                inner_right = hn::Min(inner_right, x - moved);
            } else {
                left = hn::IfThenElse(here, x, left);
                inner_left = hn::Max(inner_left, x + moved);
            }
        }
        const D first = first_middle(left), end = hn::Max(first, first_middle(right));
        const auto within = hn::And(y >= hn::Set(k_doubles, rows.inner_low),
                                    y <= hn::Set(k_doubles, rows.inner_high));
        const D inner_first = hn::IfThenElse(
                    within, hn::Min(hn::Max(first_middle(inner_left), first), end), end),
                inner_end = hn::Max(inner_first, hn::Min(first_middle(inner_right), end));
        double* to = spans + row0;
        hn::StoreU(first, k_doubles, to);
        hn::StoreU(inner_first, k_doubles, to + rows.stride);
        hn::StoreU(inner_end, k_doubles, to + 2 * rows.stride);
        hn::StoreU(end, k_doubles, to + 3 * rows.stride);
    }
}
#else
// Without vectors of doubles (WebAssembly in Highway 1.0): the same formulas row by row.
void FindSpans(const PixelCoverage::Side* sides, std::size_t count, const SpanRows& rows,
               double margin, double* spans) {
    const double width = rows.width;
    const auto first_middle = [&](double x) {
        return std::ceil(std::min(std::max(x - 0.5, 0.0), width));
    };
    for (std::size_t row = 0; row < rows.count; ++row) {
        const double y = rows.first + static_cast<double>(row) + 0.5;
        double left = width, right = 0, inner_left = 0, inner_right = width;
        for (std::size_t i = 0; i < count; ++i) {
            const PixelCoverage::Side& side = sides[i];
            const double x = side.x_top + (y - side.y_top) * side.slope;
            const double moved = margin * side.x_per_distance;
            const bool here = y >= side.y_top && y < side.y_end;
            if (side.right) {
                if (here) right = x;
                inner_right = std::min(inner_right, x - moved);
            } else {
                if (here) left = x;
                inner_left = std::max(inner_left, x + moved);
            }
        }
        const double first = first_middle(left), end = std::max(first, first_middle(right));
        const bool within = y >= rows.inner_low && y <= rows.inner_high;
        const double inner_first =
            within ? std::min(std::max(first_middle(inner_left), first), end) : end;
        double* to = spans + row;
        to[0] = first;
        to[rows.stride] = inner_first;
        to[2 * rows.stride] = std::max(inner_first, std::min(first_middle(inner_right), end));
        to[3 * rows.stride] = end;
    }
}
#endif

// Fills in positions and shares of whole pixels.
void FillRuns(const RegionBox& box, CoveredPixels& found) {
    const int lanes = static_cast<int>(hn::Lanes(k_floats));
    const V one = number(1.0f);
    for (const PixelRun& run : found.runs) {
        const int in_box = run.pixel - box.pixel, row = in_box / box.width,
                  column = in_box - row * box.width;
        const V y = number(box.y + static_cast<float>(row));
        float *xs = found.x.data() + run.first, *ys = found.y.data() + run.first,
              *shares = found.share.data() + run.first;
        for (int i = 0; i < run.count; i += lanes) {
            hn::StoreU(hn::Iota(k_floats, static_cast<float>(column + i)) + number(box.x), k_floats,
                       xs + i);
            hn::StoreU(y, k_floats, ys + i);
            hn::StoreU(one, k_floats, shares + i);
        }
    }
}

std::size_t LanesHere() {
    return hn::Lanes(k_floats);
}

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace culet {

HWY_EXPORT(FindAreas);
HWY_EXPORT(FindSpans);
HWY_EXPORT(FillRuns);
HWY_EXPORT(LanesHere);

void PixelCoverage::reserve(std::size_t pixels) {
    pixels += k_shading_room;
    if (found_.x.size() >= pixels) return;
    found_.x.resize(pixels);
    found_.y.resize(pixels);
    found_.share.resize(pixels);
    found_.xx.resize(pixels);
    found_.yx.resize(pixels);
    found_.yy.resize(pixels);
}

const CoveredPixels& PixelCoverage::areas(const ScreenPoint* corners, std::size_t count,
                                          const ScreenPoint& reference, int row_begin, int row_end,
                                          bool parts) {
    found_.count = 0;
    found_.runs.clear();
    found_.corners = corners;
    found_.corner_count = count;
    found_.reference = reference;
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
    if (y0 >= y1) return found_;
    // Relative to the region's own corner, so that single precision suffices.
    const auto local = [&](const ScreenPoint& p) {
        return std::pair{
            static_cast<float>(std::clamp(p.x - x0, 0.0, static_cast<double>(x1 - x0))),
            static_cast<float>(p.y - y0)};
    };
    edges_.clear();
    auto [xa, ya] = local(corners[count - 1]);
    for (std::size_t i = 0; i < count; ++i) {
        const auto [xb, yb] = local(corners[i]);
        // Positively oriented: edges that run upwards in y have the region on their left.
        if (ya < yb) edges_.push_back({xa, ya, xb, yb, (xb - xa) / (yb - ya), -1.0f});
        if (ya > yb) edges_.push_back({xb, yb, xa, ya, (xa - xb) / (ya - yb), 1.0f});
        xa = xb;
        ya = yb;
    }
    const std::size_t room =
        (edges_.size() + 1) * k_row_numbers * HWY_DYNAMIC_DISPATCH(LanesHere)();
    if (crossings_.size() < room) crossings_.resize(room);
    reserve(static_cast<std::size_t>(x1 - x0) * static_cast<std::size_t>(y1 - y0));
    HWY_DYNAMIC_DISPATCH(FindAreas)
    (edges_.data(), edges_.size(),
     {y0 * width_ + x0, width_, x1 - x0, y1 - y0, static_cast<float>(x0 + 0.5 - reference.x),
      static_cast<float>(y0 + 0.5 - reference.y)},
     parts, crossings_.data(), found_);
    return found_;
}

const CoveredPixels& PixelCoverage::middles(const ScreenPoint* corners, std::size_t count,
                                            const ScreenPoint& reference, int row_begin,
                                            int row_end, double margin) {
    found_.count = found_.near_border = 0;
    found_.runs.clear();
    double y_low = corners[0].y, y_high = y_low;
    for (std::size_t i = 1; i < count; ++i) {
        y_low = std::min(y_low, corners[i].y);
        y_high = std::max(y_high, corners[i].y);
    }
    // The least integer not below v - 1/2; pictures have no rows before -1.
    const auto first_middle = [](double v) {
        const int whole = static_cast<int>(v - 0.5);
        return whole + (whole < v - 0.5);
    };
    const int y0 = std::max(first_middle(y_low), row_begin),
              y1 = std::min(first_middle(y_high), row_end);
    if (y0 >= y1) return found_;
    sides_.clear();
    for (std::size_t i = 0, j = count - 1; i < count; j = i++) {
        const bool down = corners[j].y < corners[i].y;
        const ScreenPoint &top = down ? corners[j] : corners[i],
                          &end = down ? corners[i] : corners[j];
        if (!(top.y < end.y)) continue;
        const double slope = (end.x - top.x) / (end.y - top.y);
        sides_.push_back({top.x, top.y, end.y, slope, std::sqrt(1 + slope * slope), down});
    }
    const std::size_t rows = static_cast<std::size_t>(y1 - y0);
    const std::size_t stride = rows + k_shading_room;
    if (spans_.size() < 4 * stride) spans_.resize(4 * stride);
    const double* spans = spans_.data();
    HWY_DYNAMIC_DISPATCH(FindSpans)
    (sides_.data(), sides_.size(),
     {static_cast<double>(y0), static_cast<double>(width_), rows, stride, y_low + margin,
      y_high - margin},
     margin, spans_.data());
    // Pixels near the border come first.
    const auto add = [&](std::size_t row, double from, double until) {
        if (!(from < until)) return;
        const int columns = static_cast<int>(until - from);
        found_.runs.push_back({(y0 + static_cast<int>(row)) * width_ + static_cast<int>(from),
                               found_.count, columns});
        found_.count += columns;
    };
    for (std::size_t row = 0; row < rows; ++row) {
        add(row, spans[row], spans[stride + row]);
        add(row, spans[2 * stride + row], spans[3 * stride + row]);
    }
    found_.near_border = found_.count;
    for (std::size_t row = 0; row < rows; ++row)
        add(row, spans[stride + row], spans[2 * stride + row]);
    if (found_.count == 0) return found_;
    reserve(static_cast<std::size_t>(found_.count));
    HWY_DYNAMIC_DISPATCH(FillRuns)
    ({y0 * width_, width_, width_, y1 - y0, static_cast<float>(0.5 - reference.x),
      static_cast<float>(y0 + 0.5 - reference.y)},
     found_);
    return found_;
}

}  // namespace culet
#endif
