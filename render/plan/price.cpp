#include "render/plan/price.h"

#include <cmath>

namespace culet {

namespace {

// Measured (tests/bench/plan_bench --section prices).
constexpr double k_ray = 150, k_event = 55, k_plain_event = 45, k_leaf_node = 1.5;
constexpr double k_general_ray = 1500, k_general_event = 450;
constexpr double k_beam = 2300, k_fragment = 4, k_beams_of_event = 12, k_beam_power = 2.2;

}  // namespace

double price_ns(const PathWork& work) {
    if (work.general)
        return k_general_ray * work.rays + (k_general_event + work.nodes) * work.events;
    const double event = work.polarised ? k_event : k_plain_event;
    return k_ray * work.rays + (event + k_leaf_node * (work.nodes - 1)) * work.events;
}

double price_ns(const BeamWork& work) {
    // Beams grow like a power of the depth at which light is let go, far below exponentially.
    const double beams = k_beams_of_event * std::pow(work.events_per_ray, k_beam_power) + 100;
    const double fragments = work.pixels * work.events_per_ray;
    const double each = work.views * work.bands * (work.polarised ? 1.08 : 1.0);
    return each * (k_beam * beams + k_fragment * work.nodes * fragments);
}

}  // namespace culet
