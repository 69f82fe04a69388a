#pragma once
// The picture while it is made: what is seen of each pixel behind the eye's optics, in colour and,
// if asked for, wavelength by wavelength.

#include <vector>

#include "render/image/picture.h"
#include "render/reference/pixel_shader.h"
#include "render/setup/optical_setup.h"

namespace culet {

class Film {
public:
    /// `camera`: of one window; a dichroscope's two stand side by side.
    Film(const Scene& scene, const Camera& camera, const OpticalSetup& setup,
         const WavelengthSet& colours, int planes);

    /// Of pixel (x, y) of the window: `estimates[plane * nodes + node]`, whose Stokes parameters
    /// need not be light's. Different pixels may be put from different threads.
    void put(int x, int y, const PixelSums& sums, const double* estimates);

    /// The finished picture; `noisy`: it has a standard error worth keeping.
    Picture take(bool noisy);

private:
    Picture picture_;
    const WavelengthSet& colours_;
    int windows_, width_, planes_, nodes_;
    std::vector<Stokes> rows_;  // window * nodes + node: radiance behind the optics
};

}  // namespace culet
