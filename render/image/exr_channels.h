#pragma once
// Finds the colour channels of an EXR.

#include <ImfChannelList.h>

#include <array>
#include <filesystem>
#include <string>

namespace culet {

struct ExrColours {
    enum class Kind { rgb, xyz, grey, chroma } kind = Kind::rgb;
    std::array<std::string, 3> names;  ///< of the channels; for grey only the first, for chroma
                                       ///< none
    std::string alpha;                 ///< empty: none
    std::string layer;                 ///< layer that holds them; empty: none
};

/// Accepts R, G, B (also small letters or words), X, Y, Z, or Y with or without RY and BY; else R,
/// G, B of the only layer that has them (`View Layer.Combined.R`). Throws InputError with the
/// channels' names if there are none, or several layers.
ExrColours colours_in(const Imf::ChannelList& channels, const std::filesystem::path& file);

}  // namespace culet
