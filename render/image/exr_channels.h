#pragma once
// Which channels of an EXR are its colours.

#include <ImfChannelList.h>

#include <array>
#include <filesystem>
#include <string>

namespace culet {

struct ExrColours {
    enum class Kind { rgb, xyz, grey, chroma } kind = Kind::rgb;
    std::array<std::string, 3> names;  ///< of the channels; of grey the first alone, of chroma none
    std::string alpha;                 ///< empty: none
    std::string layer;                 ///< that holds them; empty: they stand in no layer
};

/// R, G, B (small letters or whole words as well), X, Y, Z, or Y with or without RY and BY; failing
/// these, R, G, B of the only layer that has them (`View Layer.Combined.R`). Throws InputError with
/// the channels' names: none, or several layers.
ExrColours colours_in(const Imf::ChannelList& channels, const std::filesystem::path& file);

}  // namespace culet
