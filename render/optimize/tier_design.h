#pragma once
// A cut whose tiers change their angles while its meets are kept: every facet keeps its azimuth
// (index setting), and four or more facets that meet in a corner of the design still meet.
//
// The unknowns are every facet's angle and offset; girdle facets are fixed, and level ones keep
// their angle. First each facet turns to its wanted angle about its corners next to the girdle, and
// the table follows the facets around it. Then Gauss-Newton steps of minimum norm remove the meets'
// misses, which gives the nearest angles and offsets at which all meets hold. Facets related by the
// design's symmetry about +z change alike (stone/design/drawn_symmetry.h).

#include <optional>
#include <vector>

#include "stone/design/tiers.h"
#include "stone/solid/solid.h"

namespace culet {

/// Mean angle from the horizontal of a tier's facets in `solid`, radians.
double mean_angle(const Solid& solid, const FacetTier& tier);

class TierDesign {
public:
    /// `solid`: closed and convex, table up (+z). Throws InputError if no crown or pavilion facet
    /// can change, or if its own meets cannot be closed.
    explicit TierDesign(const Solid& solid);

    /// The tiers that can change: crown and pavilion, in the solid's order.
    const std::vector<FacetTier>& tiers() const { return tiers_; }
    /// Sets of `tiers` that the design's symmetry relates; each set has one free angle. Every tier
    /// is in one set.
    const std::vector<std::vector<int>>& tied_tiers() const { return tied_; }
    /// The design with its meets closed.
    const Solid& start() const { return start_; }

    /// `steeper`: per tier, radians added to the angle from the horizontal. Nothing if the meets
    /// cannot be kept, or if facets would appear, vanish or change neighbours: every edge keeps
    /// half of its length, or 0.5 % of the diameter if that is less. The girdle stays, and corners
    /// lie at their meets. Meets may tie angles, which then differ from the wanted ones.
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
    std::vector<std::vector<int>> facets_at_;  ///< per corner
    /// Symmetry orbits of sloping facets, those next to the girdle first.
    std::vector<std::vector<int>> order_;
    std::vector<bool> angle_is_free_, offset_is_free_;
    double size_ = 1;
};

}  // namespace culet
