#pragma once
// Colour primaries of picture files, and conversion to sRGB.

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace culet {

/// CIE 1931 x and y of red, green, blue and white.
using Primaries = std::array<std::array<double, 2>, 4>;

/// IEC 61966-2-1; Rec. ITU-R BT.2020-2; SMPTE EG 432-1 with D65 (Display P3); Adobe RGB (1998),
/// 4.3.1; the tristimulus values X, Y, Z.
inline constexpr Primaries k_srgb_primaries{
    {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}}},
    k_rec2020_primaries{{{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}}},
    k_display_p3_primaries{{{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}}},
    k_adobe_rgb_primaries{{{0.64, 0.33}, {0.21, 0.71}, {0.15, 0.06}, {0.3127, 0.3290}}},
    k_xyz_primaries{{{1, 0}, {0, 1}, {0, 0}, {1.0 / 3, 1.0 / 3}}};

/// Matrix, row by row, from linear light in `primaries` to linear sRGB. White becomes (1, 1, 1),
/// with the Bradford transform (Lindbloom; ICC.1:2010, annex E) if it is not D65; X, Y, Z are
/// converted without it. Nothing: the four do not span colours.
std::optional<std::array<double, 9>> srgb_from(const Primaries& primaries);

/// Converts pixels in linear light in place. Primaries that cannot be used become a note.
void turn_to_srgb(const Primaries& primaries, std::vector<float>& rgb,
                  std::vector<std::string>& notes);

}  // namespace culet
