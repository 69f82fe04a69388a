#include "compare/registration/silhouette.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/pixels.h"
#include "compare/registration/background.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

// Below 32 pixels across, the scores' finest blur (1 % of the diameter) is a third of a pixel, and
// an outline good to half a pixel gives the scale only to 3 %.
constexpr double k_smallest_diameter_px = 32;

void measure(Silhouette& silhouette) {
    const cv::Moments m = cv::moments(silhouette.mask, true);
    if (m.m00 <= 0) return;
    silhouette.centre = {m.m10 / m.m00, m.m01 / m.m00};
    silhouette.diameter = 2 * std::sqrt(m.m00 / std::numbers::pi);
    std::vector<std::vector<cv::Point>> outlines;
    cv::findContours(silhouette.mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
    double sum = 0, sum_squares = 0, count = 0;
    for (const auto& outline : outlines) {
        for (const cv::Point& p : outline) {
            const double r = std::hypot(p.x - silhouette.centre.x, p.y - silhouette.centre.y);
            sum += r;
            sum_squares += r * r;
            ++count;
        }
    }
    const double variance = sum_squares / count - (sum / count) * (sum / count);
    silhouette.out_of_round = std::sqrt(std::max(0.0, variance)) / silhouette.diameter;
}

void judge(Silhouette& silhouette, const std::string& none) {
    if (silhouette.diameter <= 0) {
        silhouette.trouble = none;
        return;
    }
    if (silhouette.diameter < k_smallest_diameter_px) {
        silhouette.trouble = fmt::format(
            "the stone is only {:.0f} pixels across: at least {:.0f} "
            "are needed",
            silhouette.diameter, k_smallest_diameter_px);
    }
}

// The share of the picture's border that the mask covers; a holder that runs out of the picture
// covers little.
double touching_share(const cv::Mat& mask) {
    const int w = mask.cols, h = mask.rows;
    const int touching = cv::countNonZero(mask.row(0)) + cv::countNonZero(mask.row(h - 1)) +
                         cv::countNonZero(mask.col(0)) + cv::countNonZero(mask.col(w - 1));
    return static_cast<double>(touching) / (2.0 * (w + h));
}

// A low threshold finds the foot of the outline's slope. Moves the whole outline by the median
// distance of the steepest places along its normals: a single offset, so that dark facets along the
// girdle cannot dent it.
cv::Mat settled(const cv::Mat& mask, const Differing& found) {
    const cv::Mat distance = signed_distance(mask);
    // The foot of a blurred edge is up to two sigma outside it.
    const double outward = 1.5, inward = 2 * found.blur + 1.5;
    std::vector<double> offsets;
    for (int y = 1; y + 1 < mask.rows; ++y) {
        for (int x = 1; x + 1 < mask.cols; ++x) {
            if (std::abs(distance.at<float>(y, x)) > 0.5f) continue;
            cv::Point2d normal(distance.at<float>(y, x + 1) - distance.at<float>(y, x - 1),
                               distance.at<float>(y + 1, x) - distance.at<float>(y - 1, x));
            const double length = cv::norm(normal);
            if (!(length > 0.5)) continue;
            normal *= 1 / length;
            const auto at = [&](double step) {
                return static_cast<float>(
                    between_pixels(found.difference, x + step * normal.x, y + step * normal.y));
            };
            float steepest = 0;
            double where = 0;
            for (double step = outward; step >= -inward; step -= 0.25) {
                const float slope = at(step - 0.5) - at(step + 0.5);
                if (slope <= steepest) continue;
                steepest = slope;
                where = step;
            }
            // Facets as dark as the ground have no edge.
            if (steepest < found.threshold / 2) continue;
            offsets.push_back(where + static_cast<double>(distance.at<float>(y, x)));
        }
    }
    if (offsets.size() < 32) return mask;
    return distance < upper_median(std::move(offsets));
}

// The largest connected part, plus parts of at least 1/200 of its area within a quarter of the
// stone's extent: bright facets in a dark box are islands.
std::vector<cv::Point> joined_parts(const cv::Mat& differs) {
    cv::Mat labels, stats, centres;
    const int count = cv::connectedComponentsWithStats(differs, labels, stats, centres);
    int largest = 0;
    for (int i = 1; i < count; ++i) {
        if (largest == 0 ||
            stats.at<int>(i, cv::CC_STAT_AREA) > stats.at<int>(largest, cv::CC_STAT_AREA)) {
            largest = i;
        }
    }
    std::vector<cv::Point> points;
    if (largest == 0) return points;
    const auto box_of = [&](int i) {
        return cv::Rect(stats.at<int>(i, cv::CC_STAT_LEFT), stats.at<int>(i, cv::CC_STAT_TOP),
                        stats.at<int>(i, cv::CC_STAT_WIDTH), stats.at<int>(i, cv::CC_STAT_HEIGHT));
    };
    std::vector<bool> taken(static_cast<std::size_t>(count), false);
    taken[static_cast<std::size_t>(largest)] = true;
    cv::Rect extent = box_of(largest);
    const int least_area = stats.at<int>(largest, cv::CC_STAT_AREA) / 200;
    for (bool grew = true; grew;) {
        grew = false;
        const int reach = std::max(extent.width, extent.height) / 4;
        const cv::Rect near(extent.x - reach, extent.y - reach, extent.width + 2 * reach,
                            extent.height + 2 * reach);
        for (int i = 1; i < count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            if (taken[k] || stats.at<int>(i, cv::CC_STAT_AREA) < least_area) continue;
            if ((near & box_of(i)) != box_of(i)) continue;
            taken[k] = true;
            grew = true;
            extent |= box_of(i);
        }
    }
    for (int y = 0; y < labels.rows; ++y) {
        const int* label = labels.ptr<int>(y);
        for (int x = 0; x < labels.cols; ++x) {
            if (taken[static_cast<std::size_t>(label[x])] && label[x] != 0)
                points.emplace_back(x, y);
        }
    }
    return points;
}

}  // namespace

Silhouette silhouette_from_coverage(const cv::Mat& coverage, const std::string& source) {
    Silhouette silhouette;
    silhouette.source = source;
    silhouette.mask = coverage > 0.5;
    measure(silhouette);
    judge(silhouette, source == "mask" ? "the mask is empty: paint the stone white"
                                       : "the picture's alpha channel is empty");
    return silhouette;
}

Silhouette silhouette_from_background(const cv::Mat& colour) {
    Silhouette silhouette;
    silhouette.source = "background";
    silhouette.mask = cv::Mat::zeros(colour.size(), CV_8U);
    const std::string none = "no stone stands out from the background: give a mask with --mask";
    if (std::min(colour.cols, colour.rows) < 8) {
        silhouette.trouble = none;
        return silhouette;
    }
    // Normalise the exposure before differences are assessed.
    const double bright = quantile(luminance(colour), {}, 0.995);
    if (!(bright > 0)) {
        silhouette.trouble = "the picture is black: no stone can be seen";
        return silhouette;
    }
    const cv::Mat scaled = colour * (1.0 / bright);
    const Differing found = differing(encoded(scaled));
    cv::Mat differs = found.mask;
    // Remove single hot pixels, then close gaps of up to 3 % of the picture.
    const int reach = std::max(1, std::min(colour.cols, colour.rows) * 3 / 200);
    const auto disc = [](int radius) {
        return cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * radius + 1, 2 * radius + 1});
    };
    cv::medianBlur(differs, differs, 3);
    cv::morphologyEx(differs, differs, cv::MORPH_CLOSE, disc(reach), {-1, -1}, 1,
                     cv::BORDER_CONSTANT, cv::Scalar(0));
    const std::vector<cv::Point> parts = joined_parts(differs);
    if (parts.size() < 3) {
        silhouette.trouble = none;
        return silhouette;
    }
    std::vector<cv::Point> hull;
    cv::convexHull(parts, hull);
    cv::fillConvexPoly(silhouette.mask, hull, cv::Scalar(255));
    silhouette.mask = settled(silhouette.mask, found);
    measure(silhouette);
    judge(silhouette, none);
    const double filled =
        static_cast<double>(parts.size()) / std::max(1, cv::countNonZero(silhouette.mask));
    if (touching_share(silhouette.mask) > 0.02) {
        silhouette.warning = "the stone runs out of the picture, or the background is not plain";
    } else if (filled < 0.6) {
        silhouette.warning = "only part of the outline stands out from the background";
    }
    return silhouette;
}

cv::Mat signed_distance(const cv::Mat& mask) {
    cv::Mat inside, outside, distance;
    cv::distanceTransform(mask, inside, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
    cv::distanceTransform(255 - mask, outside, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
    // Both distances are to the nearest pixel's centre; the outline is half way.
    cv::Mat is_inside;
    mask.convertTo(is_inside, CV_32F, 1.0 / 255);
    distance = outside - inside + is_inside - 0.5;
    cv::GaussianBlur(distance, distance, {0, 0}, 1.0, 1.0, cv::BORDER_REPLICATE);
    return distance;
}

}  // namespace culet
