#pragma once
// The picture while it is made: pixels as seen behind the eye's optics, in colour and, if
// requested, per wavelength.

#include <vector>

#include "render/image/picture.h"
#include "render/reference/pixel_shader.h"
#include "render/setup/optical_setup.h"

namespace culet {

class Film {
public:
    /// `camera`: of one window. A dichroscope has two, side by side.
    Film(const Scene& scene, const Camera& camera, const OpticalSetup& setup,
         const WavelengthSet& colours, int planes);

    /// Writes pixel (x, y) of the window. The Stokes parameters `estimates[plane * nodes + node]`
    /// may be unphysical. Different pixels may be written concurrently.
    void put(int x, int y, const PixelSums& sums, const double* estimates);

    /// Returns the finished picture; `noisy`: with its standard error.
    Picture take(bool noisy);

private:
    Picture picture_;
    const WavelengthSet& colours_;
    int windows_, width_, planes_, nodes_;
    std::vector<Stokes> rows_;  // window * nodes + node: radiance behind the optics
};

}  // namespace culet
