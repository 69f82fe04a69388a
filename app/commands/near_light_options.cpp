#include "app/commands/near_light_options.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "app/program/options.h"
#include "stone/text/errors.h"

namespace culet {

void add_near_light_options(CLI::App& command, NearLightWords& words) {
    command
        .add_option("--near", words.places,
                    "a near light: its pixel in the first picture (and in the second; otherwise "
                    "found); it becomes a window of the scene and leaves the environment")
        ->type_name("X,Y[,X2,Y2]")
        ->allow_extra_args(false);
    command
        .add_option("--near-distance", words.distances,
                    "of each --near light from the ball's middle, in the stone's unit, or find "
                    "(otherwise by its parallax)")
        ->type_name("LENGTH")
        ->allow_extra_args(false);
    command
        .add_option("--near-window", words.windows,
                    "a near light measured with a ruler from the ball's middle: middle, half "
                    "width, half height, in the stone's unit and frame")
        ->type_name("M,U,V")
        ->allow_extra_args(false);
    command.add_option("--ball-radius", words.ball_radius, "in the stone's unit, for near lights")
        ->type_name("LENGTH");
}

std::vector<NearLightRequest> near_requests(const NearLightWords& a) {
    if (!(a.ball_radius >= 0)) throw InputError("--ball-radius is over 0");
    std::vector<NearLightRequest> requests;
    for (const std::string& text : a.places) {
        const char* what =
            "--near is X,Y: a pixel of the light in the first picture, from the top left; or "
            "X,Y,X2,Y2 with its pixel in the second";
        const auto values = numbers_in(text, 2, 4, what);
        if (values.size() == 3) throw InputError(fmt::format("\"{}\": {}", text, what));
        NearLightRequest request;
        request.at = PixelPlace{values[0], values[1]};
        if (values.size() == 4) request.at_other = PixelPlace{values[2], values[3]};
        requests.push_back(request);
    }
    if (!a.distances.empty() && a.distances.size() != a.places.size()) {
        throw InputError(
            fmt::format("--near-distance was given {} times for {} lights of --near: once for "
                        "each, or find where the pictures tell it",
                        a.distances.size(), a.places.size()));
    }
    for (std::size_t i = 0; i < a.distances.size(); ++i) {
        if (a.distances[i] == "find") continue;
        const double distance =
            numbers_in(a.distances[i], 1, 1,
                       "--near-distance is a length in the stone's unit, from the ball's middle to "
                       "the light's, or find")[0];
        if (!(distance > a.ball_radius)) {
            throw InputError(fmt::format(
                "--near-distance {:g}: the light is outside the ball, whose radius is {:g}",
                distance, a.ball_radius));
        }
        requests[i].distance = distance;
    }
    for (const std::string& text : a.windows) {
        const auto n =
            numbers_in(text, 9, 9,
                       "--near-window is MX,MY,MZ,UX,UY,UZ,VX,VY,VZ: the middle of the "
                       "window, half its width and half its height, in the stone's unit");
        const Window window{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}};
        const double u = glm::length(window.u), v = glm::length(window.v);
        if (!(u > 0 && v > 0) || std::abs(glm::dot(window.u, window.v)) > 0.01 * u * v) {
            throw InputError(fmt::format(
                "\"{}\": half the width and half the height of a window are two vectors "
                "at right angles",
                text));
        }
        if (std::abs(glm::dot(glm::cross(window.u, window.v), window.middle)) <=
            a.ball_radius * u * v) {
            throw InputError(
                fmt::format("\"{}\": the plane of this window passes through the ball", text));
        }
        NearLightRequest request;
        request.measured = window;
        requests.push_back(request);
    }
    return requests;
}

}  // namespace culet
