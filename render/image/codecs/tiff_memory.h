#pragma once
// Opens a TIFF's bytes in memory with libtiff, without its output on stderr.

#include <tiffio.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "stone/text/errors.h"

namespace culet {

// A file in memory, and libtiff's first complaint about it.
struct TiffInput {
    const std::string* bytes = nullptr;
    std::uint64_t at = 0;
    std::array<char, 160> complaint{};
};

using OpenTiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

/// Null if it is not a TIFF. `input` must outlive the result.
OpenTiff opened_tiff(TiffInput& input);

InputError tiff_refusal(const TiffInput& input, const std::filesystem::path& file);

}  // namespace culet
