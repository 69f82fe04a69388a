#include "viewer/engine/panorama.h"

#include <fmt/format.h>

#include <cctype>
#include <cstring>

#include "render/image/image_io.h"

namespace culet {

namespace {

// A name that needs no quotes in TOML and on a command line.
std::string plain_name(const std::string& name) {
    std::string plain;
    for (const char c : name.substr(name.find_last_of("/\\") + 1))
        plain += std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' ? c : '_';
    return plain.empty() ? "panorama" : plain;
}

// Averages squares of `by` x `by` pixels.
Picture reduced(const Picture& picture, int by) {
    Picture small;
    small.width = picture.width / by;
    small.height = picture.height / by;
    small.rgb.assign(3 * small.pixels(), 0);
    const auto scale = 1 / static_cast<float>(by * by);
    for (int y = 0; y < small.height * by; ++y) {
        for (int x = 0; x < small.width * by; ++x) {
            float* to = small.rgb.data() + 3 * (static_cast<std::size_t>(y / by) *
                                                    static_cast<std::size_t>(small.width) +
                                                static_cast<std::size_t>(x / by));
            for (int c = 0; c < 3; ++c) to[c] += scale * picture.at(x, y)[c];
        }
    }
    return small;
}

}  // namespace

std::string pfm_of(int width, int height, const std::vector<float>& rgb) {
    // Rows from the bottom. The negative scale means little-endian, as are all machines that culet
    // runs on.
    std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", width, height);
    const std::size_t row = 3 * static_cast<std::size_t>(width) * sizeof(float);
    const std::size_t start = bytes.size();
    bytes.resize(start + row * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        std::memcpy(bytes.data() + start + row * static_cast<std::size_t>(height - 1 - y),
                    rgb.data() + row / sizeof(float) * static_cast<std::size_t>(y), row);
    }
    return bytes;
}

Panorama panorama_of(const std::string& name, std::string_view bytes) {
    Panorama panorama;
    panorama.name = plain_name(name);
    ReadPicture read = picture_of_bytes(std::string(bytes), panorama.name);
    if (read.was_encoded) {
        panorama.notes.push_back(
            "lights brighter than white are missing in a picture of 8 or 16 bits; an EXR or HDR "
            "map holds them");
    }
    const int by = (read.picture.width + k_widest_panorama - 1) / k_widest_panorama;
    if (by > 1) {
        read.picture = reduced(read.picture, by);
        panorama.notes.push_back(
            fmt::format("scaled to {} x {} pixels", read.picture.width, read.picture.height));
    }
    panorama.width = read.picture.width;
    panorama.height = read.picture.height;
    panorama.bytes = pfm_of(panorama.width, panorama.height, read.picture.rgb);
    return panorama;
}

}  // namespace culet
