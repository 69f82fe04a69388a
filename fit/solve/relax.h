#pragma once
// One stage of the relaxation: the mesh's planes and meeting points move until incidences, readings
// and hinges, each softened as the stage wants it, agree best (weighted least squares by the method
// of Levenberg and Marquardt, Ceres).

#include "fit/solve/relaxation.h"
#include "stone/progress/progress.h"

namespace culet {

struct RelaxOptions {
    bool keep_normals = false;  ///< facets move along their normals, and do not tilt
    int most_steps = 40;
};

/// The shape at the end; how many steps it took is added to `steps`. The readings mean at all of
/// them what `relaxation` has chosen last. Throws Interrupted when progress says so.
Shape relax(const Relaxation& relaxation, const Shape& shape, const PenaltyScale& penalty,
            const RelaxOptions& options, const Progress& progress, double fraction, int& steps);

}  // namespace culet
