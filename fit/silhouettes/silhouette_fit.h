#pragma once
// Fits a mesh to outlines, and derives what they tell the fit of its planes.

#include <memory>
#include <string>
#include <vector>

#include "fit/planes/plane_observations.h"
#include "fit/silhouettes/silhouette.h"
#include "stone/stone.h"

namespace culet {

/// Plane observations from outlines; the rows' values are zero. Left out are motions that outlines
/// do not determine or that the fit's frame fixes. Planes that no outline shows are held near the
/// mesh's, within degrees and per cent.
struct OutlineObservations : PlaneObservations {
    std::vector<FrameMotion> motions;  ///< of the sets, to the stone's frame
    std::vector<double> sigmas;        ///< of the sets, across the outline
    std::vector<bool> estimated;       ///< of the sets: sigma comes from the residuals
    double chi2 = 0, dof = 0;          ///< of the sets with a stated sigma
};

struct SilhouetteFit {
    /// The mesh in its place, with facets and size from the outlines. Facets that only outlines
    /// show come last, named after the nearest of the mesh. Corners are those that the planes
    /// enclose.
    Stone stone;
    std::shared_ptr<const OutlineObservations> observations;
    std::vector<std::string> notes;
};

/// The convex stone that all sets show together. Throws InputError if it need not be convex, or if
/// the outlines enclose none.
SilhouetteFit fit_silhouettes(const Stone& mesh,
                              const std::vector<std::shared_ptr<const SilhouetteSet>>& sets);

/// Distances of `contours` from a solid, placed where it agrees best with `fitted`, near `motion`.
SilhouetteMisfit silhouette_misfit(const Solid& solid, const std::vector<Contour>& fitted,
                                   const std::vector<Contour>& contours, const FrameMotion& motion);

}  // namespace culet
