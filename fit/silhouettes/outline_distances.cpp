#include "fit/silhouettes/outline_distances.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace culet {

PlacedContour placed(const FlatContour& contour, const FrameMotion& motion) {
    const Vec3 across = motion.turned(contour.across), along = motion.turned(contour.along);
    return {across, along, glm::dot(motion.shift, across), glm::dot(motion.shift, along)};
}

OutlineDistances outline_distances(std::span<const Vec3> corners,
                                   std::span<const FlatContour> contours,
                                   std::span<const FrameMotion> motions) {
    OutlineDistances all;
    all.outlines.reserve(contours.size());
    all.nearest.reserve(contours.size());
    for (const FlatContour& contour : contours) {
        const PlacedContour place = placed(contour, motions[std::size_t(contour.set)]);
        ProjectedOutline outline = projected_outline(corners, place.across, place.along);
        std::vector<ProjectedOutline::Nearest> nearest;
        nearest.reserve(contour.points.size());
        for (const auto& [x, y] : contour.points) {
            nearest.push_back(outline.nearest(x + place.dx, y + place.dy));
        }
        all.outlines.push_back(std::move(outline));
        all.nearest.push_back(std::move(nearest));
    }
    return all;
}

double robust_scale(const OutlineDistances& distances, std::span<const FlatContour> contours,
                    int set) {
    std::vector<double> sizes;
    for (std::size_t c = 0; c < contours.size(); ++c) {
        if (contours[c].set != set) continue;
        for (std::size_t i = 0; i < distances.nearest[c].size(); ++i) {
            // Weighted distances share one sigma.
            sizes.push_back(std::sqrt(contours[c].weights[i]) *
                            std::abs(distances.nearest[c][i].distance));
        }
    }
    if (sizes.empty()) return 0;
    const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return 1.4826 * *middle;
}

double inlier_weight(double distance, double scale, double reach) {
    const double size = std::abs(distance);
    if (size <= k_sure * scale) return 1;
    if (reach > k_outlier * scale) return size > reach ? 0 : k_sure * scale / size;
    return size >= k_outlier * scale ? 0
                                     : (k_outlier * scale - size) / ((k_outlier - k_sure) * scale);
}

SilhouetteMisfit misfit_of(const OutlineDistances& distances, std::span<const FlatContour> contours,
                           int set) {
    SilhouetteMisfit misfit;
    const double scale = robust_scale(distances, contours, set);
    double squares = 0, weights = 0;
    for (std::size_t c = 0; c < contours.size(); ++c) {
        if (contours[c].set != set) continue;
        ++misfit.contours;
        for (std::size_t i = 0; i < distances.nearest[c].size(); ++i) {
            const double d = distances.nearest[c][i].distance, w = contours[c].weights[i];
            const double counts = inlier_weight(std::sqrt(w) * d, scale);
            if (counts < 0.5) {
                ++misfit.outliers;
                continue;
            }
            ++misfit.points;
            squares += w * d * d;
            weights += w;
            misfit.worst = std::max(misfit.worst, std::abs(d));
        }
    }
    if (weights > 0) misfit.rms = std::sqrt(squares / weights);
    return misfit;
}

}  // namespace culet
