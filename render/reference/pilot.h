#pragma once
// A glance at the scene before it is rendered: how bright it is, and how many wavelengths it needs.

#include "render/optics/path.h"
#include "render/reference/light_field.h"
#include "render/setup/optical_setup.h"

namespace culet {

/// How far paths are followed: to the scene's depth, and to weights that its tolerance lets go,
/// relative to the mean that a small, shallow picture finds.
PathLimits limits_for(const Scene& scene, const OpticalSetup& setup, const LightField& lights,
                      const WavelengthSet& colours);

/// The plan with the fewest wavelengths whose colours differ from those of the finest set by less
/// than the tolerance, root mean square over some pixels and relative to their mean. Seen on paths
/// of a few faces, which are where the light is.
OpticalSetup setup_for_tolerance(const Scene& scene);

}  // namespace culet
