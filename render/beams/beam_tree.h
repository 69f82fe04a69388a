#pragma once
// The beams of a convex stone: regions of the picture whose rays meet the same facets, in the same
// order (Voelker & Hamann's beam tree, Guy & Soler's facet tree), unfolded (pencil.h).
//
// A beam's polygon is clipped by the facets that its rays meet next, found by walking over edges.
// An edge's line is computed once, from its lower corner to its higher one, and taken with either
// sign by the two facets that share it, so that children tile their parent without an epsilon; an
// edge shared with the facet just left is never clipped by.

#include <cstdint>
#include <functional>
#include <vector>

#include "render/beams/facet_net.h"
#include "render/beams/pencil.h"

namespace culet {

struct BeamLimits {
    int depth = 8;  ///< facets met, the front one included
    /// A beam of less weight (mean of s and p, without absorption, at its middle) is not split
    /// further, nor one whose weight x area, as a share of what the front facets fill, is less.
    double cut_weight = 0, cut_share = 0;
    /// A beam whose map is off by more, in pixels, is halved (astigmatic refraction only).
    double map_error = 0.25;
    /// A beam whose weight x area in square pixels is less is not split either: its middle ray is
    /// followed to the end, and the facets that it meets are taken for those of all its rays. What
    /// each pixel's own ray sees along them is another matter: a sun may fill some of them only.
    double alone = 0;
    /// Where there would be more, `cut_share` is raised until there are not.
    long long most_beams = 1 << 23;
    Refraction refraction = Refraction::astigmatic;
    bool operator==(const BeamLimits&) const = default;
};

/// A beam that is not split further.
struct Beam {
    std::uint32_t corner = 0, facet = 0;      ///< the first of each in its BeamBranch
    std::uint16_t corners = 0, facets = 0;    ///< how many
    bool alone = false;                       ///< the last facets are those of its middle ray
    bool sure = true;                         ///< no border is off by more than 1/4 pixel
    std::int32_t first_row = 0, end_row = 0;  ///< of pixels that it touches
};

/// The beams below one pair of first facets, in the order in which they were found.
struct BeamBranch {
    std::vector<Beam> leaves;
    std::vector<ScreenPoint> corners;   ///< positively oriented in the picture's x and y
    std::vector<std::uint16_t> facets;  ///< met by a leaf, from the front facet on
    long long beams = 0;                ///< leaves and what they were split from
    long long faces = 0;                ///< met by beams that are alone
    double exit_area = 0;               ///< square pixels
    int deepest = 0;
    void clear();
};

struct BeamTree {
    std::vector<BeamBranch> branches;
    std::size_t branch_count = 0;  ///< of `branches`; the rest is kept room
    double front_area = 0;         ///< of the front facets, in square pixels
    long long discarded = 0;       ///< beams that were grown and were too many

    long long beams() const;
    long long faces() const;
    double exit_area() const;
    int deepest() const;  ///< most facets that a beam meets
};

/// A facet that the eye sees, and its outline in the picture, within the picture's borders.
struct FrontFacet {
    int facet = 0;
    std::vector<ScreenPoint> outline;
};
std::vector<FrontFacet> front_facets(const FacetNet& net, const ScreenView& view);

/// Builds into `tree`, whose memory is used again. `n`: index over the outside's, above 1. The eye
/// must be outside. Runs in parallel; the result does not depend on the number of threads.
/// `goes_on`: asked from any thread, now and then, with the number of beams grown so far; false:
/// the tree is left unfinished, and the answer is false.
bool build_beams(const FacetNet& net, const ScreenView& view, double n, const BeamLimits& limits,
                 BeamTree& tree, const std::function<bool(long long)>& goes_on = {});

}  // namespace culet
