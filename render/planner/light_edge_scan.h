#pragma once
// Finds where in a picture the edge of a bright light may be seen at some wavelength, which a check
// of few pixels must not miss.
//
// A small bright light shows in few pixels, and in other ones at each wavelength. A picture with
// few wavelengths may lack one of its images without any trace. So every bright light is replaced
// by a rim along its edges, as wide as the dispersion of one path, and drawn by beams at two
// wavelengths; beams miss no region, however small. Where most shows, the scan is refined with
// narrower rims, as wide as a cell of a few pixels, at many wavelengths.

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

/// Rims of the lights whose radiance reaches `least` at some wavelength: their radiance within
/// `width` of the edge on both sides (radians, seen from the stone). A map gives the brightest
/// texel in cells about 6 degrees wide, lobes become wider lobes, lights without an edge are left
/// out.
Lights light_rims(const Lights& lights, const Vec3& stone, double width, double least);

class LightEdgeScan {
public:
    /// For bright lights only: edges of others may show in every pixel. Light is traced
    /// unpolarised, unabsorbed and along one path through the stone. `frames`: a renderer of this
    /// stone, used to save its preparation; it afterwards shows other lights in larger pixels.
    /// `progress` receives 0 and may stop it: Interrupted.
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
