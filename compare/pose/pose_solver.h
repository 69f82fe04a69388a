#pragma once
// The view and the facets' small errors that best explain where edges were met: least squares with
// a robust loss (Ceres).

#include <array>
#include <vector>

#include "compare/pose/moved_edge.h"

namespace culet {

/// An edge of the photograph taken for the wireframe's edge at `point`.
struct MetEdge {
    WirePoint point;
    double offset = 0;  ///< along the point's normal, pixels
    double sigma = 1;   ///< of it
};

struct SolverSettings {
    bool facets_free = false;
    /// Expected of the facets, one sigma: angle to the true facet, and distance of its plane from
    /// the facet's middle. Free facets are held by them.
    double facet_error = 0.0035, facet_offset = 0;
    double focal_error = 0;            ///< relative, of the start's focal length; 0: held
    double principal_point_error = 0;  ///< pixels; 0: held
    bool with_covariance = false;
};

struct SolvedView {
    StoneView view;
    std::vector<FacetChange> facets;  ///< one a facet of the solid, zero where not free
    /// Of `ViewChange` at `view`, rows one after the other; zero where held. Empty unless asked
    /// for.
    std::vector<double> covariance;
    /// Residuals over their sigmas, as many as there were edges.
    std::vector<double> residuals;
    /// The expected errors as the edges show them, drawn a little towards what was expected. With
    /// the covariance only.
    double facet_error = 0, facet_offset = 0;
    int tilts_found = 0;  ///< tilts that the edges could find: what `facet_error` is from
    bool converged = false;
};

/// `prior_focal_px`: 0 for orthographic views. `sight`: the principal point that is expected.
SolvedView solve_view(const WireSolid& wire, const StoneView& start,
                      const std::vector<MetEdge>& edges, double prior_focal_px,
                      const PicturePoint& sight, const SolverSettings& settings);

}  // namespace culet
