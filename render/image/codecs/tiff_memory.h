#pragma once
// A TIFF's bytes in memory, opened by libtiff, which says nothing to anybody.

#include <tiffio.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "stone/text/errors.h"

namespace culet {

// A file in memory, and the first complaint of the library about it.
struct TiffInput {
    const std::string* bytes = nullptr;
    std::uint64_t at = 0;
    std::array<char, 160> complaint{};
};

using OpenTiff = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

/// Null for what is no TIFF. `input` outlives it.
OpenTiff opened_tiff(TiffInput& input);

/// With the library's complaint.
InputError tiff_refusal(const TiffInput& input, const std::filesystem::path& file);

}  // namespace culet
