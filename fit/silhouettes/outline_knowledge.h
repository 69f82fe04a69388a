#pragma once
// From the information that outlines have of planes to rows for the fit. Private to the room.

#include <Eigen/Core>
#include <vector>

#include "fit/silhouettes/silhouette_fit.h"

namespace culet {

/// What of the stone's place the fit takes from the outlines' frame. Its shift is never asked for.
struct FrameHolds {
    Vec3 up{0, 0, 1};    ///< in the stone's frame
    bool tilts = false;  ///< of up
    bool turn = false;   ///< about up
};

struct ToldPlanes {
    std::vector<OutlineKnowledge::Row> rows;
    std::vector<int> unseen;  ///< planes whose tilt the start tells, not the outlines
};

/// `information`: of planes in the frame of the outlines, with what their start says (`tilts`);
/// `back` from there to the stone's.
ToldPlanes told_planes(const std::vector<Plane>& planes, const Eigen::MatrixXd& information,
                       const std::vector<double>& tilts, double width, const FrameMotion& back,
                       const FrameHolds& holds);

}  // namespace culet
