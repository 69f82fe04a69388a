#include "compare/refine/photograph_scene.h"

#include <algorithm>

#include "compare/calibration/cropped_camera.h"
#include "compare/pose/find_pose.h"
#include "compare/registration/frame.h"
#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_largest = 256;  // pixels across; samples are 192
// Required 99 % certainty of a pose; refining finds the rest.
constexpr double k_pose_angle = radians(4.0), k_pose_shift = 0.01;

}  // namespace

Scene photograph_scene(const Photo& photo, const Scene& scene, bool find, int threads,
                       const Progress& progress) {
    Scene result = scene;
    const double across = stone_diameter_px(photo);
    if (find) {
        PoseOptions options;
        options.threads = threads;
        options.limits.angle = k_pose_angle;
        options.limits.shift_px = std::max(1.0, k_pose_shift * across);
        // Only near the scene's camera, because a stone looks alike after certain rotations.
        options.all_turns = false;
        FoundPose pose = find_pose(photo, scene.stone.solid, scene.camera, options, progress);
        if (!pose.usable()) {
            options.all_turns = true;
            pose = find_pose(photo, scene.stone.solid, scene.camera, options, progress);
        }
        if (!pose.usable()) {
            throw InputError("its pose was not found: " + pose.trouble +
                             ". What to do: culet register finds the pose and takes options; give "
                             "the scene its camera, and refine --keep-pose. " +
                             pose.remedy);
        }
        result.camera = pose.camera;
    }
    result.camera = camera_for(photo, result.camera, scene.stone.solid, k_largest);
    return result;
}

}  // namespace culet
