#pragma once
// What the values of a picture file mean, as the file itself says it. The codecs gather it; it is
// followed, or said, in one place for every format: linear_picture.h.

#include <array>
#include <string>
#include <vector>

#include "render/colour/primaries.h"

namespace culet {

/// Of Adobe RGB (1998), 4.3.4.2.
inline constexpr double k_adobe_rgb_exponent = 2.19921875;

struct SampleMeaning {
    std::string colours = "sRGB";  ///< their name, for the record
    std::string profile;           ///< an ICC profile, before what follows; empty: none
    double exponent = 0;  ///< light = value^exponent; 0: sRGB's curve, of floats the value itself
    std::array<float, 3> factor{1, 1, 1};  ///< of the light of R, G, B, before the primaries
    Primaries primaries = k_srgb_primaries;
    bool grey = false;        ///< of R, G, B, A: R, G, B are three times one grey
    bool inks = false;        ///< four channels are cyan, magenta, yellow, black; 0: no ink
    bool multiplied = false;  ///< whole numbers: colours are multiplied by alpha
    double pixel_aspect = 1;  ///< width over height of a pixel
    std::vector<std::string> notes;
    std::string not_photometric;  ///< why values do not stand for light; empty: they do
};

}  // namespace culet
