#include "compare/calibration/cropped_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/registration/frame.h"
#include "stone/text/errors.h"

namespace culet {

std::vector<std::array<double, 2>> projected_corners(const Solid& solid, const Camera& camera) {
    // Derives the camera's frame from its own rays: the line of sight, one pixel to its right, and
    // one below.
    const EyeRays rays(camera);
    const auto middle = line_of_sight_in(camera);
    const EyeRay ahead = rays.through(middle[0], middle[1]);
    const EyeRay beside = rays.through(middle[0] + 1, middle[1]);
    const EyeRay below = rays.through(middle[0], middle[1] + 1);
    const Vec3 forward = ahead.direction;
    const bool orthographic = camera.orthographic_width.has_value();
    const auto step = [&](const EyeRay& ray) {
        if (orthographic) return ray.origin - ahead.origin;
        return ray.direction / glm::dot(ray.direction, forward) - forward;
    };
    const Vec3 right = step(beside), down = step(below);
    std::vector<std::array<double, 2>> points;
    for (const Vec3& corner : solid.vertices) {
        const Vec3 from = corner - ahead.origin;
        const double depth = orthographic ? 1 : glm::dot(from, forward);
        if (!(depth > 0)) continue;
        points.push_back({middle[0] + glm::dot(from, right) / glm::dot(right, right) / depth,
                          middle[1] + glm::dot(from, down) / glm::dot(down, down) / depth});
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
        // The focal length in pixels, scaled.
        const double half = std::tan(camera.fov / 2) * size[1] / (scale * camera.height);
        result.fov = 2 * std::atan(half);
    }
    return result;
}

Camera camera_for(const Photo& photo, const Camera& camera, const Solid& solid, double largest) {
    const double across = stone_diameter_px(photo);
    return cropped_to_stone(camera, solid, across > 0 ? std::min(across, largest) : largest,
                            k_stone_margin);
}

}  // namespace culet
