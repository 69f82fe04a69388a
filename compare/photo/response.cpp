#include "compare/photo/response.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/photo.hpp>
#include <vector>

#include "render/colour/colour.h"
#include "stone/errors.h"

namespace culet {

namespace {

// The values of an 8-bit file from what read_photo made of them; exact: two of them are never as
// near to each other as two places of the table (1 / (255 * 12.92) where it is dark).
class FileValues {
public:
    FileValues() : codes_(k_places + 1) {
        for (std::size_t code = 0; code < 256; ++code)
            codes_[place(static_cast<float>(srgb_decoded(static_cast<double>(code) / 255)))] =
                static_cast<unsigned char>(code);
    }
    unsigned char of(float linear) const { return codes_[place(linear)]; }

private:
    static constexpr int k_places = 8192;
    static std::size_t place(float linear) {
        return static_cast<std::size_t>(std::clamp(linear, 0.0f, 1.0f) * k_places + 0.5f);
    }
    std::vector<unsigned char> codes_;
};

}  // namespace

ResponseCurve find_response(const std::vector<Photo>& shots, const std::vector<double>& exposures) {
    const FileValues values;
    std::vector<cv::Mat> pictures;
    std::vector<float> times;
    for (std::size_t k = 0; k < shots.size(); ++k) {
        cv::Mat picture(shots[k].height, shots[k].width, CV_8UC3);
        for (std::size_t i = 0; i < shots[k].rgb.size(); ++i)
            picture.data[i] = values.of(shots[k].rgb[i]);
        pictures.push_back(picture);
        times.push_back(static_cast<float>(exposures[k] / exposures[0]));
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
    const FileValues values;
    for (std::size_t i = 0; i < photo.rgb.size(); i += 3) {
        for (std::size_t c = 0; c < 3; ++c)
            photo.rgb[i + c] = curve[c][values.of(photo.rgb[i + c])];
    }
}

}  // namespace culet
