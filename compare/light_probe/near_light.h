#pragma once
// Lights so near that each end of a stone sees them in another direction: where they are, how large
// and how bright, from their reflexes in a mirror ball.
//
// Lengths in radii of the ball, in the world's frame with the first ball's centre at the origin.

#include <optional>
#include <string>
#include <vector>

#include "compare/light_probe/ball_view.h"
#include "compare/light_probe/window_fit.h"

namespace culet {

/// What the user says of a near light: where its reflex is, or where it stands.
struct NearLightRequest {
    std::string name;                    ///< for messages: the pixel as the user said it
    std::optional<PixelPlace> at;        ///< on its reflex in the first picture
    std::optional<PixelPlace> at_other;  ///< in the second picture; else searched
    std::optional<double> distance;      ///< of its middle from the ball's centre; else by parallax
    std::optional<Window> measured;      ///< with a ruler; then nothing else is given
};

/// A ball where a picture shows it.
struct BallPlace {
    BallView view;
    Vec3 centre{0, 0, 0};
    double gain = 1;          ///< to the units of the first
    double turned_sigma = 0;  ///< of its directions against the first's, about each axis, radians
};

struct NearLight {
    Window window;
    Vec3 normal;       ///< unit, towards the ball
    Rgb radiance{};    ///< as the first picture shows it; not divided by the ball's reflectance
    std::string from;  ///< "parallax", "distance" or "measured"
    double distance = 0, distance_sigma = 0;
    double tilt = 0, tilt_sigma = 0;  ///< radians against facing the ball
    bool facing = false;              ///< the tilt could not be told: taken as 0
    double residual = 0;              ///< of its edges, radians (root mean square)
    double over = 0;                  ///< share of its reflex that is over-exposed
    std::vector<std::string> notes;
    /// Empty when the light can be trusted; else it has no window, and is not among what is shown.
    std::string doubt;
    bool usable() const { return doubt.empty(); }
};

struct FoundNearLights {
    std::vector<NearLight> lights;
    /// A place's pixels that show any of the lights, as `BallView::left_out`.
    std::vector<std::shared_ptr<const std::vector<std::uint8_t>>> shown;
};

/// With two or more places the middle's distance follows from the parallax between the places where
/// the ball mirrors the light: some 0.6 of a radius apart when a camera went round a quarter, any
/// distance when the ball was moved. Throws InputError: no light at the pixel, or one of which the
/// places given cannot tell the distance.
FoundNearLights find_near_lights(const std::vector<BallPlace>& places,
                                 const std::vector<NearLightRequest>& requests);

}  // namespace culet
