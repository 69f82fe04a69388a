#pragma once
// Stones that differ slightly from the model, as the yardstick for a photograph's scores.

#include <cstdint>
#include <optional>

#include "stone/solid/solid.h"

namespace culet {

/// Tilts each facet about a random axis in its plane through the mean of its corners, so that it
/// stays in place. The normally distributed angles are scaled to a root mean square of exactly
/// `rms` (radians) over the facets; unscaled, stones of 25 facets would differ by 14 % in facet
/// error, and no picture could tell theirs.
///
/// Names are kept; a facet tilted out of the stone disappears. One seed gives the same tilts, in
/// proportion to `rms`. Nothing when the planes bound no solid or `solid` is not convex.
std::optional<Solid> with_facet_error(const Solid& solid, double rms, std::uint64_t seed);

/// Tilts one facet by `angle` (radians) about the first (0) or second (1) of two perpendicular axes
/// in its plane. A facet error s means s^2 / 2 of mean square for each.
std::optional<Solid> with_facet_tilted(const Solid& solid, std::size_t facet, int axis,
                                       double angle);

/// The most symmetrical solid nearby, as a catalogue would have it. Finds the largest n (2 to 16)
/// for which a turn about `up` by 1/n (and a mirror plane, if any) takes every facet near another:
/// normals within 3 degrees, offsets within 3 % of the diameter. Corresponding planes become their
/// mean. Nothing when there is no such n, or nothing changes.
std::optional<Solid> symmetrised(const Solid& solid, const Vec3& up);

/// The n of `symmetrised`: the stone looks much the same after 1/n of a turn about `up`. 1: no
/// symmetry.
int turns_alike(const Solid& solid, const Vec3& up);

}  // namespace culet
