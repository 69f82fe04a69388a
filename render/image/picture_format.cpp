#include "render/image/picture_format.h"

#include <utility>

namespace culet {

namespace {

using namespace std::string_view_literals;

using Start = std::pair<std::string_view, const char*>;

constexpr Start k_read[]{{"\x89PNG\r\n\x1a\n"sv, "PNG"},
                         {"\xff\xd8\xff"sv, "JPEG"},
                         {"II*\0"sv, "TIFF"},
                         {"MM\0*"sv, "TIFF"},
                         {"II+\0\x08\0\0\0"sv, "TIFF"},
                         {"MM\0+\0\x08\0\0"sv, "TIFF"},
                         {"\x76\x2f\x31\x01"sv, "EXR"},
                         {"#?RADIANCE"sv, "HDR"},
                         {"#?RGBE"sv, "HDR"}};

constexpr Start k_other[]{{"GIF8"sv, "GIF"},
                          {"BM"sv, "BMP"},
                          {"8BPS"sv, "PSD (Photoshop)"},
                          {"\xff\x0a"sv, "JPEG XL"},
                          {"\0\0\0\x0cJXL "sv, "JPEG XL"},
                          {"\0\0\0\x0cjP  "sv, "JPEG 2000"},
                          {"\xff\x4f\xff\x51"sv, "JPEG 2000"},
                          {"II\xbc\x01"sv, "JPEG XR"},
                          {"P5"sv, "PGM"},
                          {"P6"sv, "PPM"},
                          {"P7"sv, "PAM"},
                          {"\x80\x2a\x5f\xd7"sv, "Cineon"},
                          {"SDPX"sv, "DPX"},
                          {"XPDS"sv, "DPX"}};

template <std::size_t count>
std::string named(std::string_view bytes, const Start (&starts)[count]) {
    for (const auto& [start, name] : starts) {
        if (bytes.starts_with(start)) return name;
    }
    return {};
}

}  // namespace

std::string picture_format(std::string_view bytes) {
    const bool pfm = bytes.size() > 2 && (bytes.starts_with("PF") || bytes.starts_with("Pf")) &&
                     " \t\r\n"sv.find(bytes[2]) != std::string_view::npos;
    return pfm ? "PFM" : named(bytes, k_read);
}

std::string other_picture_format(std::string_view bytes) {
    if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "WebP";
    // ISO/IEC 14496-12, 4.3: the brand follows the first box's size and name.
    if (bytes.size() >= 12 && bytes.substr(4, 4) == "ftyp") {
        const std::string_view brand = bytes.substr(8, 4);
        if (brand == "avif" || brand == "avis") return "AVIF";
        for (const auto heic : {"heic"sv, "heix"sv, "heim"sv, "hevc"sv, "mif1"sv, "msf1"sv}) {
            if (brand == heic) return "HEIC";
        }
    }
    return named(bytes, k_other);
}

}  // namespace culet
