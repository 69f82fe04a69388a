#pragma once
// Which facets make this flash: the light paths behind one ray.

#include <string>
#include <vector>

#include "render/optics/stokes.h"
#include "render/scene/scene.h"
#include "render/setup/optical_setup.h"
#include "stone/progress/progress.h"

namespace culet {

struct ProbedPath {
    std::vector<std::string> facets;  ///< in the order that the eye ray meets them
    std::string modes;                ///< of each segment between them (PathTrace)
    std::vector<double> weight;  ///< per wavelength; 0 where this wavelength takes another path
    /// At the eye, of unpolarised light of radiance 1 that comes this way: mean over wavelengths,
    /// in the eye's frame (x to the right of the picture).
    Stokes stokes{};
    Vec3 exit_direction{0, 0, 0};
    std::string light;  ///< what it sees
};

struct ProbeResult {
    std::vector<double> wavelengths_nm, radiance;
    std::vector<ProbedPath> paths;                 ///< heaviest first
    std::vector<double> remainder, absorbed, cut;  ///< per wavelength
    int depth = 0;
    bool hit = false;
    /// Of the light that reaches the eye along this ray, mean over wavelengths.
    Stokes stokes{};
    /// Standard error of the mean radiance from paths chosen at random; 0: none were.
    double standard_error = 0;
    /// Largest |sum of powers - 1| met at a crystal's face before it was put right.
    double worst_imbalance = 0;
    bool sampled = false;  ///< a crystal's tree grew too large: from there on one wave was followed
};

/// Here `tolerance` of the scene's settings is a weight: paths below it are cut. Depth as in the
/// settings (0: 1000). Throws InputError (a ray that starts inside the stone, and as `render`) and
/// Interrupted.
ProbeResult probe(const Scene& scene, const EyeRay& ray, const Progress& progress = {});

/// The ellipse that light's field runs through. Angles in radians.
struct PolarisationEllipse {
    double degree = 0;       ///< polarised share, 0..1
    double azimuth = 0;      ///< of the long axis, from x counter-clockwise, in [0, pi)
    double ellipticity = 0;  ///< atan of short over long axis; > 0 right-handed
};
PolarisationEllipse ellipse_of(const Stokes& stokes);

std::string probe_json(const ProbeResult& result);

}  // namespace culet
