#pragma once
// Sums over the light paths of one ray.

#include <algorithm>
#include <numeric>
#include <vector>

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

/// The same for all four Stokes parameters (`planes` 4) or the first, with random choices.
class GatherStokes : public UnseenWeights {
public:
    GatherStokes(const Surroundings& surroundings, const Band& band,
                 const std::vector<double>& luminance, const std::vector<double>& usual, int nodes,
                 int planes, double* stokes)
        : UnseenWeights(band.count),
          surroundings_(surroundings),
          band_(band),
          luminance_(luminance),
          usual_(usual),
          nodes_(nodes),
          planes_(planes),
          stokes_(stokes) {}

    void path_exits(const PathEnd& end, const PathTrace& trace) {
        seen(trace);
        if (planes_ == 4) {
            surroundings_.add_stokes(end, band_.first, band_.count, stokes_, nodes_);
            return;
        }
        NodeWeights seen{};
        surroundings_.add_radiance(end.at, end.direction, end.coherency.power(), band_.first,
                                   band_.count, seen.data());
        for (int i = 0; i < band_.count; ++i)
            stokes_[band_.first + i] += end.transmitted[i] * seen[i];
    }
    // The weight has mean 0, so any radiance is unbiased. The mean radiance compensates the loss
    // best, and exactly in constant light.
    void roulette(const NodeWeights& weight) {
        for (int i = 0; i < band_.count; ++i)
            stokes_[band_.first + i] += weight[i] * usual_[band_.first + i];
    }
    void choice_begins() { estimates_.begin(luminance_so_far()); }
    void choice_ends(bool second) { estimates_.end(second, luminance_so_far()); }
    double variance() const { return estimates_.variance(); }

private:
    double luminance_so_far() const {
        double sum = 0;
        for (int k = 0; k < planes_; ++k) {
            for (int i = band_.first; i < band_.first + band_.count; ++i)
                sum += luminance_[k * nodes_ + i] * stokes_[k * nodes_ + i];
        }
        return sum;
    }
    const Surroundings& surroundings_;
    const Band& band_;
    const std::vector<double>&luminance_, &usual_;
    int nodes_, planes_;
    double* stokes_;
    PairedEstimates estimates_;
};

}  // namespace culet
