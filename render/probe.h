#pragma once
// Which facets make this flash: the light paths behind one ray.

#include <string>
#include <vector>

#include "render/plan.h"
#include "render/scene.h"

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
};

/// `tolerance` of the scene's settings cuts weights below it; depth as in the settings (0: 64).
ProbeResult probe(const Scene& scene, const EyeRay& ray);

std::string probe_json(const ProbeResult& result);

}  // namespace culet
