#pragma once
// Lists the light paths behind one ray: which facets make a flash.

#include <string>
#include <vector>

#include "render/optics/stokes.h"
#include "render/scene/scene.h"
#include "render/setup/optical_setup.h"
#include "stone/progress/progress.h"

namespace culet {

struct ProbedPath {
    std::vector<std::string> facets;  ///< in the order in which the eye ray hits them
    std::string modes;                ///< of each segment between them (PathTrace)
    std::vector<double> weight;       ///< per wavelength; 0 if this wavelength takes another path
    /// At the eye, for unpolarised light of radiance 1 along this path: mean over wavelengths, in
    /// the eye's frame (x to the picture's right).
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
    /// Stokes parameters of the light that reaches the eye, mean over wavelengths.
    Stokes stokes{};
    /// Standard error of the mean radiance from random choices; 0 without any.
    double standard_error = 0;
    /// Largest |sum of powers - 1| at a crystal's face, which is then normalised.
    double worst_imbalance = 0;
    bool sampled = false;  ///< a crystal's tree grew too large, so only one wave was followed from
                           ///< there
};

/// The scene's `tolerance` is the weight below which paths are cut here. Depth 0 means 1000. Throws
/// InputError (for a ray that starts inside the stone, or like `render`) and Interrupted.
ProbeResult probe(const Scene& scene, const EyeRay& ray, const Progress& progress = {});

/// Polarisation ellipse of light. Angles in radians.
struct PolarisationEllipse {
    double degree = 0;       ///< polarised part, 0..1
    double azimuth = 0;      ///< of the long axis, from x counter-clockwise, in [0, pi)
    double ellipticity = 0;  ///< atan of short over long axis; > 0 right-handed
};
PolarisationEllipse ellipse_of(const Stokes& stokes);

std::string probe_json(const ProbeResult& result);

}  // namespace culet
