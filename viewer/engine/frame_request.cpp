#include "viewer/engine/frame_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "stone/text/errors.h"
#include "viewer/engine/stone_json.h"

namespace culet {

namespace {

using Json = nlohmann::ordered_json;

// A larger picture would not fit a page's memory.
constexpr int k_widest = 8192;
constexpr double k_most_pixels = 3.4e7;

int side_in(const Json& arguments, const char* key) {
    const int side = arguments.at(key).get<int>();
    if (side < 1 || side > k_widest)
        throw InputError(fmt::format("{} is 1 to {} pixels, found {}", key, k_widest, side));
    return side;
}

}  // namespace

FrameRequest frame_request(const Json& arguments, const Camera& usual) {
    FrameRequest request;
    Camera& camera = request.camera;
    camera = usual;
    camera.width = side_in(arguments, "width");
    camera.height = side_in(arguments, "height");
    if (static_cast<double>(camera.width) * camera.height > k_most_pixels)
        throw InputError(fmt::format("a picture of {} x {} pixels is too large for a page",
                                     camera.width, camera.height));
    camera.principal_point.reset();
    if (const auto view = arguments.find("camera"); view != arguments.end()) {
        camera.position = vector_from(view->at("position"));
        camera.look_at = vector_from(view->at("look_at"));
        camera.up = vector_from(view->at("up"));
        const Vec3 sight = camera.look_at - camera.position;
        if (!(glm::length(glm::cross(sight, camera.up)) > 0))
            throw InputError("the camera's up must not point along its view");
        if (view->contains("width")) {
            camera.orthographic_width = view->at("width").get<double>();
            if (!(*camera.orthographic_width > 0))
                throw InputError("the camera's width must be above 0");
        } else if (view->contains("fov_deg")) {
            camera.orthographic_width.reset();
            camera.fov = radians(view->at("fov_deg").get<double>());
            if (!(camera.fov > 0 && camera.fov < radians(179)))
                throw InputError("the camera's angle of view is above 0 and below 179 degrees");
        }
    }
    if (const auto turn = arguments.find("turn"); turn != arguments.end() && !turn->is_null())
        request.turn = turn->get<std::array<double, 9>>();
    request.preview = arguments.value("engine", "beams") == "preview";
    request.quick = arguments.value("quick", request.preview);
    if (const auto samples = arguments.find("samples");
        samples != arguments.end() && samples->is_number())
        request.samples = std::clamp(samples->get<int>(), 0, 1024);
    return request;
}

}  // namespace culet
