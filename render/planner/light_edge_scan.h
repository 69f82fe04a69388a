#pragma once
// Where in the picture the edge of a bright light may be seen at some wavelength: what a check of
// few pixels must not miss.
//
// A small bright light is seen in few pixels, and at each wavelength in others: a picture of few
// wavelengths may lack one of its images altogether, and nothing in it tells. So every bright light
// is widened to a rim about its edges, as wide as the colours of one path leave apart, and seen by
// beams at two wavelengths, in which no region is too small to be met. Where it shows most, rims as
// wide as a cell of few pixels at each of many wavelengths tell what is there.

#include <vector>

#include "render/beams/frame_renderer.h"
#include "render/engine/render_result.h"
#include "render/planner/pilot_picture.h"
#include "render/scene/scene.h"

namespace culet {

/// Radiance of lights that a picture may lack.
struct Brightness {
    double least = 0;  ///< from which on they count
    double most = 0;   ///< the brightest light's
    /// A path of a hundredth of the weight is enough to show it.
    bool sun() const { return most > 100 * least; }
};

/// The rims of those lights that have the radiance `least` at some wavelength: radiance of each
/// within `width` (radians, as seen from the stone) of its edge, on both sides; of a map, the
/// brightest texel of cells some 6 degrees wide; of lobes, wider ones. What has no edge is left
/// out.
Lights light_rims(const Lights& lights, const Vec3& stone, double width, double least);

class LightEdgeScan {
public:
    /// Of bright lights alone: of others every pixel may see an edge. As light has one way through
    /// the stone, unpolarised and not absorbed. `progress` is told 0, and may stop it: Interrupted.
    /// `frames`: of this stone, to save making ready what beams need of it; shows other lights in
    /// larger pixels then.
    LightEdgeScan(const Scene& scene, const Brightness& bright, const Progress& progress,
                  FrameRenderer* frames = nullptr);

    /// The radiance that a light's edge may bring in a pixel's cell or beside it; 0: none was
    /// found.
    double near(int x, int y) const;

private:
    void spread(const StonePixels& at, const std::vector<double>& seen, double step, int rows);

    int columns_ = 0;
    double side_ = 1;           // of a cell, in pixels
    std::vector<float> cells_;  // row by row
};

}  // namespace culet
