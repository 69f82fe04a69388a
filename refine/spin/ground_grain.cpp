#include "refine/spin/ground_grain.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <opencv2/imgproc.hpp>

namespace culet {

namespace {

// Pixels: detail smaller than the first is noise, larger than the second is light and shadow.
constexpr double k_noise = 0.8, k_light = 4;
constexpr int k_beside_stone = 14;  // pixels: caustics and the shadow's sharp rim
constexpr double k_most_levels = 12;

double correlation(const std::vector<GroundLandmark>& landmarks, const cv::Mat& grain,
                   const GroundView& view) {
    double ab = 0, aa = 0, bb = 0;
    for (const GroundLandmark& l : landmarks) {
        const double level = grain_at(grain, view.in_picture(l.place));
        if (!std::isfinite(level)) continue;
        ab += l.level * level;
        aa += l.level * l.level;
        bb += level * level;
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

}  // namespace

cv::Mat ground_grain(const LevelPicture& picture, const std::vector<glm::dvec2>& stone) {
    const cv::Mat levels(picture.height, picture.width, CV_8UC3,
                         const_cast<std::uint8_t*>(picture.rgb.data()));
    cv::Mat grey, fine, light, mask(levels.size(), CV_8U, cv::Scalar(0));
    cv::cvtColor(levels, grey, cv::COLOR_RGB2GRAY);
    grey.convertTo(grey, CV_32F);
    cv::GaussianBlur(grey, fine, {0, 0}, k_noise);
    cv::GaussianBlur(grey, light, {0, 0}, k_light);
    cv::Mat grain = cv::max(cv::min(fine - light, k_most_levels), -k_most_levels);
    std::vector<cv::Point> corners;
    for (const glm::dvec2& c : stone)
        corners.emplace_back(int(std::lround(c.x + (picture.width - 1) / 2.0)),
                             int(std::lround((picture.height - 1) / 2.0 - c.y)));
    if (!corners.empty()) cv::fillConvexPoly(mask, corners, cv::Scalar(255));
    const int size = 2 * k_beside_stone + 1;
    cv::dilate(mask, mask, cv::getStructuringElement(cv::MORPH_ELLIPSE, {size, size}));
    grain.setTo(std::nanf(""), mask);
    return grain;
}

double grain_at(const cv::Mat& grain, const glm::dvec2& place) {
    const double x = place.x + (grain.cols - 1) / 2.0, y = (grain.rows - 1) / 2.0 - place.y;
    if (!(x >= 0 && y >= 0 && x < grain.cols - 1 && y < grain.rows - 1)) return NAN;
    const int column = int(x), row = int(y);
    const double u = x - column, v = y - row;
    const float *above = grain.ptr<float>(row) + column,
                *below = grain.ptr<float>(row + 1) + column;
    return (1 - v) * ((1 - u) * double(above[0]) + u * double(above[1])) +
           v * ((1 - u) * double(below[0]) + u * double(below[1]));
}

glm::dvec2 GroundView::in_picture(const glm::dvec2& on_ground) const {
    const Vec3 place(on_ground.x, on_ground.y, -depth_);
    const double near = 1 - glm::dot(axes_.nearing, place);
    return {axes_.dx + glm::dot(axes_.across, place) / near,
            axes_.dy + glm::dot(axes_.along, place) / near};
}

glm::dvec2 GroundView::on_ground(const glm::dvec2& in_picture) const {
    const double x = in_picture.x - axes_.dx, y = in_picture.y - axes_.dy;
    const Vec3 a = axes_.across + x * axes_.nearing, b = axes_.along + y * axes_.nearing;
    const glm::dmat2 columns({a.x, b.x}, {a.y, b.y});
    return glm::inverse(columns) * glm::dvec2(x + depth_ * a.z, y + depth_ * b.z);
}

GroundMatch best_match(const std::vector<GroundLandmark>& landmarks, const cv::Mat& grain,
                       const TurningCamera& camera, double depth, double about, double reach,
                       double step) {
    GroundMatch best{about, -1};
    for (double off = -reach; off <= reach; off += step) {
        const double found = correlation(landmarks, grain, GroundView(camera, about + off, depth));
        if (found > best.correlation) best = {about + off, found};
    }
    return best;
}

}  // namespace culet
