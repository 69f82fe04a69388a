#include "compare/refine/picture_misfit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"

namespace culet {

namespace {

// For normal noise one sample in three million exceeds this; a stone has twenty thousand.
constexpr double k_deviations = 5;
constexpr double k_least_area = 0.001;  // of the stone; smaller areas are dust
constexpr std::size_t k_most = 5;

}  // namespace

EvidenceFit picture_misfit(const cv::Mat& difference, const cv::Mat& mask) {
    EvidenceFit fit;
    const double samples = std::max(1, cv::countNonZero(mask));
    fit.rms = cv::norm(difference, cv::NORM_L2, mask) / std::sqrt(samples);
    const double usual = 1.4826 * quantile(cv::abs(difference), mask, 0.5);
    if (!(usual > 0)) return fit;
    for (const bool brighter : {true, false}) {
        const cv::Mat far =
            ((brighter ? difference : cv::Mat(-difference)) > k_deviations * usual) & mask;
        cv::Mat labels, stats, centroids;
        const int count = cv::connectedComponentsWithStats(far, labels, stats, centroids);
        for (int k = 1; k < count; ++k) {
            const int area = stats.at<int>(k, cv::CC_STAT_AREA);
            if (area < k_least_area * samples) continue;
            const double mean = std::abs(cv::mean(difference, labels == k)[0]);
            fit.contradictions.push_back({centroids.at<double>(k, 0), centroids.at<double>(k, 1),
                                          "", brighter, mean / usual, area / samples});
        }
    }
    std::sort(
        fit.contradictions.begin(), fit.contradictions.end(),
        [](const auto& a, const auto& b) { return a.deviations * a.area > b.deviations * b.area; });
    if (fit.contradictions.size() > k_most) fit.contradictions.resize(k_most);
    return fit;
}

std::string facet_seen_at(const Scene& scene, double x, double y) {
    const EyeRay ray = EyeRays(scene.camera).through(x, y);
    double entered = 0;
    std::string seen;
    for (const Facet& facet : scene.stone.solid.facets) {
        const double towards = glm::dot(facet.plane.normal, ray.direction);
        if (!(towards < 0)) continue;
        const double at = (facet.plane.offset - glm::dot(facet.plane.normal, ray.origin)) / towards;
        if (!seen.empty() && at <= entered) continue;
        entered = at;
        seen = facet.name;
    }
    return seen;
}

}  // namespace culet
