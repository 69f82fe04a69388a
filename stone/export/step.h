#pragma once
// Stones for CAD: STEP (ISO 10303-21) after application protocol 214, automotive design.

#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct StepFile {
    std::string text;
    double uncertainty_mm = 0;  ///< stated in the file: no corner is farther off its faces
    std::vector<std::string> notes;
};

/// One manifold solid with plane faces: each facet is an ADVANCED_FACE of the facet's name, each
/// edge is shared by two of them, lengths are millimetres and taken as they are. The same solid
/// gives the same bytes.
///
/// Facets whose corners lie more than 1e-5 mm off their planes become triangles of that name, which
/// a note says; see `planar_solid` for convex stones. Throws InputError for a solid that is not one
/// closed body.
StepFile step_text(const Solid& solid_mm, const std::string& name);

}  // namespace culet
