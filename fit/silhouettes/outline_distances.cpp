#include "fit/silhouettes/outline_distances.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace culet {

PlacedContour placed(const FlatContour& contour, const FrameMotion& motion) {
    const Vec3 across = motion.turned(contour.across), along = motion.turned(contour.along);
    return {across, along, glm::dot(motion.shift, across), glm::dot(motion.shift, along), {}};
}

PlacedContour Viewpoints::placed(std::span<const FlatContour> contours, std::size_t contour) const {
    if (series.turns.empty()) {
        return culet::placed(contours[contour], motions[std::size_t(contours[contour].set)]);
    }
    const PictureAxes axes = picture_axes(series.camera, series.turns[contour]);
    return {axes.across, axes.along, -axes.dx, -axes.dy, axes.nearing};
}

OutlineDistances outline_distances(std::span<const Vec3> corners,
                                   std::span<const FlatContour> contours, const Viewpoints& from) {
    OutlineDistances all;
    all.outlines.reserve(contours.size());
    all.nearest.reserve(contours.size());
    for (std::size_t c = 0; c < contours.size(); ++c) {
        const FlatContour& contour = contours[c];
        const PlacedContour place = from.placed(contours, c);
        ProjectedOutline outline =
            projected_outline(corners, place.across, place.along, place.nearing);
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

double inlier_weight(double distance, double scale, const OutlierRule& rule) {
    const double size = std::abs(distance), sure = rule.sure * scale, outlier = 1.75 * sure;
    if (size <= sure) return 1;
    if (rule.reach > outlier) return size > rule.reach ? 0 : sure / size;
    return size >= outlier ? 0 : (outlier - size) / (outlier - sure);
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
