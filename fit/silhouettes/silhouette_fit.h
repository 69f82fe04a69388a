#pragma once
// From a mesh and outlines to the stone that the outlines show, and what they tell of its planes,
// for the fit to weigh against other readings.

#include <memory>
#include <string>
#include <vector>

#include "fit/planes/plane_observations.h"
#include "fit/silhouettes/silhouette.h"
#include "stone/stone.h"

namespace culet {

/// What outlines tell of a stone's planes; the rows' values are zero. Motions that outlines know
/// nothing of, or that the frame of the fit holds, are left out of it. Planes that the outlines do
/// not tell of are held to the mesh's within degrees and per cents: the rows hold all of them.
struct OutlineKnowledge : PlaneObservations {
    std::vector<FrameMotion> motions;  ///< of the sets, to the stone's frame
    std::vector<double> sigmas;        ///< of the sets, across the outline
    std::vector<bool> estimated;       ///< sigma comes from the residuals
    double chi2 = 0, dof = 0;          ///< of the sets whose sigma is stated
};

struct SilhouetteFit {
    /// The mesh with its facets where the outlines have them, in its own place and at their size;
    /// facets that only outlines show come last, named after the nearest of the mesh. Its corners
    /// are those that the planes enclose.
    Stone stone;
    std::shared_ptr<const OutlineKnowledge> knowledge;
    std::vector<std::string> notes;
};

/// The convex stone that all sets show together. Throws InputError when the stone need not be
/// convex, or the outlines enclose none.
SilhouetteFit fit_silhouettes(const Stone& mesh,
                              const std::vector<std::shared_ptr<const SilhouetteSet>>& sets);

/// How far outlines lie from a solid, in the place in which it suits `fitted` best, near `motion`;
/// `contours` are held against it there.
SilhouetteMisfit silhouette_misfit(const Solid& solid, const std::vector<Contour>& fitted,
                                   const std::vector<Contour>& contours, const FrameMotion& motion);

}  // namespace culet
