#pragma once
// Command-line options for lights near the ball.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "compare/light_probe/near_light.h"

namespace culet {

struct NearLightWords {
    std::vector<std::string> places, distances,
        windows;  ///< --near, --near-distance, --near-window
    double ball_radius = 0;
};

/// `words` must outlive `command`.
void add_near_light_options(CLI::App& command, NearLightWords& words);

/// Results are in the stone's unit and the photographs' pixels. Throws InputError.
std::vector<NearLightRequest> near_requests(const NearLightWords& words);

}  // namespace culet
