#pragma once
// Fits the view and the facets' errors to the met edges: robust least squares (Ceres).

#include <array>
#include <vector>

#include "compare/pose/moved_edge.h"

namespace culet {

/// An edge of the photograph for the wireframe's edge at `point`.
struct MetEdge {
    WirePoint point;
    double offset = 0;  ///< along the point's normal, pixels
    double sigma = 1;   ///< of `offset`
};

struct SolverSettings {
    bool facets_free = false;
    /// Prior sigmas of the facets' errors: angle to the true facet, and distance of its plane from
    /// the facet's middle.
    double facet_error = 0.0035, facet_offset = 0;
    double focal_error = 0;            ///< relative, of the start's focal length; 0: fixed
    double principal_point_error = 0;  ///< pixels; 0: fixed
    bool with_covariance = false;
};

struct SolvedView {
    StoneView view;
    std::vector<FacetChange> facets;  ///< one for each facet of the solid, zero where fixed
    /// Of `ViewChange` at `view`, row by row; zero where fixed. Only on request.
    std::vector<double> covariance;
    /// In sigmas, one for each edge.
    std::vector<double> residuals;
    /// Estimated from the edges, slightly shrunk to the prior. Only with the covariance.
    double facet_error = 0, facet_offset = 0;
    int tilts_found = 0;  ///< tilts that the edges determine: the source of `facet_error`
    bool converged = false;
};

/// `prior_focal_px`: 0 for orthographic views. `sight`: prior principal point.
SolvedView solve_view(const WireSolid& wire, const StoneView& start,
                      const std::vector<MetEdge>& edges, double prior_focal_px,
                      const PicturePoint& sight, const SolverSettings& settings);

}  // namespace culet
