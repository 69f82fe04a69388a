#pragma once
// The turns about up and the mirrorings through it under which a stone looks more or less like
// itself: candidates from who meets whom (stone/solid/automorphisms.h), told apart by geometry.

#include <string>
#include <vector>

#include "stone/solid/automorphisms.h"
#include "stone/solid/solid.h"

namespace culet {

/// An automorphism as a motion about +z: a turn by `turn`, or a mirroring that takes azimuth a to
/// `turn` - a.
struct AxisMotion {
    Automorphism map;
    double turn = 0;  ///< radians; the one that fits the points best (Kabsch 1976, about one axis)
    double misfit = 0;  ///< root mean square distance of moved points from where they should be
};

/// All automorphisms as motions about +z. Those that turn the axis over have a large misfit.
std::vector<AxisMotion> motions_about_z(const std::vector<Automorphism>& all,
                                        const std::vector<Vec3>& points);

/// Cn (n = `order`) or Cnv about +z.
struct AxisGroup {
    int order = 1;
    bool mirrors = false;
    /// Of mirrorings: azimuth a goes to 2 `plane` - a (then in steps of a full turn / order).
    double plane = 0;
    struct Element {
        std::vector<int> facets;
        int steps = 0;  ///< of a full turn / order
        bool mirrored = false;
    };
    std::vector<Element> elements;  ///< the identity first

    bool is_trivial() const { return order == 1 && !mirrors; }
    /// C8, C8v; Cs for a single mirror.
    std::string name() const;
};

/// The largest group of motions with a misfit up to `largest_misfit` (in the points' unit).
AxisGroup largest_group(const std::vector<AxisMotion>& motions, double largest_misfit);

/// All subgroups but the trivial one, the largest first; the group itself included. Subgroups that
/// a turn of the whole takes into each other stand side by side (C4v has two in C8v).
std::vector<AxisGroup> subgroups_of(const AxisGroup& group);

/// Orbits of its facets: members with the element that takes the first one there.
struct FacetOrbit {
    std::vector<int> facets;
    std::vector<AxisGroup::Element> from_first;  ///< one for each
    /// Index of a mirroring that leaves the first facet in its place, or -1.
    int own_mirror = -1;
    AxisGroup::Element mirror;
    bool stays = false;  ///< a single facet that all turns leave in its place, order > 1: level
};
std::vector<FacetOrbit> orbits_of(const AxisGroup& group, std::size_t facets);

}  // namespace culet
