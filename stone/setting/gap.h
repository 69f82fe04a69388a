#pragma once
// Distances between metal and stone.

#include <array>
#include <vector>

#include "stone/setting/shell.h"

namespace culet {

using Triangle = std::array<Vec3, 3>;

/// Least distance between two triangles; 0 where they meet. After Ericson, Real-Time Collision
/// Detection (2005), 5.1: it is the distance of two edges, or of a corner and a face.
double distance_between(const Triangle& a, const Triangle& b);

/// Measures distances of a stone from shells.
class StoneSurface {
public:
    explicit StoneSurface(const Solid& solid);

    /// Returns 0 where they meet. Does not tell a shell wholly inside from one outside. Distances
    /// above `up_to` are not searched.
    double distance_to(const Shell& shell, double up_to) const;

private:
    struct Box {
        Vec3 low{0, 0, 0}, high{0, 0, 0};
    };
    static Box box_of(const Triangle& triangle);
    static double squared_distance(const Box& a, const Box& b);

    std::vector<Triangle> triangles_;
    std::vector<Box> boxes_;
};

}  // namespace culet
