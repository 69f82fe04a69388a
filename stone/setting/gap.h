#pragma once
// How near metal comes to a stone.

#include <array>
#include <vector>

#include "stone/setting/shell.h"

namespace culet {

using Triangle = std::array<Vec3, 3>;

/// Least distance between two triangles; 0 where they meet. After Ericson, Real-Time Collision
/// Detection (2005), 5.1: of triangles apart it is that of two edges, or of a corner and a face.
double distance_between(const Triangle& a, const Triangle& b);

/// The surface of a stone, asked for its distance from shells.
class StoneSurface {
public:
    explicit StoneSurface(const Solid& solid);

    /// From the shell's surface; 0 where they meet. A shell all inside is not told from one
    /// outside. `up_to`: no distance above this is looked for.
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
