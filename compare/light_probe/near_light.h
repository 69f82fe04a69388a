#pragma once
// Finds lights so near that the two ends of a stone see them in different directions: their place,
// size and radiance, from their reflexes in a mirror ball.
//
// Lengths in radii of the ball, in the world's frame with the first ball's centre at the origin.

#include <optional>
#include <string>
#include <vector>

#include "compare/light_probe/ball_view.h"
#include "compare/light_probe/window_fit.h"

namespace culet {

/// What the user gives: where the reflex is, or where the light stands.
struct NearLightRequest {
    std::string name;                    ///< for messages: the pixel as the user wrote it
    std::optional<PixelPlace> at;        ///< on its reflex in the first picture
    std::optional<PixelPlace> at_other;  ///< in the second picture; otherwise searched
    std::optional<double> distance;      ///< of its middle from the ball; otherwise by parallax
    std::optional<Window> measured;      ///< with a ruler; then nothing else is given
};

/// A ball and the picture that shows it.
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
    double tilt = 0, tilt_sigma = 0;  ///< radians; 0: facing the ball
    bool facing = false;              ///< the tilt is not identifiable and taken as 0
    double residual = 0;              ///< of its edges, root mean square, radians
    double over = 0;                  ///< share of its reflex that is over-exposed
    std::vector<std::string> notes;
    /// Why the light cannot be trusted; it then has no window and is not in `shown`. Otherwise
    /// empty.
    std::string doubt;
    bool usable() const { return doubt.empty(); }
};

struct FoundNearLights {
    std::vector<NearLight> lights;
    /// For each place, the pixels that show a light, as `BallView::left_out`.
    std::vector<std::shared_ptr<const std::vector<std::uint8_t>>> shown;
};

/// With two or more places the distance follows from the parallax of the points of the ball that
/// reflect the light: about 0.6 radii apart when a camera went round a quarter turn, any distance
/// apart when the ball was moved. Throws InputError when there is no light at the pixel, or the
/// places cannot determine its distance.
FoundNearLights find_near_lights(const std::vector<BallPlace>& places,
                                 const std::vector<NearLightRequest>& requests);

}  // namespace culet
