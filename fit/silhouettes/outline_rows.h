#pragma once
// Turns the outlines' information on planes into rows for the fit. Private to the room.

#include <Eigen/Core>
#include <vector>

#include "fit/silhouettes/silhouette_fit.h"

namespace culet {

/// Motions of the stone that the fit takes from the outlines' frame; never the shift.
struct FrameHolds {
    Vec3 up{0, 0, 1};    ///< in the stone's frame
    bool tilts = false;  ///< of up
    bool turn = false;   ///< about up
};

struct OutlineRows {
    std::vector<OutlineObservations::Row> rows;
    std::vector<int> unseen;  ///< planes whose tilt comes from the start, not the outlines
};

/// Makes rows from the `information` on planes in the outlines' frame, which includes their start's
/// (sigmas `tilts`). `back` is the motion from that frame to the stone's.
OutlineRows outline_rows(const std::vector<Plane>& planes, const Eigen::MatrixXd& information,
                         const std::vector<double>& tilts, double width, const FrameMotion& back,
                         const FrameHolds& holds);

}  // namespace culet
