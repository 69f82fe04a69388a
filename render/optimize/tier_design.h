#pragma once
// A cut whose tiers' angles change while its meets are kept: every facet keeps its azimuth (its
// index setting), and wherever four or more facets of the design meet in a corner, they still do.
//
// The unknowns are every facet's angle and offset; girdle facets stay as they are, level ones keep
// their angle. Wanted angles come first: each facet turns about its corners next to the girdle, the
// table follows the facets around it. Then the nearest angles and offsets are found at which all
// meets hold: Gauss-Newton on the meets' misses, each step the smallest that takes them away.
// What the design's symmetry about +z takes into each other changes alike
// (stone/design/drawn_symmetry.h).

#include <optional>
#include <vector>

#include "stone/design/tiers.h"
#include "stone/solid/solid.h"

namespace culet {

/// Mean angle from the horizontal of a tier's facets as they stand in `solid`, radians.
double mean_angle(const Solid& solid, const FacetTier& tier);

class TierDesign {
public:
    /// `solid`: closed and convex, table up (+z). Throws InputError where it has no crown and no
    /// pavilion facet that may change, or its own meets cannot be closed.
    explicit TierDesign(const Solid& solid);

    /// Those that may change: crown and pavilion, in the solid's order.
    const std::vector<FacetTier>& tiers() const { return tiers_; }
    /// Of `tiers`, those that the design's symmetry takes into each other: each set has one angle
    /// to choose. Every tier is in one set.
    const std::vector<std::vector<int>>& tied_tiers() const { return tied_; }
    /// The design itself, its meets closed.
    const Solid& start() const { return start_; }

    /// `steeper`: by tier, radians added to the angle from the horizontal. Nothing where the meets
    /// cannot be kept, or facets would appear, vanish or change their neighbours: every edge keeps
    /// half of its length, or 0.5 % of the diameter where that is less. The girdle stays; corners
    /// lie at their meets. Angles may differ from those wanted where meets tie them.
    std::optional<Solid> with(const std::vector<double>& steeper) const;

private:
    struct Planes;
    Planes wanted(const std::vector<double>& steeper) const;
    std::optional<Planes> closed(Planes planes) const;
    std::optional<Solid> solid_of(const Planes& planes) const;

    void tie_tiers(const std::vector<std::vector<int>>& orbits);
    void put_in_order(std::vector<std::vector<int>> orbits);

    std::vector<FacetTier> tiers_;
    std::vector<std::vector<int>> tied_;
    Solid solid_, start_;
    std::vector<std::vector<int>> facets_at_;  ///< by corner
    /// Orbits of sloping facets, those next to the girdle first.
    std::vector<std::vector<int>> order_;
    std::vector<bool> angle_is_free_, offset_is_free_;
    double size_ = 1;
};

}  // namespace culet
