#pragma once
// Stones that differ slightly from the model, as the yardstick for a photograph's scores.

#include <cstdint>
#include <optional>

#include "stone/solid/solid.h"

namespace culet {

/// Tilts each facet of a convex solid about a random axis in its plane through the mean of its
/// corners, so that the facet stays in its place. The angles are normally distributed and then
/// scaled so that their root mean square over the facets is exactly `rms` (radians). Without the
/// scaling, stones of 25 facets would differ by 14 % in facet error, and no picture could tell
/// which error it was drawn with.
///
/// Names are kept; a facet that is tilted out of the stone disappears. The same seed gives the same
/// tilts, in proportion to `rms`. Nothing when the planes no longer bound a solid or `solid` is not
/// convex.
std::optional<Solid> with_facet_error(const Solid& solid, double rms, std::uint64_t seed);

/// Tilts one facet by `angle` (radians) about the first (0) or second (1) of two perpendicular axes
/// in its plane. A facet error s gives each of the two angles the mean square s^2 / 2.
std::optional<Solid> with_facet_tilted(const Solid& solid, std::size_t facet, int axis,
                                       double angle);

/// The stone as a catalogue would have it: the most symmetrical solid near it. Its order of
/// symmetry is the largest n (2 to 16) for which a turn about `up` by 1/n (and a mirror plane, if
/// there is one) takes every facet near another one: normals within 3 degrees, offsets within 3 %
/// of the diameter. Corresponding planes are then replaced by their mean. Nothing when there is no
/// such n, or nothing changes.
std::optional<Solid> symmetrised(const Solid& solid, const Vec3& up);

/// The n of `symmetrised`: the stone looks much the same after 1/n of a turn about `up`. 1: no
/// symmetry.
int turns_alike(const Solid& solid, const Vec3& up);

}  // namespace culet
