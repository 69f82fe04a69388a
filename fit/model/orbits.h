#pragma once
// Exact symmetry: which facets and meets are images of which, under which motion. The axis of all
// rotations is +z through the origin; all mirror planes contain it.

#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "fit/model/shape.h"
#include "stone/solid/automorphisms.h"

namespace culet {

/// A motion of space that permutes facets and meets.
struct SymmetryMotion {
    Automorphism exchange;
    glm::dmat3 motion{1.0};  ///< a turn about z, or a reflection at a plane through z
};
glm::dmat3 turn_about_z(double angle);
Shape turned_about_z(Shape shape, double angle);
/// `azimuth`: of the plane's normal.
glm::dmat3 mirroring_at(double azimuth);

/// A member of an orbit: the image of the first one under `from_first`.
struct OrbitMember {
    int first = -1;
    glm::dmat3 from_first{1.0};
};

/// The directions that are fixed by all motions that map a thing to itself. It can only move within
/// them.
struct KeptDirections {
    enum class Kind { all, vertical_plane, axis } kind = Kind::all;
    Vec3 outward{1, 0, 0};  ///< vertical_plane: its level direction
};

struct Orbits {
    std::vector<OrbitMember> facets, points;
    std::vector<KeptDirections> kept_by_facet, kept_by_point;  ///< of first members
    std::vector<SymmetryMotion> generators;

    bool empty() const { return generators.empty(); }
};

/// Nothing when the motions contradict each other on these facets: two of them permute facets alike
/// but move space differently.
std::optional<Orbits> orbits_of(const std::vector<SymmetryMotion>& generators, int facets,
                                int points);

}  // namespace culet
