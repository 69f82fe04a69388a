#include "compare/pose/stone_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "compare/pose/view_formulas.h"

namespace culet {

namespace {

glm::dmat3 matrix_of(const std::array<double, 9>& rows) {
    return glm::transpose(glm::dmat3(rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6],
                                     rows[7], rows[8]));
}

/// From the viewing frame to the camera's; they coincide when the stone is in the middle.
glm::dmat3 camera_from_view(const StoneView& view) {
    const double across = view.nearness / view.scale;
    return matrix_of(least_rotation_to((view.at.x - view.sight.x) * across,
                                       (view.at.y - view.sight.y) * across));
}

}  // namespace

glm::dmat3 rotation_by(const Vec3& w) {
    return matrix_of(rotation_of(w.x, w.y, w.z));
}

double angle_of(const glm::dmat3& rotation) {
    const double sine =
        0.5 * glm::length(Vec3(rotation[1][2] - rotation[2][1], rotation[2][0] - rotation[0][2],
                               rotation[0][1] - rotation[1][0]));
    const double cosine = 0.5 * (rotation[0][0] + rotation[1][1] + rotation[2][2] - 1);
    return std::atan2(sine, cosine);
}

StoneView stone_view(const Camera& camera, const Vec3& middle) {
    StoneView view;
    const Vec3 forward = glm::normalize(camera.look_at - camera.position);
    const Vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const Vec3 down = glm::cross(forward, right);
    const glm::dmat3 camera_from_stone = glm::transpose(glm::dmat3(right, down, forward));
    const auto [x, y] = line_of_sight_in(camera);
    view.middle = middle;
    view.sight = {x, y};
    const Vec3 there = camera_from_stone * (middle - camera.position);
    if (camera.orthographic_width) {
        view.scale = camera.width / *camera.orthographic_width;
        view.at = {x + view.scale * there.x, y + view.scale * there.y};
        view.turn = camera_from_stone;
        return view;
    }
    const double focal = camera.height / (2 * std::tan(camera.fov / 2));
    view.nearness = 1 / there.z;
    view.scale = focal / there.z;
    view.at = {x + view.scale * there.x, y + view.scale * there.y};
    view.turn = glm::transpose(camera_from_view(view)) * camera_from_stone;
    return view;
}

Camera camera_of(const StoneView& view, const Camera& like) {
    Camera camera = like;
    const glm::dmat3 camera_from_stone = camera_from_view(view) * view.turn;
    const glm::dmat3 stone_from_camera = glm::transpose(camera_from_stone);
    const Vec3 forward = stone_from_camera[2];
    const double beside_x = (view.at.x - view.sight.x) / view.scale;
    const double beside_y = (view.at.y - view.sight.y) / view.scale;
    const double depth =
        view.nearness > 0 ? 1 / view.nearness : glm::length(like.look_at - like.position);
    camera.position = view.middle - stone_from_camera * Vec3(beside_x, beside_y, depth);
    camera.look_at = camera.position + depth * forward;
    camera.up = -stone_from_camera[1];
    if (view.nearness > 0) {
        camera.fov = 2 * std::atan(0.5 * like.height * view.nearness / view.scale);
        camera.orthographic_width.reset();
    } else {
        camera.orthographic_width = like.width / view.scale;
    }
    const bool in_the_middle =
        view.sight.x == 0.5 * like.width && view.sight.y == 0.5 * like.height;
    camera.principal_point.reset();
    if (!in_the_middle) camera.principal_point = {view.sight.x, view.sight.y};
    return camera;
}

EyePlace eye_of(const StoneView& view) {
    const glm::dmat3 stone_from_camera = glm::transpose(camera_from_view(view) * view.turn);
    if (!(view.nearness > 0)) return {-stone_from_camera[2], true};
    const double across = 1 / view.scale;
    return {view.middle - stone_from_camera * Vec3((view.at.x - view.sight.x) * across,
                                                   (view.at.y - view.sight.y) * across,
                                                   1 / view.nearness),
            false};
}

StoneView changed(const StoneView& view, const ViewChange& change) {
    StoneView result = view;
    result.turn = rotation_by({change[0], change[1], change[2]}) * view.turn;
    result.at = {view.at.x + change[3], view.at.y + change[4]};
    result.scale = view.scale * std::exp(change[5]);
    result.nearness = view.nearness * std::exp(change[6]);
    result.sight = {view.sight.x + change[7], view.sight.y + change[8]};
    return result;
}

Projection::Projection(const StoneView& view)
    : view_(view), from_stone_(camera_from_view(view) * view.turn) {}

PicturePoint Projection::operator()(const Vec3& point) const {
    const Vec3 there = from_stone_ * (point - view_.middle);
    const double depth = 1 + view_.nearness * there.z;
    return {view_.sight.x + (view_.at.x - view_.sight.x + view_.scale * there.x) / depth,
            view_.sight.y + (view_.at.y - view_.sight.y + view_.scale * there.y) / depth};
}

}  // namespace culet
