#pragma once
// Conversion from spectral radiance to XYZ and sRGB, and from RGB lights to spectra.
//
// Spectral radiances are relative to D65: 1 at every wavelength is D65 white of luminance 1 and
// gives exactly (1, 1, 1) in linear sRGB. Illuminant A is A/D65, scaled to luminance 1.

#include <array>
#include <vector>

#include "stone/material/spectrum.h"

namespace culet {

using Rgb = std::array<double, 3>;

/// Quadrature for a set of wavelengths. It integrates exactly any spectrum that is linear between
/// the nodes and constant beyond them.
class WavelengthSet {
public:
    /// Increasing, at least one. A single wavelength gives grey pictures: (v, v, v).
    explicit WavelengthSet(std::vector<double> wavelengths_nm);
    /// With given weights that sum to 1 for each colour (few_wavelengths.h).
    WavelengthSet(std::vector<double> wavelengths_nm, std::vector<Rgb> rgb_weight);

    const std::vector<double>& wavelengths_nm() const { return wavelengths_nm_; }
    int size() const { return static_cast<int>(wavelengths_nm_.size()); }

    /// Linear sRGB of radiances at the nodes. All ones give exactly (1, 1, 1).
    Rgb rgb_of(const double* radiance) const;

    /// Radiances at the nodes of a light of this colour: r s_r + g s_g + b s_b, with s_r + s_g +
    /// s_b = 1 at each node. The s are the smoothest spectra that integrate back to (r, g, b)
    /// exactly, for three and more nodes (similar to Mallett & Yuksel 2019). From about ten nodes
    /// over the visible range they lie in 0..1; fewer nodes need negative values. Two nodes: the
    /// nearest colour possible; one: its luminance.
    std::vector<double> spectrum_of(const Rgb& rgb) const;
    /// s_r, s_g, s_b at each node. The first call takes up to tens of milliseconds (57 nodes); the
    /// result is kept for all sets with these nodes.
    const std::array<std::vector<double>, 3>& primaries() const;

    /// Radiances at the nodes of a CIE illuminant relative to D65, luminance 1; "D65" is flat. With
    /// given weights: of a light of the illuminant's colour.
    std::vector<double> illuminant_relative(const char* name) const;

private:
    std::vector<double> wavelengths_nm_;
    std::vector<Rgb> rgb_weight_;  // of each node
    bool fitted_ = false;          // weights were given
};

/// Y of linear sRGB, 1 for white.
double luminance(const Rgb& rgb);
inline double luminance(const float* rgb) {
    return luminance(Rgb{rgb[0], rgb[1], rgb[2]});
}

/// sRGB encoding of linear light (IEC 61966-2-1), 0..1 to 0..1.
double srgb_encoded(double linear);
double srgb_decoded(double encoded);

/// XYZ (D65 white at Y = 1) of linear sRGB, and back (IEC 61966-2-1 primaries).
std::array<double, 3> xyz_of_rgb(const Rgb& rgb);
Rgb rgb_of_xyz(const std::array<double, 3>& xyz);

}  // namespace culet
