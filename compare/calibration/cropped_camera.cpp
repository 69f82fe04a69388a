#include "compare/calibration/cropped_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/pose/stone_view.h"
#include "stone/errors.h"

namespace culet {

std::vector<std::array<double, 2>> projected_corners(const Solid& solid, const Camera& camera) {
    const Projection seen(stone_view(camera, camera.look_at));
    const Vec3 forward = camera.look_at - camera.position;
    std::vector<std::array<double, 2>> points;
    for (const Vec3& corner : solid.vertices) {
        const bool ahead = glm::dot(corner - camera.position, forward) > 0;
        if (!ahead && !camera.orthographic_width) continue;
        const PicturePoint at = seen(corner);
        points.push_back({at.x, at.y});
    }
    return points;
}

double projected_diameter(const Solid& solid, const Camera& camera) {
    std::vector<cv::Point2f> points, hull;
    for (const auto& p : projected_corners(solid, camera)) {
        points.emplace_back(static_cast<float>(p[0]), static_cast<float>(p[1]));
    }
    if (points.size() < 3) return 0;
    cv::convexHull(points, hull);
    return std::sqrt(4 * cv::contourArea(hull) / CV_PI);
}

Camera cropped_to_stone(const Camera& camera, const Solid& solid, double diameter, double margin) {
    if (camera.cone || camera.optics.two_windows) {
        throw InputError(
            "a conoscope's or dichroscope's picture cannot be compared by its outline");
    }
    const auto corners = projected_corners(solid, camera);
    const double across = projected_diameter(solid, camera);
    if (corners.empty() || !(across > 0)) {
        throw InputError("the scene's camera does not see the stone: look_at should be near it");
    }
    double low[2] = {corners[0][0], corners[0][1]}, high[2] = {low[0], low[1]};
    for (const auto& p : corners) {
        for (std::size_t i = 0; i < 2; ++i) {
            low[i] = std::min(low[i], p[i]);
            high[i] = std::max(high[i], p[i]);
        }
    }
    const double scale = diameter / across;
    int size[2];
    double corner[2];
    for (std::size_t i = 0; i < 2; ++i) {
        const double extent = high[i] - low[i] + 2 * margin * across;
        size[i] = static_cast<int>(std::ceil(extent * scale));
        corner[i] = (low[i] + high[i]) / 2 - size[i] / scale / 2;
    }
    const auto middle = line_of_sight_in(camera);
    Camera result = camera;
    result.width = size[0];
    result.height = size[1];
    result.principal_point = {(middle[0] - corner[0]) * scale, (middle[1] - corner[1]) * scale};
    if (camera.orthographic_width) {
        result.orthographic_width = *camera.orthographic_width * size[0] / (scale * camera.width);
    } else {
        // One focal length in pixels, times the scale.
        const double half = std::tan(camera.fov / 2) * size[1] / (scale * camera.height);
        result.fov = 2 * std::atan(half);
    }
    return result;
}

}  // namespace culet
