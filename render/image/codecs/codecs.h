#pragma once
// The picture formats' codecs: bytes of a file to samples and what the file says of them, and back.
// What follows from that is the business of linear_picture.h.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "render/image/codecs/sample_meaning.h"

namespace culet {

struct DecodedPixels {
    int width = 0, height = 0;
    int channels = 0;  ///< 1: grey; 3: R, G, B; 4: R, G, B, A, or C, M, Y, K (meaning.inks)
    /// Rows from the top, without gaps: of 8 bits, of 16 bits, or floats.
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>> samples;
    SampleMeaning meaning;
};

/// Each turns its picture upright as the file's orientation says, and throws InputError naming
/// `file`: cut off, damaged, unusual, absurd size. None writes to stderr.
DecodedPixels decode_png(const std::string& bytes, const std::filesystem::path& file);
DecodedPixels decode_jpeg(const std::string& bytes, const std::filesystem::path& file);
DecodedPixels decode_tiff(const std::string& bytes, const std::filesystem::path& file);
DecodedPixels decode_hdr(const std::string& bytes, const std::filesystem::path& file);
DecodedPixels decode_pfm(const std::string& bytes, const std::filesystem::path& file);

/// A PNG's bytes from rows without gaps, of 1 (grey), 3 (R, G, B) or 4 (R, G, B, A) channels. The
/// texts are key and value, the value in UTF-8. The same input gives the same bytes.
std::string encode_png(int width, int height, int channels, std::span<const std::uint8_t> samples,
                       const std::vector<std::pair<std::string, std::string>>& text = {});
/// R, G, B of each pixel, at least 0 and below 2^127.
std::string encode_hdr(int width, int height, std::span<const float> rgb);
/// One number a pixel, exactly.
std::string encode_pfm(int width, int height, std::span<const float> values);

/// A hostile header must not make anybody take gigabytes for a file of a few bytes: throws
/// InputError for more pixels than are read, none at all, or more than `bytes` bytes can hold.
void check_size(std::uint64_t width, std::uint64_t height, std::size_t bytes, const char* format,
                const std::filesystem::path& file);

/// The picture that is stored with an orientation of EXIF or TIFF (1 to 8; any other number: as it
/// is).
DecodedPixels turned_upright(DecodedPixels stored, int orientation);

}  // namespace culet
