#pragma once
// An environment map averaged over squares of directions, from fine to coarse, so that a ray whose
// pixel sees much of it sees the mean.
//
// Octahedral layout (Engelhardt & Dachsbacher 2008): x + y of the square -1..1 are a direction's
// x, y over |x| + |y| + |z|, folded over the diagonals below the horizon. Each level has a border
// of one texel that continues it, so that no look-up needs to know of the folds.

#include <vector>

#include "render/scene/scene.h"

namespace culet {

class EnvironmentPyramid {
public:
    explicit EnvironmentPyramid(const EnvironmentMap& map);

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

}  // namespace culet
