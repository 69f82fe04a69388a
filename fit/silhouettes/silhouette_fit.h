#pragma once
// Fits a mesh to outlines, and gives the fit their information on the planes, to be weighed with
// other readings.

#include <memory>
#include <string>
#include <vector>

#include "fit/planes/plane_observations.h"
#include "fit/silhouettes/silhouette.h"
#include "stone/stone.h"

namespace culet {

/// Plane observations from outlines; the rows' values are zero. Motions are left out if outlines do
/// not determine them or the frame of the fit fixes them. The rows cover all planes: those that the
/// outlines do not show are held near the mesh's, within degrees and per cent.
struct OutlineKnowledge : PlaneObservations {
    std::vector<FrameMotion> motions;  ///< of the sets, to the stone's frame
    std::vector<double> sigmas;        ///< of the sets, across the outline
    std::vector<bool> estimated;       ///< of the sets: sigma comes from the residuals
    double chi2 = 0, dof = 0;          ///< of the sets with a stated sigma
};

struct SilhouetteFit {
    /// The mesh in its own place, with its facets and size from the outlines. Facets that only
    /// outlines show come last, named after the nearest of the mesh. The corners are those that the
    /// planes enclose.
    Stone stone;
    std::shared_ptr<const OutlineKnowledge> knowledge;
    std::vector<std::string> notes;
};

/// Finds the convex stone that all sets show together. Throws InputError if the stone need not be
/// convex, or if the outlines enclose none.
SilhouetteFit fit_silhouettes(const Stone& mesh,
                              const std::vector<std::shared_ptr<const SilhouetteSet>>& sets);

/// Compares `contours` with a solid, after placing the solid so that it agrees best with `fitted`,
/// starting at `motion`.
SilhouetteMisfit silhouette_misfit(const Solid& solid, const std::vector<Contour>& fitted,
                                   const std::vector<Contour>& contours, const FrameMotion& motion);

}  // namespace culet
