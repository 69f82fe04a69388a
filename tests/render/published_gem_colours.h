#pragma once
// Published colours of named gems, to compare the catalogue's stones with.
//
// Names of colours after gems from two dictionaries of colour, each given by the middle of its
// ISCC-NBS block in sRGB: K. L. Kelly and D. B. Judd, Color: Universal Language and Dictionary of
// Names, NBS Special Publication 440 (1976). TC: Standard Color Card of America, 9th edition; M: A.
// Maerz and M. R. Paul, A Dictionary of Color, 1st edition. They are colours of textile and paper
// with such names, not measured stones: they test only hue and depth.
//
// Rhodolite has no entry there; gemmologists call it purplish red to reddish purple.

#include <string>
#include <vector>

#include "render/colour/colour.h"
#include "render/colour/colour_difference.h"

namespace culet::test {

struct PublishedColour {
    std::string word;  ///< with its dictionary
    int srgb = 0;
};

struct NamedGem {
    std::string material;  ///< of the catalogue
    std::vector<PublishedColour> colours;
};

inline std::vector<NamedGem> named_gems() {
    return {
        {"ruby_gem",
         {{"ruby, TC", 0x78184a},
          {"ruby, M", 0x722f37},
          {"pigeon blood, M", 0x722f37},
          {"antique ruby, M", 0x841b2d}}},
        {"sapphire_blue", {{"sapphire blue, TC", 0x272458}, {"sapphire [blue], M", 0x00304e}}},
        {"emerald",
         {{"emerald, TC", 0x44944a},
          {"emerald green, M", 0x679267},
          {"emerald green, M", 0x3eb489},
          {"emeraude, M", 0x007959},
          {"emeraude, M", 0x3b7861}}},
        {"amethyst",
         {{"amethyst, TC", 0x86608e},
          {"amethyst [violet], M", 0x563c5c},
          {"amethyst [violet], M", 0x796878}}},
        {"citrine", {{"citrine, M", 0x867e36}}},
        {"peridot",
         {{"chrysolite green, M", 0xb9b459},
          {"chrysolite green, M", 0x8a9a5b},
          {"peridot, M", 0x8a9a5b},
          {"peridot, M", 0x8f9779},
          {"peridot, M", 0x4a5d23},
          {"peridot, M", 0x515744}}},
        {"garnet_almandine", {{"garnet, TC", 0x722f37}, {"grenat, M", 0x722f37}}},
        {"garnet_rhodolite",
         {{"strong purplish red", 0xb3446c},
          {"deep purplish red", 0x78184a},
          {"moderate purplish red", 0xa8516e}}},
        {"tourmaline_pink", {{"rubelite, M", 0xce4676}}},
        {"tourmaline_green", {{"tourmaline, TC", 0xc7e6d7}}},
    };
}

inline Lab lab_of_srgb(int srgb) {
    const auto linear = [srgb](int shift) {
        return srgb_decoded(((srgb >> shift) & 0xff) / 255.0);
    };
    return lab_from_linear_srgb(linear(16), linear(8), linear(0));
}

}  // namespace culet::test
