#pragma once
// Draws a convex stone by its beams.

#include <memory>

#include "render/beams/beam_tree.h"
#include "render/beams/strip_painter.h"
#include "render/image/picture.h"
#include "render/setup/optical_setup.h"
#include "stone/progress/progress.h"

namespace culet {

struct BeamSettings {
    BeamLimits limits;
    BeamShading shading = BeamShading::averaged;
    CrystalBeams crystal = CrystalBeams::merged;
    int threads = 0;
};

/// Statistics of one picture. Weights are means over the stone's area and over wavelengths.
struct BeamReport {
    long long beams = 0, fragments = 0;
    long long retraced = 0;  ///< rays that did not meet their beam's facets and were traced again
    double filled = 0;       ///< square pixels of the stone
    double remainder = 0, absorbed = 0, luminance = 0;
    double lost_area = 0;  ///< area that no beam covers, over the front facets' area
    int deepest = 0;
    double seconds_build = 0, seconds_shade = 0;
};

class BeamRenderer {
public:
    explicit BeamRenderer(const Solid& convex);
    ~BeamRenderer();

    /// Draws into `picture`, reusing its memory. Keeps the beams while view, indices and limits
    /// stay the same. Throws InputError for a conoscope, and Interrupted.
    void draw(const Scene& scene, const OpticalSetup& setup, const WavelengthSet& colours,
              const BeamSettings& settings, Picture& picture, const Progress& progress = {});
    const BeamReport& report() const;

private:
    struct Work;
    std::unique_ptr<Work> work_;
};

}  // namespace culet
