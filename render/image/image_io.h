#pragma once
// Reads and writes picture files: EXR, HDR and PFM in linear light; PNG, JPEG and TIFF, usually
// encoded.

#include <filesystem>
#include <string>
#include <vector>

#include "render/image/film_look.h"
#include "render/image/picture.h"

namespace culet {

struct ReadPicture {
    Picture picture;           ///< linear light, decoded by the file's profile, or else from sRGB
    bool was_encoded = false;  ///< the file held whole numbers (8 or 16 bit)
    bool had_alpha = false;    ///< alpha (EXR, PNG) is in picture.coverage
    /// For reports: "8-bit sRGB", "16-bit Adobe RGB (1998)", "linear EXR", ...
    std::string encoding;
    float white = 0;  ///< linear value at which the file saturates (1 if encoded); 0: none
    std::vector<std::string> notes;  ///< what was assumed, or not applied
    std::string not_photometric;     ///< why the values are not proportional to light; empty: they
                                     ///< are
};

/// Recognises EXR, HDR, PFM, PNG, JPEG and TIFF by content. Applies the file's orientation,
/// exposure, primaries, transfer curve, ICC profile, inks (linear_picture.h) and windows
/// (image_exr.h). Throws InputError: missing, a folder, empty, no picture, cut off, damaged, absurd
/// size (over 2^28 pixels, or more than a file of its length can hold).
ReadPicture read_picture(const std::filesystem::path& file);

/// The same for a file's bytes; errors call it `name`.
ReadPicture picture_of_bytes(const std::string& bytes, const std::filesystem::path& name);

/// A PNG of the picture as shown with `look`.
std::string png_of(const Picture& picture, const PngLook& look,
                   std::vector<std::pair<std::string, std::string>> text = {});

/// By extension: .exr (see write_exr), .hdr, or .png (8 bit sRGB as shown with `look`, which text
/// chunks record). Writes the file completely or not at all. `text`: key/value pairs, stored if the
/// format can.
void write_picture(const Picture& picture, const std::filesystem::path& file,
                   const PngLook& look = {},
                   const std::vector<std::pair<std::string, std::string>>& text = {});

}  // namespace culet
