#pragma once
// A picture in linear light.

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "render/colour/colour.h"

namespace culet {

/// EXR channels of luminance quantiles in pictures of an uncertain stone
/// (uncertainty/picture_uncertainty.h).
inline constexpr std::array<const char*, 4> k_band_channels{"p02.Y", "p16.Y", "p84.Y", "p98.Y"};

/// Linear scene radiance in sRGB primaries (white D65). Rows run from the top, columns from the
/// left.
struct Picture {
    int width = 0, height = 0;
    std::vector<float> rgb;       ///< 3 values per pixel
    std::vector<float> coverage;  ///< part of the pixel that the stone covers, 0..1; empty: unknown
    std::vector<double> wavelengths_nm;        ///< of `spectral`; empty: no spectral planes
    std::vector<std::vector<float>> spectral;  ///< radiance relative to D65, one plane per
                                               ///< wavelength
    /// Stokes S1, S2, S3 (optics/stokes.h), in planes like `spectral`; empty: unknown.
    std::array<std::vector<std::vector<float>>, 3> polarised;
    /// Further planes by their EXR channel's name: `variance.R`, `saturated`, ...
    struct Plane {
        std::string channel;
        std::vector<float> values;
    };
    std::vector<Plane> planes;
    /// Storage of R, G, B and A in EXRs: 32-bit or 16-bit floats (binary16, to 65504).
    enum class Samples { single, half } samples = Samples::single;
    /// Texts read from an EXR whose key begins with `culet:`.
    std::vector<std::pair<std::string, std::string>> text;
    /// Set on pictures of all directions (environment_layout.h), so that other programs know.
    enum class Environment { none, lat_long, cube } environment = Environment::none;
    /// One standard deviation of the luminance from random paths; empty: none.
    std::vector<float> standard_error;

    std::size_t pixels() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    const float* at(int x, int y) const {
        return rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(x));
    }
    Rgb pixel(int x, int y) const { return {at(x, y)[0], at(x, y)[1], at(x, y)[2]}; }
};

}  // namespace culet
