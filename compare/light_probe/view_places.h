#pragma once
// Where the views of a ball were taken: cameras around one ball, or one camera and a moved ball.

#include <vector>

#include "compare/light_probe/cut_to_ball.h"
#include "compare/light_probe/near_light.h"
#include "compare/light_probe/view_alignment.h"

namespace culet {

/// One entry for each view.
struct PlacedViews {
    std::vector<CutToBall> cuts;
    std::vector<BallView> seen;
    std::vector<double> gains;      ///< to the first view's units
    std::vector<BallPlace> places;  ///< centre and turned_sigma; `view` as of the last call
    /// Of every further view to the one that it was aligned with.
    std::vector<ViewAlignment> alignments;
};

/// Columns: right, up, backwards of a camera that looks there.
glm::dmat3 world_from_camera(double azimuth, double elevation);

/// Aligns every view with a placed one, the surest pair first, from all rotations or from the known
/// one.
void align_all(PlacedViews& views, const ProbeOptions& options, const Progress& progress);

/// Refines the rotations to the first view without left-out pixels, from the outlines as found
/// (`priors`), because near lights distorted the first alignment.
void align_without_near_lights(PlacedViews& views, std::vector<ViewPrior> priors);

/// Places the balls that one camera saw; the focal length is the first view's. Throws InputError
/// when the camera is too far away to tell, or a ball moved less than its radius.
void place_moved_balls(PlacedViews& views);

/// Excludes the lights' pixels from now on.
void leave_out(const FoundNearLights& near, PlacedViews& views);

}  // namespace culet
