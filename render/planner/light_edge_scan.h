#pragma once
// Finds where the edge of a bright light may be seen at some wavelength, which a check of few
// pixels must not miss.
//
// A small bright light shows in few pixels, in others at each wavelength, and a picture of few
// wavelengths may lack an image without any trace. So each bright light is replaced by a rim along
// its edges, as wide as the dispersion of one path, and drawn at two wavelengths by beams, which
// miss no region. Where most shows, narrower rims, as wide as a cell of a few pixels, are drawn at
// many wavelengths.

#include <vector>

#include "render/beams/frame_renderer.h"
#include "render/engine/render_result.h"
#include "render/planner/pilot_picture.h"
#include "render/scene/scene.h"

namespace culet {

/// Radiance of lights that a picture may lack.
struct Brightness {
    double least = 0;  ///< threshold above which lights count
    double most = 0;   ///< the brightest light's
    /// True if paths of a hundredth of the weight suffice to show the light.
    bool sun() const { return most > 100 * least; }
};

/// Rims of the lights that reach the radiance `least` at some wavelength: their radiance within
/// `width` (radians from the stone) of the edge on both sides. Maps give the brightest texel in
/// cells about 6 degrees wide, lobes become wider lobes, lights without edges are omitted.
Lights light_rims(const Lights& lights, const Vec3& stone, double width, double least);

class LightEdgeScan {
public:
    /// For bright lights only: edges of others may show in every pixel. Traces unpolarised,
    /// unabsorbed light along one path. `frames`: a renderer of this stone, to save its
    /// preparation; afterwards it shows other lights in larger pixels. `progress` receives 0 and
    /// may stop it: Interrupted.
    LightEdgeScan(const Scene& scene, const Brightness& bright, const Progress& progress,
                  FrameRenderer* frames = nullptr);

    /// Radiance that a light's edge may add in the cell of a pixel or in its neighbours; 0: none.
    double near(int x, int y) const;

private:
    void spread(const StonePixels& at, const std::vector<double>& seen, double step, int rows);

    int columns_ = 0;
    double side_ = 1;           // of a cell, in pixels
    std::vector<float> cells_;  // row by row
};

}  // namespace culet
