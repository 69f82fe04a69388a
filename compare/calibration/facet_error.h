#pragma once
// Stones that are not quite the model: the yardstick by which a photograph's scores are read.

#include <cstdint>
#include <optional>

#include "stone/solid/solid.h"

namespace culet {

/// The convex solid with each facet's plane tilted about an axis of random direction in the facet's
/// plane through the mean of its corners, so that it stays in its place. The angles are of normal
/// distribution, their root mean square over the stone's facets is `rms` (radians): a stone's facet
/// error is that of its own tilts. Those of 25 facets drawn with one standard deviation would
/// differ by 14 % from stone to stone, and no picture could tell which it was drawn with.
/// Names are kept; a facet that is tilted out of the stone is gone. Nothing when the planes bound
/// no solid any more, or `solid` is not convex. The same seed gives the same tilts, in proportion.
std::optional<Solid> with_facet_error(const Solid& solid, double rms, std::uint64_t seed);

/// The same of one facet alone: tilted by `angle` (radians) about the first (0) or second (1) of
/// two axes in its plane that are square to each other. A facet error of s gives each of the two
/// angles the mean square s^2 / 2.
std::optional<Solid> with_facet_tilted(const Solid& solid, std::size_t facet, int axis,
                                       double angle);

/// The stone as a catalogue would have it: the most symmetrical of the solids near to it. Its
/// symmetry is the largest n (2 to 16) for which turning about `up` by 1/n, and mirroring where
/// that holds too, takes every facet near to another one (normals within 3 degrees, offsets within
/// 3 % of the diameter); planes that go into each other are then made alike by their mean. Nothing
/// when there is no such n, or nothing changes by it.
std::optional<Solid> symmetrised(const Solid& solid, const Vec3& up);

/// By what part of a full turn about `up` a stone looks much like itself: that n, 1 if there is
/// none.
int turns_alike(const Solid& solid, const Vec3& up);

}  // namespace culet
