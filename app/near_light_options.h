#pragma once
// What a command line says of lights near the ball.

#include <string>
#include <vector>

#include "compare/light/near_light.h"

namespace culet {

struct NearLightWords {
    std::vector<std::string> places, distances,
        windows;  ///< --near, --near-distance, --near-window
    double ball_radius = 0;
};

/// "1,2,3" as numbers; `what` says what was expected. Throws InputError.
std::vector<double> numbers_in(const std::string& text, std::size_t least, std::size_t most,
                               const std::string& what);

/// In the stone's unit and pixels of the photographs. Throws InputError.
std::vector<NearLightRequest> near_requests(const NearLightWords& words);

}  // namespace culet
