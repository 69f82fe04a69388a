#pragma once
// One stage of the relaxation. Moves the mesh's planes and points until incidences, readings and
// hinges agree best, each softened as the stage says (weighted least squares by
// Levenberg-Marquardt, Ceres).

#include "fit/solve/relaxation.h"
#include "stone/progress/progress.h"

namespace culet {

struct RelaxOptions {
    bool keep_normals = false;  ///< facets move along their normals and do not tilt
    int most_steps = 40;
};

/// Returns the shape at the end and adds the steps taken to `steps`. The readings' active branches
/// stay as `relaxation` has last chosen them. Throws Interrupted when progress says so.
Shape relax(const Relaxation& relaxation, const Shape& shape, const PenaltyScale& penalty,
            const RelaxOptions& options, const Progress& progress, double fraction, int& steps);

}  // namespace culet
