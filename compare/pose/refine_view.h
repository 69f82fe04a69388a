#pragma once
// Refines a view that is right to about a degree: searches edges along the wireframe's normals,
// fits the view, and repeats with a narrower search.

#include "compare/pose/edge_search.h"
#include "compare/pose/pose_solver.h"

namespace culet {

struct RefineSettings {
    double prior_focal_px = 0;
    PicturePoint sight;
    double facet_error = 0.0035;
    double focal_error = 0.2, principal_point_error = 0;
    double diameter_px = 0;
};

struct RefinedView {
    SolvedView solved;
    std::vector<WirePoint> points;  ///< at the found view
    std::vector<MetEdge> met;       ///< those used last
    /// Facet errors estimated by `refine_fully`, one sigma: tilt and offset.
    double facet_error = 0, facet_offset = 0;
    bool lost = false;  ///< too few edges were met, or the view diverged
};

/// Fast, for choosing among views: the facets stay fixed, without covariance.
RefinedView refine_roughly(const WireSolid& wire, const EdgePicture& picture,
                           const StoneView& start, const RefineSettings& settings);

/// Continues from `refine_roughly` with all parameters free, estimates the facet errors, and
/// computes the covariance.
RefinedView refine_fully(const WireSolid& wire, const EdgePicture& picture,
                         const RefinedView& start, const RefineSettings& settings);

/// Jackknife variances (Quenouille 1949, Tukey 1958) over sixteen groups of edges: of the view's
/// rotation (three axes), place (two) and logarithm of scale. They include mistaken edges, which
/// the covariance ignores.
std::array<double, 6> variances_by_groups(const WireSolid& wire, const RefinedView& refined,
                                          const RefineSettings& settings);

}  // namespace culet
