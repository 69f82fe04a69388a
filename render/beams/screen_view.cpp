#include "render/beams/screen_view.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "stone/text/errors.h"

namespace culet {

bool ScreenView::sees(const Plane& plane) const {
    if (parallel) return glm::dot(v, plane.normal) < 0;
    return height_above(plane, o) > 0;
}

ScreenView screen_view(const Camera& camera, double pupil_x, double pupil_y) {
    if (camera.cone)
        throw InputError("a conoscope's rays have no common eye: engine = \"reference\" draws it");
    const Vec3 forward = glm::normalize(camera.look_at - camera.position);
    const Vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const Vec3 down = glm::cross(forward, right);
    const auto [middle_x, middle_y] = line_of_sight_in(camera);
    const Vec3 beside = camera.aperture_radius * (pupil_x * right + pupil_y * down);
    const double focus = camera.focus_distance;
    ScreenView view;
    view.width = camera.width;
    view.height = camera.height;
    view.forward = forward;
    view.right = right;
    glm::dmat3 basis;  // its inverse maps a point, relative to the eye, to the picture
    if (camera.orthographic_width) {
        const double pixel = *camera.orthographic_width / camera.width;
        const Vec3 corner = camera.position - pixel * (middle_x * right + middle_y * down);
        if (camera.aperture_radius > 0) {
            // Rays of a pixel meet in the plane of focus, not in the pupil.
            view.o = corner + beside;
            view.v = focus * forward - beside;
        } else {
            view.o = corner;
            view.v = forward;
        }
        view.ox = pixel * right;
        view.oy = pixel * down;
        view.parallel = true;
        basis = glm::dmat3(view.ox, view.oy, view.v);
        const glm::dmat3 inverse = glm::inverse(basis);
        const Vec3 offset = -(inverse * view.o);
        for (int row = 0; row < 2; ++row) {
            view.rows[static_cast<std::size_t>(row)] = {inverse[0][row], inverse[1][row],
                                                        inverse[2][row]};
            view.row_offsets[row] = offset[row];
        }
        view.rows[2] = Vec3(0);
        view.row_offsets[2] = 1;
        return view;
    }
    const double pixel = 2 * std::tan(camera.fov / 2) / camera.height;
    const double far = camera.aperture_radius > 0 ? focus : 1;
    view.o = camera.position + beside;
    view.vx = far * pixel * right;
    view.vy = far * pixel * down;
    view.v = far * forward - (middle_x * view.vx + middle_y * view.vy) - beside;
    basis = glm::dmat3(view.vx, view.vy, view.v);
    const glm::dmat3 inverse = glm::inverse(basis);
    const Vec3 offset = -(inverse * view.o);
    for (int row = 0; row < 3; ++row) {
        view.rows[static_cast<std::size_t>(row)] = {inverse[0][row], inverse[1][row],
                                                    inverse[2][row]};
        view.row_offsets[row] = offset[row];
    }
    return view;
}

std::vector<ScreenView> pupil_views(const Camera& camera, int points) {
    constexpr double k_golden_angle = 2.39996322972865332;
    std::vector<ScreenView> views;
    for (int i = 0; i < points; ++i) {
        const double radius = std::sqrt((i + 0.5) / points);
        views.push_back(screen_view(camera, radius * std::cos(k_golden_angle * i),
                                    radius * std::sin(k_golden_angle * i)));
    }
    return views;
}

}  // namespace culet
