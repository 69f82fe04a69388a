#include "compare/pose/pose_task.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "compare/photo/pixels.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Sizes that differ by no more than this have the same aspect ratio.
constexpr double k_rounding_px = 1.5;
// Standard deviation of a uniform distribution over what was cropped, 1 / sqrt(12).
constexpr double k_uniform_sigma = 0.29;
constexpr double k_edge_reach = 0.012;  // of the edge map, share of the diameter

}  // namespace

PhotoSide::PhotoSide(const cv::Mat& colour, const cv::Mat& mask, double saturation,
                     const Camera& start_camera, const Vec3& middle, bool mirrored_)
    : mirrored(mirrored_),
      stone(mask),
      shape(outline_shape(mask)),
      map(colour, mask, shape.diameter, k_edge_reach),
      picture(colour, saturation) {
    Camera camera = start_camera;
    if (mirrored && camera.principal_point)
        (*camera.principal_point)[0] = camera.width - (*camera.principal_point)[0];
    start = stone_view(camera, middle);
}

void require_suitable(const Photo& photo, const Solid& solid, const Camera& start) {
    if (start.cone)
        throw InputError("a conoscope shows directions, not the stone: no pose to find");
    if (start.optics.two_windows)
        throw InputError("a dichroscope's two windows show the stone twice: give one of them");
    if (!is_closed(solid) || !is_convex(solid)) {
        throw InputError(
            "a pose is found for closed, convex stones only: see what culet info says of this one");
    }
    const auto pixels =
        static_cast<std::size_t>(photo.width) * static_cast<std::size_t>(photo.height);
    if (!photo.mask.empty() && photo.mask.size() != pixels)
        throw InputError("the mask has another size than the photograph");
}

Camera start_for(const Camera& start, int width, int height, PoseOptions& options) {
    Camera camera = start;
    camera.width = width;
    camera.height = height;
    const double across = static_cast<double>(width) / start.width,
                 down = static_cast<double>(height) / start.height;
    const double off = std::abs(across - down) * std::min(start.width, start.height);
    if (camera.principal_point) {
        (*camera.principal_point)[0] *= across;
        (*camera.principal_point)[1] *= down;
        return camera;
    }
    if (off <= k_rounding_px) return camera;
    // Assumes the smallest possible crop: a photograph no larger than the start's picture has the
    // same pixels.
    const double grown = std::max({1.0, across, down});
    if (camera.orthographic_width) {
        *camera.orthographic_width *= across / grown;
        return camera;
    }
    camera.fov = 2 * std::atan(std::tan(start.fov / 2) * down / grown);
    const double cut = std::max(grown * start.width - width, grown * start.height - height);
    options.principal_point_error =
        std::hypot(options.principal_point_error, k_uniform_sigma * cut / width);
    return camera;
}

cv::Mat exposed(const Photo& photo, double& saturation) {
    const cv::Mat colour = colour_of(photo);
    const double bright = quantile(luminance(colour), {}, 0.995);
    saturation = photo.saturation;
    if (!(bright > 0)) return colour.clone();
    saturation /= bright;
    return colour * (1 / bright);
}

void make_sides(PoseTask& task, const cv::Mat& colour, const cv::Mat& mask, double saturation) {
    task.sides.push_back(
        std::make_unique<PhotoSide>(colour, mask, saturation, task.start, task.wire.middle, false));
    if (!task.options.both_chiralities) return;
    cv::Mat flipped, flipped_mask;
    cv::flip(colour, flipped, 1);
    cv::flip(mask, flipped_mask, 1);
    task.sides.push_back(std::make_unique<PhotoSide>(flipped, flipped_mask, saturation, task.start,
                                                     task.wire.middle, true));
}

void report(const PoseTask& task, double fraction) {
    if (task.progress && !task.progress(fraction)) throw Interrupted();
}

Target target_of(const PoseTask& task, const PhotoSide& side) {
    return {task.wire, side.shape, side.map, side.start.focal_px(), task.options.facet_error};
}

RefineSettings settings_of(const PoseTask& task, const PhotoSide& side) {
    RefineSettings settings;
    settings.prior_focal_px = task.prior_focal_px;
    settings.sight = side.start.sight;
    settings.facet_error = task.options.facet_error;
    settings.focal_error = task.options.focal_error;
    settings.principal_point_error = task.options.principal_point_error * task.start.width;
    settings.diameter_px = side.shape.diameter;
    return settings;
}

}  // namespace culet
