#pragma once
// Codecs of picture formats: bytes to samples and their meaning (for linear_picture.h), and back.

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
    /// Rows from the top, without gaps.
    std::variant<std::vector<std::uint8_t>, std::vector<std::uint16_t>, std::vector<float>> samples;
    SampleMeaning meaning;
};

/// The decoders apply the file's orientation. They throw InputError naming `file` if it is cut off,
/// damaged, unsupported or absurdly large. None writes to stderr.
DecodedPixels decode_png(const std::string& bytes, const std::filesystem::path& file);
DecodedPixels decode_jpeg(const std::string& bytes, const std::filesystem::path& file);
DecodedPixels decode_tiff(const std::string& bytes, const std::filesystem::path& file);
DecodedPixels decode_hdr(const std::string& bytes, const std::filesystem::path& file);
DecodedPixels decode_pfm(const std::string& bytes, const std::filesystem::path& file);

/// A PNG from rows without gaps, of 1 (grey), 3 (R, G, B) or 4 (R, G, B, A) channels. `text`: key
/// and value, in UTF-8. The same input gives the same bytes.
std::string encode_png(int width, int height, int channels, std::span<const std::uint8_t> samples,
                       const std::vector<std::pair<std::string, std::string>>& text = {});
/// R, G, B of each pixel, each at least 0 and below 2^127.
std::string encode_hdr(int width, int height, std::span<const float> rgb);
/// One value per pixel, kept exactly.
std::string encode_pfm(int width, int height, std::span<const float> values);

/// Stops hostile headers from allocating gigabytes: throws InputError for no pixels, for too many,
/// or for more than `bytes` bytes can hold.
void check_size(std::uint64_t width, std::uint64_t height, std::size_t bytes, const char* format,
                const std::filesystem::path& file);

/// Applies an EXIF or TIFF orientation (1 to 8; any other number: none).
DecodedPixels turned_upright(DecodedPixels stored, int orientation);

}  // namespace culet
