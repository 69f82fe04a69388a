#pragma once
// The early stages: graded least squares (Ceres) from a rough start. Incidences, exact readings and
// the readings themselves begin soft and are tightened stage by stage, so that a bad start can
// still change its mind; hinges keep the stone convex on the way.

#include "fit/system.h"
#include "stone/progress.h"

namespace culet {

struct Graded {
    Shape shape;
    bool convex = false;  ///< no corner stands above a neighbour facet
};

struct GradedStart {
    Shape shape;
    /// The first stage leaves normals as they are: the start trusts the angles that were read.
    bool keep_normals_at_first = false;
};

/// Throws Interrupted when progress says so. Uses one thread, so that results repeat.
Graded graded_fit(const System& system, const GradedStart& start, const Progress& progress = {});

/// The mesh with the inclinations and azimuths that were read put in place of its own.
GradedStart start_from_angles(const System& system);

}  // namespace culet
