#pragma once
// Facets that a cut repeats about its axis.

#include <optional>
#include <vector>

#include "fit/silhouettes/plane_condition.h"
#include "stone/solid/solid.h"

namespace culet {

/// Cn, with mirrors Cnv, about the stone's axis; most cuts look the same after half a turn.
struct CutSymmetry {
    int order = 2;
    bool mirrors = false;
};

/// Of an upright cut; nothing if it repeats no facet about its axis.
std::optional<CutSymmetry> symmetry_of(const Solid& cut);

struct RepeatedFacets {
    /// The facets that are shown, then copies of them where the cut repeats them and no facet is
    /// shown; a copy's name is that of its original and the number of its place.
    std::vector<NamedPlane> planes;
    std::vector<bool> is_copy;  ///< by plane
    /// How alike they are, in the solid's frame.
    std::vector<PlaneCondition> conditions;
    /// By how much such facets differ, one sigma, beyond their own uncertainty: radians, and a
    /// length.
    double tilt_sigma = 0, offset_sigma = 0;
    int pairs = 0;  ///< shown facets with a shown partner
};

/// `solid`: upright, its axis within some degrees of z. The axis' direction and place, and the
/// mirrors' azimuth, are those that most `shown` facets agree on. Nothing if fewer than
/// `k_least_pairs` have partners.
std::optional<RepeatedFacets> repeated_facets(const Solid& solid,
                                              const std::vector<double>& tilt_sigmas,
                                              const std::vector<bool>& shown,
                                              const CutSymmetry& symmetry);

inline constexpr int k_least_pairs = 12;

}  // namespace culet
