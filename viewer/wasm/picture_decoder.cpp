// Decodes pictures of light for a page: PFM and HDR by the program's own readers, JPEG and PNG by
// stb_image, EXR by tinyexr. The program's other readers need libraries that do not exist for
// WebAssembly.

#include <array>
#include <cstdlib>
#include <cstring>

#include "render/colour/colour.h"
#include "render/image/codecs/codecs.h"
#include "render/image/image_io.h"
#include "render/image/linear_picture.h"
#include "render/image/picture_format.h"
#include "stone/text/errors.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
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

ReadPicture exr(const std::string& bytes, const std::filesystem::path& name) {
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
    const EXRBox2i &data_window = header.data_window, &shown = header.display_window;
    const bool whole = data_window.min_x == shown.min_x && data_window.min_y == shown.min_y &&
                       data_window.max_x == shown.max_x && data_window.max_y == shown.max_y;
    Primaries primaries = k_srgb_primaries;
    for (int i = 0; i < header.num_custom_attributes; ++i) {
        const EXRAttribute& attribute = header.custom_attributes[i];
        std::array<float, 8> xy{};
        if (std::string(attribute.name) != "chromaticities" || attribute.size != int{sizeof xy})
            continue;
        std::memcpy(xy.data(), attribute.value, sizeof xy);
        for (std::size_t k = 0; k < xy.size(); ++k)
            primaries[k / 2][k % 2] = static_cast<double>(xy[k]);
    }
    FreeEXRHeader(&header);
    if (!whole) {
        throw InputError(name,
                         "holds a part of its picture (data window), which a page does not read: "
                         "save it whole");
    }
    require_size(name, wide, high);
    float* rgba = nullptr;
    ReadPicture read;
    read.encoding = "linear EXR";
    Picture& picture = read.picture;
    if (LoadEXRFromMemory(&rgba, &picture.width, &picture.height, data, bytes.size(), &complaint) !=
        TINYEXR_SUCCESS)
        throw InputError(name, "is an EXR of a kind that a page does not read: save it as HDR");
    picture.rgb.resize(3 * picture.pixels());
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) picture.rgb[3 * i + c] = rgba[4 * i + c];
    }
    std::free(rgba);
    turn_to_srgb(primaries, picture.rgb, read.notes);
    return read;
}

ReadPicture checked(ReadPicture read, const std::filesystem::path& name) {
    require_size(name, read.picture.width, read.picture.height);
    return read;
}

}  // namespace

ReadPicture picture_of_bytes(const std::string& bytes, const std::filesystem::path& name) {
    const std::string format = picture_format(bytes);
    if (format == "PFM") return checked(linear_picture(decode_pfm(bytes, name), format), name);
    if (format == "HDR") return checked(linear_picture(decode_hdr(bytes, name), format), name);
    if (format == "EXR") return exr(bytes, name);
    ReadPicture read;
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) {
        throw InputError(name, "is no panorama that a page reads: HDR, EXR, PFM, JPEG and PNG are");
    }
    require_size(name, width, height);
    read.was_encoded = true;
    for (const char* mark : {"ICC_PROFILE", "iCCP", "cICP"}) {
        if (bytes.substr(0, 65536).find(mark) != std::string::npos)
            read.notes.emplace_back("a page follows no colour profile: it is taken as sRGB");
    }
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
