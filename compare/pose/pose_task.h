#pragma once
// The input of a pose search: the photograph as it is and flipped left to right, the solid, and the
// approximate camera.

#include <memory>
#include <vector>

#include "compare/pose/coarse_search.h"
#include "compare/pose/edge_search.h"
#include "compare/pose/edge_support.h"
#include "compare/pose/find_pose.h"
#include "compare/pose/refine_view.h"
#include "compare/registration/frame.h"

namespace culet {

struct PhotoSide {
    PhotoSide(const cv::Mat& colour, const cv::Mat& mask, double saturation,
              const Camera& start_camera, const Vec3& middle, bool mirrored_);
    bool mirrored;
    cv::Mat stone;  ///< CV_8U
    OutlineShape shape;
    EdgeMap map;
    EdgePicture picture;
    StoneView start;
};

struct PoseTask {
    WireSolid wire;
    std::vector<glm::dmat3> symmetries;  ///< of the solid
    Camera start;                        ///< with the photograph's size
    const PoseOptions& options;
    const Progress& progress;
    std::vector<std::unique_ptr<PhotoSide>> sides;  ///< one; two when both chiralities are tried
    double prior_focal_px = 0;
};

/// Throws InputError when no pose can be found for this input.
void require_suitable(const Photo& photo, const Solid& solid, const Camera& start);

/// The start with the photograph's size. With another aspect ratio the photograph was cropped;
/// then, unless the start has a principal point, that and the focal length are less certain, which
/// is recorded in `options`.
Camera start_for(const Camera& start, int width, int height, PoseOptions& options);

/// Scaled to bright parts near 1. `saturation`: where it clips then.
cv::Mat exposed(const Photo& photo, double& saturation);

void make_sides(PoseTask& task, const cv::Mat& colour, const cv::Mat& mask, double saturation);

/// Throws Interrupted.
void report(const PoseTask& task, double fraction);

Target target_of(const PoseTask& task, const PhotoSide& side);
RefineSettings settings_of(const PoseTask& task, const PhotoSide& side);

}  // namespace culet
