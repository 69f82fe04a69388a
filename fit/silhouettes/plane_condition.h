#pragma once
// What is known of planes besides outlines.

#include <vector>

#include "stone/solid/solid.h"

namespace culet {

/// The sum of by_normal . normal + by_offset * offset over some planes is `value`, with standard
/// deviation `sigma`.
struct PlaneCondition {
    struct Part {
        int plane = 0;
        Vec3 by_normal{0, 0, 0};
        double by_offset = 0;
    };
    std::vector<Part> parts;
    double value = 0, sigma = 1;
};

double residual(const PlaneCondition& condition, const std::vector<Plane>& planes);

}  // namespace culet
