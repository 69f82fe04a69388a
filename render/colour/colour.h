#pragma once
// From radiance over wavelength to XYZ and sRGB, and back from RGB lights to spectra.
//
// Spectral radiances are relative to D65: 1 at every wavelength is D65 white of luminance 1, so a
// light of 1 gives exactly (1, 1, 1) in linear sRGB. The illuminant A is then A/D65, scaled to
// luminance 1.

#include <array>
#include <vector>

#include "stone/material/spectrum.h"

namespace culet {

using Rgb = std::array<double, 3>;

/// The quadrature of one set of wavelengths: a spectrum is taken as linear between the nodes and
/// constant beyond them, so that any spectrum of that form is integrated exactly.
class WavelengthSet {
public:
    /// Increasing, at least one. With a single wavelength a picture is grey: (v, v, v).
    explicit WavelengthSet(std::vector<double> wavelengths_nm);
    /// The same with shares of their own, which sum to 1 for each colour (few_wavelengths.h).
    WavelengthSet(std::vector<double> wavelengths_nm, std::vector<Rgb> rgb_weight);

    const std::vector<double>& wavelengths_nm() const { return wavelengths_nm_; }
    int size() const { return static_cast<int>(wavelengths_nm_.size()); }

    /// Linear sRGB of the radiances at the nodes. All ones give exactly (1, 1, 1).
    Rgb rgb_of(const double* radiance) const;

    /// Radiances at the nodes for a light of that colour: r s_r + g s_g + b s_b with s_r + s_g +
    /// s_b = 1 at each node, the smoothest such spectra that integrate back to (r, g, b) exactly
    /// for three and more nodes (in the spirit of Mallett & Yuksel 2019, for the nodes at hand).
    /// From about ten nodes over the visible range they lie in 0..1; fewer cannot be exact without
    /// values below 0. Two nodes: as near to (r, g, b) as they can; one: its luminance.
    std::vector<double> spectrum_of(const Rgb& rgb) const;
    /// s_r, s_g, s_b at each node. The first call with these wavelengths takes up to tens of
    /// milliseconds (57 nodes); what it finds is kept for all sets of the same nodes.
    const std::array<std::vector<double>, 3>& primaries() const;

    /// Radiances at the nodes of a CIE illuminant relative to D65, luminance 1: "D65" is flat.
    /// Where nodes have shares of their own, those of a light of the illuminant's colour.
    std::vector<double> illuminant_relative(const char* name) const;

private:
    std::vector<double> wavelengths_nm_;
    std::vector<Rgb> rgb_weight_;  // of each node
    bool fitted_ = false;          // shares of their own
};

/// Y of linear sRGB, 1 for white.
double luminance(const Rgb& rgb);
/// Of the three floats of a pixel.
inline double luminance(const float* rgb) {
    return luminance(Rgb{rgb[0], rgb[1], rgb[2]});
}

/// Linear light to the sRGB encoding (IEC 61966-2-1), 0..1 to 0..1.
double srgb_encoded(double linear);
double srgb_decoded(double encoded);

/// XYZ (D65 white at Y = 1) of linear sRGB, and back (IEC 61966-2-1 primaries).
std::array<double, 3> xyz_of_rgb(const Rgb& rgb);
Rgb rgb_of_xyz(const std::array<double, 3>& xyz);

}  // namespace culet
