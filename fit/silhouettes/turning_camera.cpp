#include "fit/silhouettes/turning_camera.h"

#include <cmath>

#include "fit/silhouettes/turning_slopes.h"

namespace culet {

namespace {

struct View {
    Vec3 right, up, sight;
};

View view_of(const TurningCamera& camera, double turn) {
    // When the stone turns one way, the camera goes round it the other way.
    const double x = std::cos(turn), y = -std::sin(turn);
    const double c = std::cos(camera.elevation), s = std::sin(camera.elevation);
    return {{-y, x, 0}, {-s * x, -s * y, c}, {c * x, c * y, s}};
}

}  // namespace

PictureAxes picture_axes(const TurningCamera& camera, double turn) {
    const View view = view_of(camera, turn);
    const double c = std::cos(camera.roll), s = std::sin(camera.roll);
    return {c * view.right + s * view.up, c * view.up - s * view.right,
            camera.perspective * view.sight, camera.axis, 0};
}

PictureSlopes picture_slopes(const TurningCamera& camera, double turn, double nx, double ny,
                             const Vec3& place) {
    const View view = view_of(camera, turn);
    const double c = std::cos(camera.roll), s = std::sin(camera.roll);
    // The normal by the axis' directions in the picture.
    const double mr = c * nx - s * ny, mu = s * nx + c * ny;
    const double r = glm::dot(view.right, place), u = glm::dot(view.up, place),
                 d = glm::dot(view.sight, place);
    const double w = 1 - camera.perspective * d, q = (mr * r + mu * u) / w;
    const double p = camera.perspective * q;
    const double ce = std::cos(camera.elevation), se = std::sin(camera.elevation);
    PictureSlopes slopes;
    slopes.by_place = (mr * view.right + mu * view.up + p * view.sight) / w;
    slopes.by_axis = nx;
    slopes.by_roll = (mr * u - mu * r) / w;
    slopes.by_elevation = (p * u - mu * d) / w;
    slopes.by_perspective = q * d / w;
    // By the camera's azimuth, which falls as the turn grows.
    const double level = ce * d - se * u;
    slopes.by_turn = -(p * ce * r - mr * level - mu * se * r) / w;
    return slopes;
}

}  // namespace culet
