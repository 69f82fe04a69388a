#pragma once
// Writes stones for CAD: STEP (ISO 10303-21), application protocol 214 (automotive design).

#include <string>
#include <vector>

#include "stone/solid/solid.h"

namespace culet {

struct StepFile {
    std::string text;
    double uncertainty_mm = 0;  ///< as stated in the file: no corner is farther off its faces
    std::vector<std::string> notes;
};

/// One manifold solid with plane faces: each facet is an ADVANCED_FACE with its name, each edge is
/// shared by two. Lengths are mm, unchanged. The same solid gives the same bytes.
///
/// Facets with corners more than 1e-5 mm off their planes become triangles of the same name, with a
/// note (see `planar_solid`). Throws InputError unless the solid is one closed body.
StepFile step_text(const Solid& solid_mm, const std::string& name);

}  // namespace culet
