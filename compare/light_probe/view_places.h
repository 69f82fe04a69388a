#pragma once
// Where the views of a ball were taken: cameras around one ball, or one camera and a ball that
// moved.

#include <vector>

#include "compare/light_probe/cut_to_ball.h"
#include "compare/light_probe/near_light.h"
#include "compare/light_probe/view_alignment.h"

namespace culet {

/// One entry a view each.
struct PlacedViews {
    std::vector<CutToBall> cuts;
    std::vector<BallView> seen;
    std::vector<double> gains;      ///< to the first view's units
    std::vector<BallPlace> places;  ///< centre and turned_sigma; the view as of the last call
    /// Of the second and further views to the one that placed them.
    std::vector<ViewAlignment> alignments;
};

/// Columns: right, up, backwards of a camera that looks to this azimuth and elevation.
glm::dmat3 world_from_camera(double azimuth, double elevation);

/// Every view against one that is placed already, the surest pair first; from all turns or from the
/// one that is known.
void align_all(PlacedViews& views, const ProbeOptions& options, const Progress& progress);

/// The last fraction of the turns to the first view again, by what is not left out, and from the
/// outlines as they were found (`priors`): near light has bent those of the first time.
void align_without_near_lights(PlacedViews& views, std::vector<ViewPrior> priors);

/// The views of balls that one camera saw, and where they lay: the focal length is the first's.
/// Throws InputError: a camera too far away to tell, or a ball that went less than its radius.
void place_moved_balls(PlacedViews& views);

/// From now on the lights' pixels are not used.
void leave_out(const FoundNearLights& near, PlacedViews& views);

}  // namespace culet
