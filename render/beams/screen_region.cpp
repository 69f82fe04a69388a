#include "render/beams/screen_region.h"

#include <algorithm>

namespace culet {

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
