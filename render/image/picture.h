#pragma once
// A picture in linear light.

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "render/colour/colour.h"

namespace culet {

/// Channels of an EXR with the luminance's levels in pictures of an uncertain stone
/// (uncertainty/picture_uncertainty.h): two and one standard deviations below, and above.
inline constexpr std::array<const char*, 4> k_band_channels{"p02.Y", "p16.Y", "p84.Y", "p98.Y"};

/// Rows run from the top, columns from the left. Linear scene radiance in sRGB primaries (white
/// D65).
struct Picture {
    int width = 0, height = 0;
    std::vector<float> rgb;  ///< 3 a pixel
    std::vector<float>
        coverage;  ///< share of the pixel that the stone fills, 0..1; empty: not known
    std::vector<double> wavelengths_nm;        ///< of `spectral`; empty: no spectral planes
    std::vector<std::vector<float>> spectral;  ///< radiance relative to D65, a plane a wavelength
    /// Stokes S1, S2, S3 (eye_coherency.h), likewise; empty: not known.
    std::array<std::vector<std::vector<float>>, 3> polarised;
    /// Further planes by the name of their channel in an EXR: `variance.R`, `saturated`, ...
    struct Plane {
        std::string channel;
        std::vector<float> values;
    };
    std::vector<Plane> planes;
    /// How an EXR holds R, G, B and A: in 32 or in 16 bits (binary16, to 65504).
    enum class Samples { single, half } samples = Samples::single;
    /// Texts of an EXR that was read whose key begins with `culet:`.
    std::vector<std::pair<std::string, std::string>> text;
    /// Set on a picture of all directions (environment_layout.h), so that other programs know.
    enum class Environment { none, lat_long, cube } environment = Environment::none;
    /// One standard deviation of the luminance from paths chosen at random; empty: none were.
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
