#include "compare/turntable/flat_ground.h"

#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace culet {

namespace {

// Pixels beside the stone: from here on its blur and its halo are over, to there is its shadow.
constexpr int k_from = 12, k_to = 36;
// Levels: what JPEG leaves of one colour. Part of the ground that may be of another.
constexpr int k_same = 2;
constexpr double k_others = 0.05;

cv::Mat disc(int radius) {
    return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
}

}  // namespace

bool has_flat_ground(const LevelPicture& picture, const std::vector<glm::dvec2>& stone) {
    if (stone.empty()) return false;
    cv::Mat mask(picture.height, picture.width, CV_8U, cv::Scalar(0)), near, far;
    std::vector<cv::Point> corners;
    for (const glm::dvec2& c : stone)
        corners.emplace_back(int(std::lround(c.x + (picture.width - 1) / 2.0)),
                             int(std::lround((picture.height - 1) / 2.0 - c.y)));
    cv::fillConvexPoly(mask, corners, cv::Scalar(255));
    cv::dilate(mask, near, disc(k_from));
    cv::dilate(mask, far, disc(k_to));
    cv::Mat ground = far & ~near, grey;
    const cv::Mat levels(picture.height, picture.width, CV_8UC3,
                         const_cast<std::uint8_t*>(picture.rgb.data()));
    cv::cvtColor(levels, grey, cv::COLOR_RGB2GRAY);
    std::array<int, 256> counts{};
    int all = 0;
    for (int i = 0; i < int(grey.total()); ++i) {
        if (ground.data[i] == 0) continue;
        ++counts[grey.data[i]];
        ++all;
    }
    int most = 0;
    for (int level = k_same; level + k_same < 256; ++level) {
        int alike = 0;
        for (int l = level - k_same; l <= level + k_same; ++l) alike += counts[std::size_t(l)];
        most = std::max(most, alike);
    }
    return all > 0 && most > (1 - k_others) * all;
}

}  // namespace culet
