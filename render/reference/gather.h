#pragma once
// Sums over the light paths of one ray.

#include <algorithm>
#include <numeric>

#include "render/optics/path.h"
#include "render/reference/surroundings.h"
#include "render/scene/scene.h"

namespace culet {

/// Weights of one eye ray that bring no light, summed over the band's nodes.
class UnseenWeights {
public:
    explicit UnseenWeights(int count) : count_(count) {}
    void remainder(const NodeWeights& weight) { remainder_ += sum(weight); }
    void absorbed(const NodeWeights& weight) { absorbed_ += sum(weight); }
    void cut(const NodeWeights& weight) { cut_ += sum(weight); }

    double remainder_ = 0, absorbed_ = 0, cut_ = 0;
    int deepest_ = 0;

protected:
    void seen(const PathTrace& trace) { deepest_ = std::max(deepest_, trace.length); }

private:
    double sum(const NodeWeights& weight) const {
        return std::accumulate(weight.begin(), weight.begin() + count_, 0.0);
    }
    int count_;
};

/// Adds the radiance of one ray's exits, at the nodes of its band; `single`: the band has only one.
template <bool single>
class Gather : public UnseenWeights {
public:
    Gather(const Surroundings& surroundings, const Band& band, double* radiance)
        : UnseenWeights(band.count),
          surroundings_(surroundings),
          band_(band),
          radiance_(radiance) {}

    void path_exits(const Vec3& at, const Vec3& direction, const NodeWeights& weight,
                    const PathTrace& trace) {
        seen(trace);
        const int count = single ? 1 : band_.count;
        if constexpr (single) {
            surroundings_.add_radiance(at, direction, weight[0], band_.first, 1,
                                       radiance_ + band_.first);
            return;
        }
        NodeWeights radiance;
        std::fill_n(radiance.begin(), count, 0.0);
        const double most = *std::max_element(weight.begin(), weight.begin() + count);
        if (!(most > 0)) return;  // fully absorbed at every node
        surroundings_.add_radiance(at, direction, most, band_.first, count, radiance.data());
        for (int i = 0; i < count; ++i)
            radiance_[band_.first + i] += weight[i] / most * radiance[i];
    }

private:
    const Surroundings& surroundings_;
    const Band& band_;
    double* radiance_;
};

}  // namespace culet
