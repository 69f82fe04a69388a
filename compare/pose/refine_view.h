#pragma once
// From a view that is right to a degree or so to the best one: edges are looked for along the
// wireframe's normals, the view is fitted to them, and the search draws in.

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
    std::vector<WirePoint> points;  ///< at the view that was found
    std::vector<MetEdge> met;       ///< those that were used last
    /// Of the model, as the edges show it (`settle`): one sigma, tilt and offset.
    double facet_error = 0, facet_offset = 0;
    bool lost = false;  ///< too few edges were met, or the view ran away
};

/// Without facets and covariance: fast, for choosing among views.
RefinedView draw_in(const WireSolid& wire, const EdgePicture& picture, const StoneView& start,
                    const RefineSettings& settings);

/// From there on with everything free, and how sure it is. How wrong the model's facets are is
/// found on the way.
RefinedView settle(const WireSolid& wire, const EdgePicture& picture, const RefinedView& start,
                   const RefineSettings& settings);

/// Variances of the view's turn (three axes), place (two) and logarithm of scale as the edges
/// themselves show them: the jackknife (Quenouille 1949, Tukey 1958) over sixteen groups of edges.
/// Edges that were mistaken for the stone's show here, where the covariance believes them.
std::array<double, 6> variances_by_groups(const WireSolid& wire, const RefinedView& refined,
                                          const RefineSettings& settings);

}  // namespace culet
