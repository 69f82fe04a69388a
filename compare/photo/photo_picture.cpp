#include "compare/photo/photo_picture.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "compare/photo/pixels.h"
#include "render/image/image_exr.h"

namespace culet {

namespace {

// IEEE 754 binary16: 10 bits of fraction, from 2^-14 to 65504.
constexpr int k_half_fraction = 10, k_half_least_exponent = -14;
constexpr float k_half_most = 65504;
// Largest share of the variance that rounding may add.
constexpr double k_share = 1.0 / 16;

bool fits_half_floats(const Photo& photo) {
    if (photo.variance.size() != photo.rgb.size()) return false;
    for (std::size_t i = 0; i < photo.rgb.size(); ++i) {
        const float value = photo.rgb[i];
        if (value > k_half_most) return false;
        const int exponent = value > 0 ? std::ilogb(value) : k_half_least_exponent;
        const double step =
            std::ldexp(1.0, std::max(exponent, k_half_least_exponent) - k_half_fraction);
        // Uniformly distributed: step^2 / 12.
        if (step * step / 12 > k_share * photo.variance[i]) return false;
    }
    return true;
}

// Keeps six bits of a variance: it rests on a guess of the camera, and more would be noise that
// does not compress.
float rounded(float variance) {
    constexpr float k_steps = 64;
    int exponent = 0;
    const float fraction = std::frexp(variance, &exponent);
    return std::ldexp(std::nearbyint(fraction * k_steps) / k_steps, exponent);
}

}  // namespace

Picture picture_of(Photo photo) {
    Picture picture;
    picture.width = photo.width;
    picture.height = photo.height;
    picture.samples = fits_half_floats(photo) ? Picture::Samples::half : Picture::Samples::single;
    picture.rgb = std::move(photo.rgb);
    picture.coverage = std::move(photo.coverage);
    for (std::size_t c = 0; c < k_variance_channels.size() && !photo.variance.empty(); ++c) {
        std::vector<float> plane(picture.pixels());
        for (std::size_t i = 0; i < plane.size(); ++i)
            plane[i] = rounded(photo.variance[3 * i + c]);
        picture.planes.push_back({k_variance_channels[c], std::move(plane)});
    }
    if (!photo.saturated.empty())
        picture.planes.push_back({"saturated", std::move(photo.saturated)});
    return picture;
}

std::string png_of(const Photo& photo) {
    cv::Mat bytes;
    encoded(colour_of(photo)).convertTo(bytes, CV_8U, 255);
    return png_bytes(bytes);
}

}  // namespace culet
