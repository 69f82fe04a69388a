#include "compare/photo/response.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/photo.hpp>
#include <vector>

#include "render/colour/colour.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Pixels in the fit, and the weight of the curve's smoothness. The time grows with the square of
// the number; more would take seconds.
constexpr int k_samples = 200;
constexpr float k_smoothness = 10;

// Recovers an 8-bit file's values from those of read_photo. Exact: two values are never as near as
// two places of the table (1 / (255 * 12.92) in the dark).
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
    // One curve for all channels, which respond alike in cameras. The unknown factor of separate
    // curves would be a wrong white balance.
    std::vector<cv::Mat> pictures;
    std::vector<float> times;
    for (std::size_t k = 0; k < shots.size(); ++k) {
        const auto pixels = shots[k].rgb.size() / 3;
        cv::Mat picture(3 * shots[k].height, shots[k].width, CV_8UC1);
        for (std::size_t i = 0; i < shots[k].rgb.size(); ++i)
            picture.data[i % 3 * pixels + i / 3] = values.of(shots[k].rgb[i]);
        pictures.push_back(picture);
        times.push_back(static_cast<float>(exposures[k] / exposures[0]));
    }
    cv::Mat response;
    try {
        cv::createCalibrateDebevec(k_samples, k_smoothness, false)
            ->process(pictures, response, times);
    } catch (const cv::Exception&) {
        response.release();
    }
    const InputError unknown("the camera's response cannot be found from this series");
    if (response.total() != 256 || response.channels() != 1) throw unknown;
    std::array<float, 256> light{};
    float highest = 0;
    for (int v = 0; v < 256; ++v) {
        const float value = response.at<float>(v);
        if (!std::isfinite(value) || value < 0) throw unknown;
        highest = std::max(highest, value);
        light[static_cast<std::size_t>(v)] = highest;
    }
    if (!(highest > 0)) throw unknown;
    for (float& v : light) v /= highest;
    return {light, light, light};
}

void apply_response(const ResponseCurve& curve, Photo& photo) {
    const FileValues values;
    for (std::size_t i = 0; i < photo.rgb.size(); i += 3) {
        for (std::size_t c = 0; c < 3; ++c)
            photo.rgb[i + c] = curve[c][values.of(photo.rgb[i + c])];
    }
}

}  // namespace culet
