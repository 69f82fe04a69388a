#pragma once
// Stones that are known, for tests and benchmarks of the fit: random proportions, exact symmetry or
// none, what instruments would read on them, and meshes as bad hands would make them.

#include <string>
#include <vector>

#include "fit/readings/measurement.h"
#include "stone/stone.h"

namespace culet::bench {

enum class TruthKind { round, step, pear, trillion };
const char* name_of(TruthKind kind);

struct Truth {
    Stone stone;
    /// Exact rotation and mirror readings of the stone's group; empty without symmetry.
    std::vector<WrittenReading> symmetry;
    double length_sigma = 0.01, angle_sigma_deg = 0.1;
};

/// Proportions at random. `symmetric`: exact, as cut; else every plane is tilted by 0.3 degrees and
/// moved by 15 um (standard deviations), then all are brought back to exact meets.
Truth make_truth(TruthKind kind, bool symmetric, unsigned seed);
/// A convex stone of about that many facets without symmetry: tiers of random slope and phase round
/// an ellipsoid, three facets at every corner.
Truth make_tiered(int facets, unsigned seed);

/// Inclinations of all facets but the table, all edges, eight widths and the depth, with noise.
/// With symmetry: inclinations, the widths, the depth, the table's edges and the symmetry.
/// `edges`: how many of the edges are read, evenly spread; negative: all.
std::vector<WrittenReading> read_by_instruments(const Truth& truth, unsigned seed, int edges = -1);
/// Every facet's azimuth but the table's, across the slope to the same sigma as inclinations.
std::vector<WrittenReading> read_azimuths(const Truth& truth, unsigned seed);
/// The first without noise.
std::vector<WrittenReading> read_perfectly(const Truth& truth, int edges = -1);

/// Every corner off by a normal vector of root mean square `part` of the diameter.
Stone noisy_mesh(const Stone& stone, double part, unsigned seed);
/// What a modeller gets wrong: scales along the axes by N(0, 2 part) in the logarithm, radii by
/// height, crown and pavilion depths likewise, and corners by 0.3 part.
Stone wrongly_drawn(const Stone& stone, double part, unsigned seed);
/// One corner, moved by its distance to the nearest other one, in a random direction.
Stone kicked_mesh(const Stone& stone, unsigned seed);

/// Planes and corners brought to meet to rounding by least changes (Newton's method); false when
/// they cannot be.
bool bring_to_meet(Solid& solid);

}  // namespace culet::bench
