#pragma once
// An environment map averaged over squares of directions, from fine to coarse, so that a ray whose
// pixel sees many texels sees their mean.
//
// Octahedral layout (Engelhardt & Dachsbacher 2008): the coordinates in the square -1..1 are a
// direction's x and y over |x| + |y| + |z|, folded over the diagonals below the horizon. Each level
// has a border of one texel, so that look-ups need not handle the folds.

#include <functional>
#include <memory>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

class EnvironmentPyramid {
public:
    /// `goes_on` is asked from any thread, once per row; false: the pyramid stays unfinished.
    explicit EnvironmentPyramid(const EnvironmentMap& map,
                                const std::function<bool()>& goes_on = {});

    struct Level {
        int side = 1;           ///< texels along an edge, without the border
        std::size_t start = 0;  ///< index of the border's corner texel
        float texel = 1;        ///< its largest angular extent, radians
        /// Index of a texel; the border's are at -1 and `side`.
        std::size_t at(int x, int y) const {
            return start + static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(side + 2) +
                   static_cast<std::size_t>(x + 1);
        }
    };
    const std::vector<Level>& levels() const { return levels_; }
    /// One plane of all levels per channel: red, green, blue.
    const float* plane(int channel) const {
        return planes_[static_cast<std::size_t>(channel)].data();
    }

private:
    template <class SumOf>
    std::vector<double> fill(const Level& level, const std::function<bool()>& goes_on,
                             const SumOf& sum_of);
    void continue_over_edges(const Level& level);

    std::vector<Level> levels_;
    std::vector<float> planes_[3];
};

/// Returns the same pyramid for the same map while anybody holds it: making one takes as long as
/// several pictures. If `goes_on` says no, it is unfinished and not kept. Thread-safe.
std::shared_ptr<const EnvironmentPyramid> pyramid_of(
    const std::shared_ptr<const EnvironmentMap>& map, const std::function<bool()>& goes_on);

}  // namespace culet
