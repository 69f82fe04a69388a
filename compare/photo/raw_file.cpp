#include "compare/photo/raw_file.h"

#include <fmt/format.h>
#include <libraw/libraw.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/exposure.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "stone/text/text_scan.h"

namespace culet {

namespace {

constexpr std::size_t k_most_bytes = std::size_t{1} << 30;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
    throw InputError(file, fmt::format("is not a raw file that can be read here ({}); raw files "
                                       "can be converted to DNG or 16-bit TIFF first",
                                       why));
}

void require(const std::filesystem::path& file, int code) {
    if (code != LIBRAW_SUCCESS) refuse(file, libraw_strerror(code));
}

// `bytes` must outlive the processor's work.
void open(const std::filesystem::path& file, const std::string& bytes, LibRaw& processor) {
    if (bytes.empty()) throw InputError(file, "is empty: expected a raw file");
    processor.imgdata.params.max_raw_memory_mb = 1024;
    require(file, processor.open_buffer(const_cast<char*>(bytes.data()), bytes.size()));
}

// EXIF, and data that only the maker's own notes have.
ShotData shot_data_of(const std::string& bytes, const libraw_data_t& data) {
    ShotData shot = shot_data(bytes);
    if (shot.seconds == 0 && data.other.shutter > 0) shot.seconds = data.other.shutter;
    if (shot.f_number == 0 && data.other.aperture > 0) shot.f_number = data.other.aperture;
    if (shot.iso == 0 && data.other.iso_speed > 0) shot.iso = data.other.iso_speed;
    if (shot.focal_mm == 0 && data.other.focal_len > 0) shot.focal_mm = data.other.focal_len;
    return shot;
}

// 1 where a sensor sample reaches the white level, dilated to the neighbours that demosaicing uses.
cv::Mat saturation_mask(const libraw_data_t& data) {
    const auto& sizes = data.sizes;
    cv::Mat mask(sizes.height, sizes.width, CV_8U, cv::Scalar(0));
    const unsigned short* raw = data.rawdata.raw_image;
    const unsigned limit = data.color.maximum - data.color.maximum / 100;
    const unsigned stride = sizes.raw_pitch / sizeof(unsigned short);
    const auto over = [&](int x, int y) {
        const std::size_t row = static_cast<std::size_t>(y) + sizes.top_margin;
        const std::size_t column = static_cast<std::size_t>(x) + sizes.left_margin;
        if (row >= sizes.raw_height || column >= sizes.raw_width) return false;
        if (raw != nullptr) return raw[row * stride + column] >= limit;
        if (data.rawdata.color3_image != nullptr) {
            const auto* rgb = data.rawdata.color3_image[row * (sizes.raw_pitch / 6) + column];
            return std::max({rgb[0], rgb[1], rgb[2]}) >= limit;
        }
        return false;
    };
    for (int y = 0; y < mask.rows; ++y)
        for (int x = 0; x < mask.cols; ++x) mask.at<unsigned char>(y, x) = over(x, y) ? 1 : 0;
    if (raw != nullptr) cv::dilate(mask, mask, cv::Mat::ones(3, 3, CV_8U));
    return mask;
}

cv::Mat upright(const cv::Mat& picture, int flip) {
    cv::Mat result;
    switch (flip) {
        case 3:
            cv::rotate(picture, result, cv::ROTATE_180);
            return result;
        case 5:
            cv::rotate(picture, result, cv::ROTATE_90_COUNTERCLOCKWISE);
            return result;
        case 6:
            cv::rotate(picture, result, cv::ROTATE_90_CLOCKWISE);
            return result;
        default:
            return picture;
    }
}

struct FreeImage {
    void operator()(libraw_processed_image_t* image) const { LibRaw::dcraw_clear_mem(image); }
};

using ProcessedImage = std::unique_ptr<libraw_processed_image_t, FreeImage>;

void require_size(const std::filesystem::path& file, const libraw_data_t& data) {
    const double pixels = static_cast<double>(data.sizes.width) * data.sizes.height;
    if (!(pixels >= 1) || pixels > k_max_photo_pixels) {
        throw InputError(
            file, fmt::format("has {} x {} pixels; up to {:.0f} million are read", data.sizes.width,
                              data.sizes.height, k_max_photo_pixels / 1e6));
    }
}

// 16 bits, linear, with the camera's white balance.
ProcessedImage developed(const std::filesystem::path& file, LibRaw& processor) {
    libraw_output_params_t& params = processor.imgdata.params;
    params.gamm[0] = params.gamm[1] = 1;
    params.no_auto_bright = 1;
    params.adjust_maximum_thr = 0;  // the white level is the file's, not the picture's
    params.output_bps = 16;
    params.output_color = 1;  // sRGB primaries
    params.use_camera_wb = 1;
    params.highlight = 1;  // white balance clips nothing
    params.user_flip = 0;
    require(file, processor.dcraw_process());
    int code = LIBRAW_SUCCESS;
    ProcessedImage image(processor.dcraw_make_mem_image(&code));
    require(file, code);
    if (image == nullptr || image->type != LIBRAW_IMAGE_BITMAP || image->bits != 16 ||
        (image->colors != 3 && image->colors != 1) || image->width == 0 || image->height == 0)
        refuse(file, "an unusual kind");
    return image;
}

}  // namespace

bool has_raw_extension(const std::filesystem::path& file) {
    static constexpr std::array k_known{"dng", "cr2", "cr3", "crw", "nef", "nrw", "arw",
                                        "sr2", "srf", "raf", "rw2", "orf", "pef", "srw",
                                        "raw", "rwl", "3fr", "fff", "iiq", "erf", "mrw",
                                        "x3f", "gpr", "kdc", "dcr", "mef", "mos"};
    const std::string extension = extension_of(file);
    return std::find(k_known.begin(), k_known.end(), extension) != k_known.end();
}

Photo read_raw(const std::filesystem::path& file) {
    const std::string bytes = read_text(file, k_most_bytes);
    // On the heap, because the processor holds large tables.
    const auto processor = std::make_unique<LibRaw>();
    libraw_data_t& data = processor->imgdata;
    open(file, bytes, *processor);
    require_size(file, data);
    require(file, processor->unpack());
    if (data.color.maximum == 0) refuse(file, "it states no white level");
    const cv::Mat mask = saturation_mask(data);
    const int flip = data.sizes.flip;

    const ProcessedImage image = developed(file, *processor);
    // LibRaw scales the white balance's largest multiplier to 1. Undo that, so that green's white
    // level is 1.
    const float most = *std::max_element(data.color.pre_mul, data.color.pre_mul + 3);
    const double green = data.color.pre_mul[1] > 0 ? data.color.pre_mul[1] : most;
    const auto scale = static_cast<float>(most / green / 65535);
    cv::Mat colour(image->height, image->width, CV_32FC3);
    const auto* samples = reinterpret_cast<const unsigned short*>(image->data);
    for (int y = 0; y < colour.rows; ++y) {
        for (int x = 0; x < colour.cols; ++x) {
            const std::size_t at = static_cast<std::size_t>(y) * image->width + x;
            for (int c = 0; c < 3; ++c)
                colour.at<cv::Vec3f>(y, x)[c] =
                    scale * samples[image->colors == 3 ? 3 * at + c : at];
        }
    }
    colour = upright(colour, flip);
    cv::Mat over;
    if (mask.size() == cv::Size(image->width, image->height)) over = upright(mask, flip);

    Photo photo;
    photo.width = colour.cols;
    photo.height = colour.rows;
    const auto* first = colour.ptr<float>();
    photo.rgb.assign(first, first + 3 * colour.total());
    if (!over.empty()) photo.saturated.assign(over.data, over.data + over.total());
    photo.saturation = 1;
    photo.encoding = "linear raw";
    photo.shot = shot_data_of(bytes, data);
    return photo;
}

ShotData read_raw_shot_data(const std::filesystem::path& file) {
    const std::string bytes = read_text(file, k_most_bytes);
    const auto processor = std::make_unique<LibRaw>();
    open(file, bytes, *processor);
    return shot_data_of(bytes, processor->imgdata);
}

}  // namespace culet
