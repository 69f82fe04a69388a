#pragma once
// The beams of a convex stone: regions of the picture whose rays meet the same facets in the same
// order (Voelker & Hamann's beam tree, Guy & Soler's facet tree), unfolded: the stone is mirrored
// instead of the ray (pencil.h).
//
// A beam's polygon is clipped by the facets that its rays meet next, found by walking over edges.
// Each edge's line is computed once, from its lower to its higher corner, and used with either sign
// by its two facets, so that children tile their parent without an epsilon. Edges of the facet just
// left never clip.

#include <cstdint>
#include <functional>
#include <vector>

#include "render/beams/facet_net.h"
#include "render/beams/pencil.h"

namespace culet {

struct BeamLimits {
    int depth = 8;  ///< facets met, the front one included
    /// Beams of less weight (mean of s and p at the middle, without absorption) are not split
    /// further; nor beams whose weight x area, as a share of the front facets' area, is less than
    /// cut_share.
    double cut_weight = 0, cut_share = 0;
    /// A beam whose map is off by more, in pixels, is halved (astigmatic refraction only).
    double map_error = 0.25;
    /// Beams of less weight x area, in square pixels, are not split either: the middle ray's facets
    /// are used for all of their rays. Each pixel's own ray is still shaded, because a small light
    /// may fill only some.
    double middle_ray_area = 0;
    /// Beyond this number, `cut_share` is raised until there are no more.
    long long most_beams = 1 << 23;
    Refraction refraction = Refraction::astigmatic;
    bool operator==(const BeamLimits&) const = default;
};

/// A beam that is not split further.
struct Beam {
    std::uint32_t corner = 0, facet = 0;      ///< index of the first of each in its BeamBranch
    std::uint16_t corners = 0, facets = 0;    ///< how many
    bool follows_middle_ray = false;          ///< the last facets are those of its middle ray
    bool sure = true;                         ///< no border is off by more than 1/4 pixel
    std::int32_t first_row = 0, end_row = 0;  ///< of pixels that it touches
};

/// The beams below one pair of first facets, in the order found.
struct BeamBranch {
    std::vector<Beam> beams;
    std::vector<ScreenPoint> corners;   ///< positively oriented in the picture's x and y
    std::vector<std::uint16_t> facets;  ///< facets that a beam meets, from the front facet on
    long long grown = 0;                ///< beams and those they were split from
    long long faces = 0;                ///< met by beams that follow their middle ray alone
    double exit_area = 0;               ///< square pixels
    int deepest = 0;
    void clear();
};

struct BeamTree {
    std::vector<BeamBranch> branches;
    std::size_t branch_count = 0;  ///< branches in use; the rest is spare memory
    double front_area = 0;         ///< of the front facets, in square pixels
    long long discarded = 0;       ///< beams grown and given up because there were too many

    long long grown() const;
    long long faces() const;
    double exit_area() const;
    int deepest() const;  ///< most facets that a beam meets
};

/// A facet visible to the eye, with its outline clipped to the picture.
struct FrontFacet {
    int facet = 0;
    std::vector<ScreenPoint> outline;
};
std::vector<FrontFacet> front_facets(const FacetNet& net, const ScreenView& view);

/// Builds into `tree`, reusing its memory. `n`: index relative to the outside, above 1. The eye
/// must be outside. The result does not depend on the number of threads. `goes_on` is asked from
/// any thread with the number of beams so far; false leaves the tree unfinished and is returned.
bool build_beams(const FacetNet& net, const ScreenView& view, double n, const BeamLimits& limits,
                 BeamTree& tree, const std::function<bool(long long)>& goes_on = {});

}  // namespace culet
