#pragma once
// A picture of the light around, as a person drops it on a page.

#include <string>
#include <string_view>
#include <vector>

namespace culet {

struct Panorama {
    std::string name;   ///< that a scene may call it
    std::string bytes;  ///< as a PFM in linear light, which is read fast
    int width = 0, height = 0;
    std::vector<std::string> notes;
};

/// Pictures wider than this are brought to it, by whole factors.
constexpr int k_widest_panorama = 2048;

/// A lat-long or cube map in a format that `picture_of_bytes` reads. Throws InputError.
Panorama panorama_of(const std::string& name, std::string_view bytes);

/// A picture in linear light as a PFM.
std::string pfm_of(int width, int height, const std::vector<float>& rgb);

}  // namespace culet
