#pragma once
// An environment map averaged over squares of directions, from fine to coarse, so that a ray whose
// pixel sees much of it sees the mean.
//
// Octahedral layout (Engelhardt & Dachsbacher 2008): x + y of the square -1..1 are a direction's
// x, y over |x| + |y| + |z|, folded over the diagonals below the horizon. Each level has a border
// of one texel that continues it, so that no look-up needs to know of the folds.

#include <functional>
#include <memory>
#include <vector>

#include "render/scene/scene.h"

namespace culet {

class EnvironmentPyramid {
public:
    /// `goes_on`: asked from any thread, once a row; false: the pyramid is left unfinished.
    explicit EnvironmentPyramid(const EnvironmentMap& map,
                                const std::function<bool()>& goes_on = {});

    struct Level {
        int side = 1;           ///< texels along an edge, without the border
        std::size_t start = 0;  ///< of the texel in the border's corner
        float texel = 1;        ///< its largest extent as an angle, radians
    };
    const std::vector<Level>& levels() const { return levels_; }
    /// Three planes of all levels: red, green, blue.
    const float* plane(int channel) const {
        return planes_[static_cast<std::size_t>(channel)].data();
    }

private:
    std::vector<Level> levels_;
    std::vector<float> planes_[3];
};

/// The same again for the same map, as long as somebody has that: making one takes as long as
/// drawing some pictures. Unfinished, and not kept, where `goes_on` says no. From any thread.
std::shared_ptr<const EnvironmentPyramid> pyramid_of(
    const std::shared_ptr<const EnvironmentMap>& map, const std::function<bool()>& goes_on);

}  // namespace culet
