#include "compare/reflexes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <vector>

#include "compare/pixels.h"

namespace culet {

namespace {

constexpr double k_bright_share = 0.9;    // of the pixels are darker than a reflex
constexpr double k_least_extent = 0.007;  // of the diameter
constexpr double k_reach = 0.02;          // of the diameter
constexpr double k_area_factor = 3;

struct Reflex {
    cv::Point2d middle;
    double area = 0;
};

std::vector<Reflex> reflexes_in(const cv::Mat& light, const cv::Mat& mask, double level,
                                double least_area) {
    const cv::Mat bright = (light > level) & mask;
    cv::Mat labels, stats, middles;
    const int count = cv::connectedComponentsWithStats(bright, labels, stats, middles, 8, CV_32S);
    std::vector<Reflex> reflexes;
    for (int i = 1; i < count; ++i) {
        const double area = stats.at<int>(i, cv::CC_STAT_AREA);
        if (area < least_area) continue;
        reflexes.push_back({{middles.at<double>(i, 0), middles.at<double>(i, 1)}, area});
    }
    return reflexes;
}

}  // namespace

std::optional<ReflexMatch> match_reflexes(const MatchedPictures& pictures) {
    cv::Mat photo = luminance(pictures.photo), render = luminance(pictures.render);
    cv::min(photo, pictures.white, photo);
    cv::min(render, pictures.white, render);
    const double level = quantile(photo, pictures.mask, k_bright_share);
    const double extent = std::max(1.5, k_least_extent * pictures.diameter);
    const auto a = reflexes_in(photo, pictures.mask, level, extent * extent);
    const auto b = reflexes_in(render, pictures.mask, level, extent * extent);
    if (a.empty()) return std::nullopt;

    const double reach = k_reach * pictures.diameter;
    std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) {
            const double apart = cv::norm(a[i].middle - b[j].middle);
            const double ratio = a[i].area / b[j].area;
            if (apart <= reach && ratio <= k_area_factor && ratio >= 1 / k_area_factor) {
                pairs.emplace_back(apart, i, j);
            }
        }
    }
    std::sort(pairs.begin(), pairs.end());
    std::vector<bool> a_taken(a.size()), b_taken(b.size());
    std::vector<double> distances;
    double common = 0, all = 0;
    for (const auto& [apart, i, j] : pairs) {
        if (a_taken[i] || b_taken[j]) continue;
        a_taken[i] = b_taken[j] = true;
        distances.push_back(apart);
        common += a[i].area + b[j].area;
    }
    for (const Reflex& reflex : a) all += reflex.area;
    for (const Reflex& reflex : b) all += reflex.area;

    ReflexMatch match;
    match.in_photo = static_cast<int>(a.size());
    match.in_render = static_cast<int>(b.size());
    match.matched = static_cast<int>(distances.size());
    match.f1 = 2.0 * match.matched / (match.in_photo + match.in_render);
    match.area_f1 = common / all;
    if (!distances.empty()) {
        const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
        std::nth_element(distances.begin(), middle, distances.end());
        match.displacement = *middle / pictures.diameter;
    }
    return match;
}

}  // namespace culet
