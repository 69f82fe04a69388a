#pragma once
// The turns about up and mirrorings through it under which a stone looks nearly the same.
// Candidates come from the combinatorics (stone/solid/automorphisms.h); geometry selects.

#include <string>
#include <vector>

#include "stone/solid/automorphisms.h"
#include "stone/solid/solid.h"

namespace culet {

/// An automorphism as a motion about +z: a turn by `turn`, or a mirroring of azimuth a to `turn` -
/// a.
struct AxisMotion {
    Automorphism map;
    double turn = 0;    ///< radians; best fit to the points (Kabsch 1976, about one axis)
    double misfit = 0;  ///< rms distance of the moved points from their images
};

/// Those that turn the axis over get a large misfit.
std::vector<AxisMotion> motions_about_z(const std::vector<Automorphism>& all,
                                        const std::vector<Vec3>& points);

/// Cn (n = `order`) or Cnv about +z.
struct AxisGroup {
    int order = 1;
    bool mirrors = false;
    /// Mirrorings take azimuth a to 2 `plane` - a, followed by turns of full turn / order.
    double plane = 0;
    struct Element {
        std::vector<int> facets;
        int steps = 0;  ///< turn in units of full turn / order
        bool mirrored = false;
    };
    std::vector<Element> elements;  ///< the identity first

    bool is_trivial() const { return order == 1 && !mirrors; }
    /// C8, C8v, ...; Cs for a single mirror.
    std::string name() const;
};

/// The largest group of motions with misfits up to `largest_misfit` (in the points' unit).
AxisGroup largest_group(const std::vector<AxisMotion>& motions, double largest_misfit);

/// Excludes the trivial one; the group itself comes first, then smaller ones. Conjugate subgroups
/// are listed separately (C8v contains C4v twice).
std::vector<AxisGroup> subgroups_of(const AxisGroup& group);

struct FacetOrbit {
    std::vector<int> facets;
    std::vector<AxisGroup::Element> from_first;  ///< takes the first facet to each member
    /// Index of a mirroring that keeps the first facet in place, or -1.
    int own_mirror = -1;
    AxisGroup::Element mirror;
    bool stays = false;  ///< a single facet that all turns keep in place (order > 1), so it is
                         ///< level
};
std::vector<FacetOrbit> orbits_of(const AxisGroup& group, std::size_t facets);

}  // namespace culet
