#include "render/beams/screen_region.h"

#include <algorithm>

namespace culet {

double doubled_area(const ScreenPoint* p, std::size_t count) {
    double sum = 0;
    for (std::size_t i = 2; i < count; ++i) {
        sum +=
            (p[i - 1].x - p[0].x) * (p[i].y - p[0].y) - (p[i].x - p[0].x) * (p[i - 1].y - p[0].y);
    }
    return sum;
}

ScreenPoint middle_of(const ScreenPoint* p, std::size_t count) {
    double weight = 0, x = 0, y = 0;
    for (std::size_t i = 2; i < count; ++i) {
        const double ax = p[i - 1].x - p[0].x, ay = p[i - 1].y - p[0].y, bx = p[i].x - p[0].x,
                     by = p[i].y - p[0].y, w = ax * by - bx * ay;
        weight += w;
        x += w * (ax + bx);
        y += w * (ay + by);
    }
    return {p[0].x + x / (3 * weight), p[0].y + y / (3 * weight)};
}

void RegionCutter::take(const ScreenPoint* corners, std::size_t count, std::size_t cuts) {
    if (kept_.size() < count + cuts) {
        kept_.resize(count + cuts);
        cut_.resize(count + cuts);
        sides_.resize(count + cuts);
    }
    count_ = count;
    std::copy_n(corners, count, kept_.data());
}

}  // namespace culet
