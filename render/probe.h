#pragma once
// Which facets make this flash: the light paths behind one ray.

#include <string>
#include <vector>

#include "render/plan.h"
#include "render/scene.h"
#include "stone/progress.h"

namespace culet {

struct ProbedPath {
    std::vector<std::string> facets;  ///< in the order that the eye ray meets them
    std::string modes;                ///< of each inner segment: i isotropic, o, e
    std::vector<double> weight;  ///< per wavelength; 0 where this wavelength takes another path
    Vec3 exit_direction{0, 0, 0};
    std::string light;  ///< what it sees
};

struct ProbeResult {
    std::vector<double> wavelengths_nm, radiance;
    std::vector<ProbedPath> paths;                 ///< heaviest first
    std::vector<double> remainder, absorbed, cut;  ///< per wavelength
    int depth = 0;
    bool hit = false;
    bool sampled = false;  ///< a crystal's tree grew too large: from there on one wave was followed
};

/// Here `tolerance` of the scene's settings is a weight: paths below it are cut. Depth as in the
/// settings (0: 64). Throws InputError (a ray that starts inside the stone, and as `render`) and
/// Interrupted.
ProbeResult probe(const Scene& scene, const EyeRay& ray, const Progress& progress = {});

std::string probe_json(const ProbeResult& result);

}  // namespace culet
