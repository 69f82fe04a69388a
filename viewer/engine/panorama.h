#pragma once
// A picture of the surrounding light that a person drops on a page.

#include <string>
#include <string_view>
#include <vector>

namespace culet {

struct Panorama {
    std::string name;   ///< under which a scene may refer to it
    std::string bytes;  ///< a PFM in linear light, which is read fast
    int width = 0, height = 0;
    std::vector<std::string> notes;
};

/// Wider pictures are reduced to this by whole factors.
constexpr int k_widest_panorama = 2048;

/// Reads a lat-long or cube map in a format of `picture_of_bytes`. Throws InputError.
Panorama panorama_of(const std::string& name, std::string_view bytes);

/// Writes a picture in linear light as PFM.
std::string pfm_of(int width, int height, const std::vector<float>& rgb);

}  // namespace culet
