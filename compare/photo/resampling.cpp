#include "compare/photo/resampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "stone/text/errors.h"

namespace culet {

namespace {

struct Taps {
    int first = 0;  // index of the first sample
    std::array<float, 4> weight{};
};

Taps taps_at(double position, Kernel kernel) {
    const double cell = std::floor(position);
    const double t = position - cell;
    if (kernel == Kernel::linear) {
        return {static_cast<int>(cell), {static_cast<float>(1 - t), static_cast<float>(t), 0, 0}};
    }
    // Catmull and Rom (1974), the interpolating cubic with slope (next - previous) / 2.
    const double t2 = t * t, t3 = t2 * t;
    return {
        static_cast<int>(cell) - 1,
        {static_cast<float>(-0.5 * t + t2 - 0.5 * t3), static_cast<float>(1 - 2.5 * t2 + 1.5 * t3),
         static_cast<float>(0.5 * t + 2 * t2 - 1.5 * t3),
         static_cast<float>(-0.5 * t2 + 0.5 * t3)}};
}

}  // namespace

cv::Mat resampled(const cv::Mat& source, const cv::Matx23d& source_from_target,
                  cv::Size target_size, Kernel kernel, Beyond beyond) {
    check(source.depth() == CV_32F && !source.empty(), "resampling needs float samples");
    const int channels = source.channels(), count = kernel == Kernel::linear ? 2 : 4;
    cv::Mat target(target_size, source.type());
    // Clamps positions to the range of int; their samples are beyond the border anyway.
    const auto bounded = [](double position) { return std::clamp(position, -1e8, 1e8); };
    for (int y = 0; y < target.rows; ++y) {
        float* out = target.ptr<float>(y);
        for (int x = 0; x < target.cols; ++x, out += channels) {
            const cv::Vec2d at = source_from_target * cv::Vec3d(x, y, 1);
            const Taps across = taps_at(bounded(at[0]), kernel),
                       down = taps_at(bounded(at[1]), kernel);
            std::array<float, 4> sum{};
            for (int j = 0; j < count; ++j) {
                const int row = std::clamp(down.first + j, 0, source.rows - 1);
                if (beyond == Beyond::nothing && row != down.first + j) continue;
                const float* line = source.ptr<float>(row);
                for (int i = 0; i < count; ++i) {
                    const int column = std::clamp(across.first + i, 0, source.cols - 1);
                    if (beyond == Beyond::nothing && column != across.first + i) continue;
                    const float weight = down.weight[static_cast<std::size_t>(j)] *
                                         across.weight[static_cast<std::size_t>(i)];
                    for (int c = 0; c < channels; ++c) {
                        sum[static_cast<std::size_t>(c)] += weight * line[column * channels + c];
                    }
                }
            }
            for (int c = 0; c < channels; ++c) {
                out[c] = std::max(0.0f, sum[static_cast<std::size_t>(c)]);
            }
        }
    }
    return target;
}

cv::Mat resampled_mask(const cv::Mat& mask, const cv::Matx23d& source_from_target,
                       cv::Size target_size) {
    cv::Mat soft;
    mask.convertTo(soft, CV_32F, 1.0 / 255);
    return resampled(soft, source_from_target, target_size, Kernel::linear, Beyond::nothing) > 0.5;
}

}  // namespace culet
