#include "compare/photo/response.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/photo.hpp>

#include "render/colour/colour.h"
#include "stone/errors.h"

namespace culet {

namespace {

// The value of the 8-bit file that read_photo decoded; exact.
int code_of(float linear) {
    return std::clamp(static_cast<int>(std::lround(255 * srgb_encoded(linear))), 0, 255);
}

}  // namespace

ResponseCurve find_response(const std::vector<BracketShot>& shots) {
    std::vector<cv::Mat> pictures;
    std::vector<float> times;
    for (const BracketShot& shot : shots) {
        cv::Mat picture(shot.photo.height, shot.photo.width, CV_8UC3);
        for (int y = 0; y < picture.rows; ++y) {
            for (int x = 0; x < picture.cols; ++x) {
                const std::size_t at = 3 * (static_cast<std::size_t>(y) * shot.photo.width + x);
                for (int c = 0; c < 3; ++c)
                    picture.at<cv::Vec3b>(y, x)[c] =
                        static_cast<unsigned char>(code_of(shot.photo.rgb[at + c]));
            }
        }
        pictures.push_back(picture);
        times.push_back(static_cast<float>(shot.exposure / shots[0].exposure));
    }
    cv::Mat response;
    try {
        cv::createCalibrateDebevec(200, 10.0f, false)->process(pictures, response, times);
    } catch (const cv::Exception&) {
        response.release();
    }
    if (response.total() != 256 || response.channels() != 3)
        throw InputError("the camera's response cannot be found from this series");
    ResponseCurve curve;
    for (std::size_t c = 0; c < 3; ++c) {
        float highest = 0;
        for (int v = 0; v < 256; ++v) {
            const float value = response.at<cv::Vec3f>(v)[static_cast<int>(c)];
            if (!std::isfinite(value) || value < 0)
                throw InputError("the camera's response cannot be found from this series");
            highest = std::max(highest, value);
            curve[c][static_cast<std::size_t>(v)] = highest;
        }
    }
    // The solution is known up to a factor a channel. Grey is grey: the middle values are those of
    // the sRGB curve, which keeps the camera's white balance; then green's end is 1.
    std::array<float, 3> middle{};
    for (std::size_t c = 0; c < 3; ++c) middle[c] = curve[c][128];
    for (std::size_t c = 0; c < 3; ++c) {
        if (!(middle[c] > 0))
            throw InputError("the camera's response cannot be found from this series");
        for (float& v : curve[c]) v *= middle[1] / middle[c];
    }
    const float end = curve[1][255];
    for (auto& channel : curve)
        for (float& v : channel) v /= end;
    return curve;
}

void apply_response(const ResponseCurve& curve, Photo& photo) {
    for (std::size_t i = 0; i < photo.rgb.size(); ++i)
        photo.rgb[i] = curve[i % 3][static_cast<std::size_t>(code_of(photo.rgb[i]))];
}

}  // namespace culet
