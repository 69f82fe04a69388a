#pragma once
// The meaning of a picture file's values, as the file states it. Codecs collect it;
// linear_picture.h applies or notes it.

#include <array>
#include <string>
#include <vector>

#include "render/colour/primaries.h"

namespace culet {

/// Adobe RGB (1998), 4.3.4.2.
inline constexpr double k_adobe_rgb_exponent = 2.19921875;

struct SampleMeaning {
    std::string colours = "sRGB";  ///< name for reports
    std::string profile;           ///< ICC profile, which overrides what follows; empty: none
    double exponent = 0;  ///< light = value^exponent; 0: sRGB's curve, or the value itself for
                          ///< floats
    std::array<float, 3> factor{1, 1, 1};  ///< on the light of R, G, B, before the primaries
    Primaries primaries = k_srgb_primaries;
    bool grey = false;        ///< of R, G, B, A: R, G and B are equal
    bool inks = false;        ///< four channels are cyan, magenta, yellow, black; 0: no ink
    bool multiplied = false;  ///< for whole numbers: colours are premultiplied by alpha
    double pixel_aspect = 1;  ///< width over height of a pixel
    std::vector<std::string> notes;
    std::string not_photometric;  ///< why values are not proportional to light; empty: they are
};

}  // namespace culet
