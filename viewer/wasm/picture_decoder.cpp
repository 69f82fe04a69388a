// Pictures of light for a page: PFM here, HDR, JPEG and PNG by stb_image, EXR by tinyexr. The
// program's own readers need libraries that are not to be had for WebAssembly.

#include <array>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include "render/colour/colour.h"
#include "render/image/image_io.h"
#include "stone/errors.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_HDR
#define STBI_ONLY_JPEG
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#include <stb/stb_image.h>

#define TINYEXR_IMPLEMENTATION
#define TINYEXR_USE_THREAD 0
#include <tinyexr.h>

int uncompress(Bytef* to, unsigned long* size, const Bytef* from, uLong count) {
    const int found =
        stbi_zlib_decode_buffer(reinterpret_cast<char*>(to), static_cast<int>(*size),
                                reinterpret_cast<const char*>(from), static_cast<int>(count));
    if (found < 0) return Z_DATA_ERROR;
    *size = static_cast<unsigned long>(found);
    return Z_OK;
}

namespace culet {

namespace {

constexpr double k_most_pixels = 3.4e7;

void require_size(const std::filesystem::path& name, double width, double height) {
    if (!(width >= 1 && height >= 1))
        throw InputError(name, "is a broken picture: save it again with another program");
    if (width * height > k_most_pixels)
        throw InputError(name, "has too many pixels for a page: make it 8192 wide or less");
}

Picture pfm(const std::string& bytes, const std::filesystem::path& name) {
    std::istringstream head(bytes.substr(0, 100));
    std::string kind;
    double width = 0, height = 0, scale = 0;
    head >> kind >> width >> height >> scale;
    require_size(name, width, height);
    Picture picture;
    picture.width = static_cast<int>(width);
    picture.height = static_cast<int>(height);
    picture.rgb.resize(3 * picture.pixels());
    const std::size_t start = static_cast<std::size_t>(head.tellg()) + 1,
                      row = 3 * sizeof(float) * static_cast<std::size_t>(picture.width);
    if (!head || kind != "PF" || !(scale < 0) ||
        bytes.size() < start + row * static_cast<std::size_t>(picture.height))
        throw InputError(name, "is a broken PFM, or of a kind that a page does not read");
    for (int y = 0; y < picture.height; ++y) {
        std::memcpy(picture.rgb.data() + row / sizeof(float) * static_cast<std::size_t>(y),
                    bytes.data() + start + row * static_cast<std::size_t>(picture.height - 1 - y),
                    row);
    }
    return picture;
}

Picture exr(const std::string& bytes, const std::filesystem::path& name) {
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    EXRVersion version;
    EXRHeader header;
    InitEXRHeader(&header);
    const char* complaint = nullptr;
    if (ParseEXRVersionFromMemory(&version, data, bytes.size()) != TINYEXR_SUCCESS ||
        ParseEXRHeaderFromMemory(&header, &version, data, bytes.size(), &complaint) !=
            TINYEXR_SUCCESS)
        throw InputError(name, "is an EXR of a kind that a page does not read: save it as HDR");
    const double wide = double(header.data_window.max_x) - header.data_window.min_x + 1,
                 high = double(header.data_window.max_y) - header.data_window.min_y + 1;
    FreeEXRHeader(&header);
    require_size(name, wide, high);
    float* rgba = nullptr;
    Picture picture;
    if (LoadEXRFromMemory(&rgba, &picture.width, &picture.height, data, bytes.size(), &complaint) !=
        TINYEXR_SUCCESS)
        throw InputError(name, "is an EXR of a kind that a page does not read: save it as HDR");
    picture.rgb.resize(3 * picture.pixels());
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * i + c] = rgba[4 * i + c];
    }
    std::free(rgba);
    return picture;
}

}  // namespace

ReadPicture picture_of_bytes(const std::string& bytes, const std::filesystem::path& name) {
    ReadPicture read;
    if (bytes.starts_with("PF")) {
        read.picture = pfm(bytes, name);
        read.encoding = "linear PFM";
        return read;
    }
    if (bytes.starts_with("\x76\x2f\x31\x01")) {
        read.picture = exr(bytes, name);
        read.encoding = "linear EXR";
        return read;
    }
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) {
        throw InputError(name, "is no panorama that a page reads: HDR, EXR, PFM, JPEG and PNG are");
    }
    require_size(name, width, height);
    read.was_encoded = stbi_is_hdr_from_memory(data, size) == 0;
    Picture& picture = read.picture;
    const auto take = [&](auto* values, const auto& linear) {
        if (values == nullptr)
            throw InputError(name, "is a broken picture: save it again with another program");
        picture.width = width;
        picture.height = height;
        picture.rgb.resize(3 * picture.pixels());
        for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = linear(values[i]);
        stbi_image_free(values);
    };
    if (!read.was_encoded) {
        read.encoding = "linear HDR";
        take(stbi_loadf_from_memory(data, size, &width, &height, &channels, 3),
             [](float v) { return v; });
        return read;
    }
    read.white = 1;
    const bool sixteen = stbi_is_16_bit_from_memory(data, size) != 0;
    read.encoding = sixteen ? "16-bit sRGB" : "8-bit sRGB";
    const auto decoded = [](double share) { return static_cast<float>(srgb_decoded(share)); };
    if (sixteen) {
        take(stbi_load_16_from_memory(data, size, &width, &height, &channels, 3),
             [&](stbi_us v) { return decoded(v / 65535.0); });
        return read;
    }
    std::array<float, 256> of_byte;
    for (std::size_t v = 0; v < of_byte.size(); ++v)
        of_byte[v] = decoded(static_cast<double>(v) / 255);
    take(stbi_load_from_memory(data, size, &width, &height, &channels, 3),
         [&](stbi_uc v) { return of_byte[v]; });
    return read;
}

}  // namespace culet
