#include "compare/photo/photo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "compare/photo/raw_file.h"
#include "render/colour/colour.h"
#include "render/image/image_io.h"
#include "render/image/picture_format.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// The start of a file: enough for its type and its EXIF data.
std::string first_bytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string bytes(std::size_t{1} << 18, '\0');
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(stream.gcount(), 0)));
    return bytes;
}

ShotData shot_data_of(const std::string& bytes, const std::string& format) {
    return format == "JPEG" || format == "TIFF" ? shot_data(bytes) : ShotData{};
}

void note_camera(Photo& photo, const std::string& bytes) {
    const std::string format = picture_format(bytes);
    photo.shot = shot_data_of(bytes, format);
    if (!photo.shot.processed.empty()) {
        photo.photometric = false;
        photo.not_photometric = photo.shot.processed;
    } else if (format == "JPEG" && photo.photometric) {
        photo.photometric = false;
        photo.not_photometric = "a JPEG, whose tone curve is the camera's own";
    }
    if (format == "JPEG") photo.encoding += " JPEG";
}

// Empty unless all bands are there.
std::vector<float> bands_of(const Picture& picture) {
    std::vector<float> bands;
    for (std::size_t k = 0; k < k_band_channels.size(); ++k) {
        const auto plane = std::find_if(
            picture.planes.begin(), picture.planes.end(),
            [&](const Picture::Plane& one) { return one.channel == k_band_channels[k]; });
        if (plane == picture.planes.end()) return {};
        bands.resize(k_band_channels.size() * picture.pixels());
        for (std::size_t p = 0; p < picture.pixels(); ++p)
            bands[k_band_channels.size() * p + k] = plane->values[p];
    }
    return bands;
}

Photo read_unmasked(const std::filesystem::path& file) {
    if (has_raw_extension(file)) return read_raw(file);
    ReadPicture read = read_picture(file);
    if (static_cast<double>(read.picture.pixels()) > k_max_photo_pixels) {
        throw InputError(
            file, fmt::format("has {} x {} pixels; up to {:.0f} million are read",
                              read.picture.width, read.picture.height, k_max_photo_pixels / 1e6));
    }
    Photo photo;
    photo.width = read.picture.width;
    photo.height = read.picture.height;
    photo.rgb = std::move(read.picture.rgb);
    photo.coverage = std::move(read.picture.coverage);
    photo.saturation = read.white;
    photo.encoding = read.encoding;
    photo.notes = std::move(read.notes);
    photo.photometric = read.not_photometric.empty();
    photo.not_photometric = read.not_photometric;
    photo.bands = bands_of(read.picture);
    for (Picture::Plane& plane : read.picture.planes) {
        if (plane.channel == "saturated") photo.saturated = std::move(plane.values);
    }
    for (const auto& [key, value] : read.picture.text) {
        if (key != "culet:photometric" || value == "yes") continue;
        photo.photometric = false;
        photo.not_photometric = value;
    }
    note_camera(photo, first_bytes(file));
    std::size_t not_finite = 0, negative = 0;
    for (float& value : photo.rgb) {
        if (!std::isfinite(value)) {
            ++not_finite;
            value = 0;
        } else if (value < 0) {
            ++negative;
            value = 0;
        }
    }
    for (float& share : photo.coverage) {
        share = std::isfinite(share) ? std::clamp(share, 0.0f, 1.0f) : 0.0f;
    }
    photo.not_finite = not_finite;
    if (not_finite > 0) {
        photo.notes.push_back(fmt::format("{} samples were not finite and count as 0", not_finite));
    }
    if (negative > 0)
        photo.notes.push_back(fmt::format("{} negative samples{} count as 0", negative,
                                          read.was_encoded ? " (colours outside of sRGB)" : ""));
    return photo;
}

}  // namespace

Photo read_photo(const std::filesystem::path& file, const std::filesystem::path& mask,
                 const std::vector<std::string>& ignored) {
    Photo photo = read_unmasked(file);
    if (!mask.empty()) photo.mask = read_mask(mask, photo.width, photo.height);
    for (const std::string& one : ignored) {
        const std::vector<float> also = read_mask(one, photo.width, photo.height);
        photo.ignored.resize(also.size(), 0.0f);
        for (std::size_t i = 0; i < also.size(); ++i)
            photo.ignored[i] = std::max(photo.ignored[i], also[i]);
    }
    return photo;
}

ShotData read_shot_data(const std::filesystem::path& file) {
    if (has_raw_extension(file)) return read_raw_shot_data(file);
    std::error_code problem;
    if (!std::filesystem::exists(file, problem)) throw InputError(file, "no such file");
    const std::string bytes = first_bytes(file);
    return shot_data_of(bytes, picture_format(bytes));
}

int bits_of(const Photo& photo) {
    if (!(photo.saturation > 0)) return 0;
    return photo.encoding.find("16-bit") != std::string::npos ? 16 : 8;
}

std::vector<float> read_mask(const std::filesystem::path& file, int width, int height) {
    const Photo mask = read_photo(file);
    if (mask.width != width || mask.height != height) {
        throw InputError(file, fmt::format("is a mask of {} x {} pixels for a photograph of {} x "
                                           "{}: they must be of one size",
                                           mask.width, mask.height, width, height));
    }
    std::vector<float> stone(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const float half = static_cast<float>(mask.saturation > 0 ? srgb_decoded(0.5) : 0.5);
    for (std::size_t i = 0; i < stone.size(); ++i) {
        const float brightest =
            std::max({mask.rgb[3 * i], mask.rgb[3 * i + 1], mask.rgb[3 * i + 2]});
        const bool opaque = mask.coverage.empty() || mask.coverage[i] > 0.5f;
        stone[i] = opaque && brightest > half ? 1.0f : 0.0f;
    }
    return stone;
}

}  // namespace culet
