#pragma once
// Pictures in files: EXR and HDR in linear light, PNG, JPEG and TIFF in the sRGB encoding.

#include <filesystem>
#include <string>
#include <vector>

#include "render/image/film_look.h"
#include "render/image/picture.h"

namespace culet {

struct ReadPicture {
    Picture picture;           ///< linear light, by the file's own profile, else decoded from sRGB
    bool was_encoded = false;  ///< true: the file held whole numbers (8 or 16 bit)
    bool had_alpha = false;    ///< alpha (EXR, PNG) is in picture.coverage
    /// For the record: "8-bit sRGB", "16-bit Adobe RGB (1998)", "linear EXR", ...
    std::string encoding;
    float white = 0;  ///< linear value at which the file saturates (1 when encoded); 0: none
    std::vector<std::string> notes;  ///< what the file says that was not followed, or was assumed
    std::string not_photometric;     ///< why the values do not stand for light; empty: they do
};

/// By content: EXR, HDR, PFM, PNG, JPEG, TIFF. Pictures are turned upright, and their numbers are
/// taken as the file says: exposure, primaries, transfer curve, ICC profile, inks
/// (linear_picture.h), windows (image_exr.h). Throws InputError: missing, a folder, empty, no
/// picture, cut off, damaged, absurd size (over 2^28 pixels, or more than a file of its length can
/// hold).
ReadPicture read_picture(const std::filesystem::path& file);

/// The same of a file's bytes; errors call it `name`.
ReadPicture picture_of_bytes(const std::string& bytes, const std::filesystem::path& name);

/// A PNG's bytes, as looked at.
std::string png_of(const Picture& picture, const PngLook& look,
                   std::vector<std::pair<std::string, std::string>> text = {});

/// By extension: .exr (linear float, half the file's channels named R, G, B, A when coverage is
/// known, and S0.589,300nm for spectral planes), .hdr, .png (8 bit sRGB, as looked at, which its
/// text chunks tell). Whole or not at all. `text`: key/value pairs stored in the file where it
/// can hold them.
void write_picture(const Picture& picture, const std::filesystem::path& file,
                   const PngLook& look = {},
                   const std::vector<std::pair<std::string, std::string>>& text = {});

}  // namespace culet
