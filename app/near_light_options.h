#pragma once
// What a command line says of lights near the ball.

#include <string>
#include <vector>

#include "compare/light_probe/near_light.h"

namespace culet {

struct NearLightWords {
    std::vector<std::string> places, distances,
        windows;  ///< --near, --near-distance, --near-window
    double ball_radius = 0;
};

/// In the stone's unit and pixels of the photographs. Throws InputError.
std::vector<NearLightRequest> near_requests(const NearLightWords& words);

}  // namespace culet
