#include "compare/light_probe/cut_to_ball.h"

#include <algorithm>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace culet {

namespace {

// Smallest sigma of an outline, pixels: light beside and behind the ball shifts it to one side,
// which its edges' scatter does not show.
constexpr double k_least_sigma = 0.15;

std::vector<float> shrunk(const float* values, int channels, const Photo& photo,
                          const cv::Rect& cut, int factor) {
    const cv::Mat whole(photo.height, photo.width, CV_32FC(channels), const_cast<float*>(values));
    cv::Mat part = whole(cut).clone();
    if (factor > 1) {
        cv::Mat small;
        cv::resize(part, small, cv::Size(part.cols / factor, part.rows / factor), 0, 0,
                   cv::INTER_AREA);
        part = small;
    }
    const auto* first = part.ptr<float>();
    return {first, first + part.total() * static_cast<std::size_t>(channels)};
}

}  // namespace

CutToBall cut_to_ball(const ProbeView& view, const BallCircle& c, double sigma_px,
                      const ProbeOptions& options, int width) {
    const Photo& photo = view.photo;
    const int factor = std::max(1, static_cast<int>(std::numbers::pi * c.radius / (2.0 * width)));
    const double margin = 2 + 0.03 * c.radius;
    cv::Rect cut;
    cut.x = std::max(0, static_cast<int>(c.x - c.radius - margin));
    cut.y = std::max(0, static_cast<int>(c.y - c.radius - margin));
    cut.width = std::min(photo.width, static_cast<int>(c.x + c.radius + margin) + 1) - cut.x;
    cut.height = std::min(photo.height, static_cast<int>(c.y + c.radius + margin) + 1) - cut.y;
    cut.width -= cut.width % factor;
    cut.height -= cut.height % factor;
    auto small = std::make_shared<Photo>();
    small->width = cut.width / factor;
    small->height = cut.height / factor;
    small->rgb = shrunk(photo.rgb.data(), 3, photo, cut, factor);
    std::vector<float> saturated = photo.saturated;
    if (saturated.empty() && photo.saturation > 0) {
        saturated.resize(photo.rgb.size() / 3);
        const auto clip = static_cast<float>(0.99 * photo.saturation);
        for (std::size_t i = 0; i < saturated.size(); ++i) {
            saturated[i] =
                std::max({photo.rgb[3 * i], photo.rgb[3 * i + 1], photo.rgb[3 * i + 2]}) >= clip;
        }
    }
    if (!saturated.empty()) small->saturated = shrunk(saturated.data(), 1, photo, cut, factor);

    CutToBall result;
    result.name = view.name;
    result.factor = factor;
    result.left = cut.x;
    result.top = cut.y;
    const PixelPlace principal =
        view.principal.value_or(PixelPlace{(photo.width - 1) / 2.0, (photo.height - 1) / 2.0});
    const PixelPlace middle = result.in_cut({c.x, c.y});
    result.prior.circle = {middle.x, middle.y, c.radius / factor};
    result.prior.circle_sigma_px = std::max(k_least_sigma, 2 * sigma_px) / factor;
    result.prior.principal = result.in_cut(principal);
    result.prior.focal_px = options.distance > 0 ? 0 : view.focal_px / factor;
    result.prior.distance = options.distance;
    result.picture = std::move(small);
    return result;
}

}  // namespace culet
