#pragma once
// Known stones for tests and benchmarks of the fit: random proportions, with exact symmetry or
// none, the instruments' readings of them, and badly drawn meshes.

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

/// Random proportions. If `symmetric`, the stone is exact; else every plane is tilted by 0.3
/// degrees and moved by 15 um (standard deviations), and then all planes are moved back to exact
/// meets.
Truth make_truth(TruthKind kind, bool symmetric, unsigned seed);
/// A convex stone of about that many facets without symmetry: tiers of random slope and phase round
/// an ellipsoid, with three facets at every corner.
Truth make_tiered(int facets, unsigned seed);

/// Noisy readings. Without symmetry: inclinations of all facets but the table, all edges, eight
/// widths and the depth. With symmetry: inclinations, widths, the depth, the table's edges and the
/// symmetry. `edges`: how many edges are read, evenly spread; negative: all.
std::vector<WrittenReading> read_by_instruments(const Truth& truth, unsigned seed, int edges = -1);
/// Every facet's azimuth but the table's. Across the slope it has the same sigma as inclinations.
std::vector<WrittenReading> read_azimuths(const Truth& truth, unsigned seed);
/// `read_by_instruments` without noise.
std::vector<WrittenReading> read_perfectly(const Truth& truth, int edges = -1);

/// Moves every corner by a normal vector with a root mean square of `part` of the diameter.
Stone noisy_mesh(const Stone& stone, double part, unsigned seed);
/// Typical errors of a modeller: scales along the axes by N(0, 2 part) in the logarithm, the same
/// for radii by height and for crown and pavilion depths, and corners by 0.3 part.
Stone wrongly_drawn(const Stone& stone, double part, unsigned seed);
/// Moves one corner by its distance to the nearest other one, in a random direction.
Stone kicked_mesh(const Stone& stone, unsigned seed);

/// Moves planes and corners by the smallest changes so that they meet to rounding (Newton's
/// method); false when that is impossible.
bool bring_to_meet(Solid& solid);

}  // namespace culet::bench
