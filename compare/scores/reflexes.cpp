#include "compare/scores/reflexes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <vector>

#include "compare/photo/pixels.h"
#include "render/colour/colour_difference.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

constexpr double k_bright_share = 0.9;    // share of the pixels darker than a reflex
constexpr double k_least_extent = 0.007;  // of the diameter
constexpr double k_blur = 0.003;          // of the diameter
constexpr double k_reach = 0.02;          // of the diameter
constexpr double k_area_factor = 3;
constexpr double k_coloured = 10;        // CIELAB chroma
constexpr double k_hue_cosine = 0.8660;  // of 30 degrees

// Luminance clipped at white and slightly blurred, or a flat part near the level would break up
// into spots of noise.
cv::Mat smoothed_light(const cv::Mat& colour, const MatchedPictures& pictures) {
    cv::Mat light = luminance(colour);
    cv::min(light, pictures.white, light);
    const double sigma = std::max(0.7, k_blur * pictures.diameter);
    cv::GaussianBlur(light, light, {0, 0}, sigma, sigma, cv::BORDER_REPLICATE);
    return light;
}

// Reflexes and their pixels: `labels` holds 1 + a reflex's index, 0 elsewhere.
struct Found {
    std::vector<MatchedReflex> reflexes;
    cv::Mat labels;
};

Found reflexes_in(const cv::Mat& light, const cv::Mat& mask, double level, double least_area) {
    const cv::Mat bright = (light > level) & mask;
    cv::Mat labels, stats, middles;
    const int count = cv::connectedComponentsWithStats(bright, labels, stats, middles, 8, CV_32S);
    Found found;
    std::vector<int> kept(static_cast<std::size_t>(count), 0);
    for (int i = 1; i < count; ++i) {
        const double area = stats.at<int>(i, cv::CC_STAT_AREA);
        if (area < least_area) continue;
        found.reflexes.push_back({{middles.at<double>(i, 0), middles.at<double>(i, 1)}, area});
        kept[static_cast<std::size_t>(i)] = static_cast<int>(found.reflexes.size());
    }
    found.labels = labels;
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            int& label = found.labels.at<int>(y, x);
            label = kept[static_cast<std::size_t>(label)];
        }
    }
    return found;
}

// Mean colour of each reflex, clipped at white.
std::vector<Lab> colours_of(const Found& found, const cv::Mat& colour, double white) {
    std::vector<cv::Vec3d> sums(found.reflexes.size());
    for (int y = 0; y < colour.rows; ++y) {
        for (int x = 0; x < colour.cols; ++x) {
            const int label = found.labels.at<int>(y, x);
            if (label == 0) continue;
            const cv::Vec3f v = colour.at<cv::Vec3f>(y, x);
            for (int c = 0; c < 3; ++c) {
                sums[static_cast<std::size_t>(label - 1)][c] +=
                    std::clamp(static_cast<double>(v[c]) / white, 0.0, 1.0);
            }
        }
    }
    std::vector<Lab> colours;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const cv::Vec3d mean = sums[i] / found.reflexes[i].area;
        colours.push_back(lab_from_linear_srgb(mean[0], mean[1], mean[2]));
    }
    return colours;
}

double chroma(const Lab& c) {
    return std::hypot(c.a, c.b);
}

bool same_hue(const Lab& photo, const Lab& render) {
    if (chroma(render) <= k_coloured) return false;
    const double cosine =
        (photo.a * render.a + photo.b * render.b) / chroma(photo) / chroma(render);
    return cosine >= k_hue_cosine;
}

}  // namespace

std::optional<ReflexMatch> match_reflexes(const MatchedPictures& pictures) {
    const cv::Mat photo = smoothed_light(pictures.photo, pictures);
    const cv::Mat render = smoothed_light(pictures.render, pictures);
    const double level = quantile(photo, pictures.mask, k_bright_share);
    const double extent = std::max(1.5, k_least_extent * pictures.diameter);
    const Found in_photo = reflexes_in(photo, pictures.mask, level, extent * extent);
    const Found in_render = reflexes_in(render, pictures.mask, level, extent * extent);
    const auto &a = in_photo.reflexes, &b = in_render.reflexes;
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
    ReflexMatch match;
    match.photo = a;
    match.render = b;
    std::vector<double> distances;
    double common = 0, all = 0;
    for (const auto& [apart, i, j] : pairs) {
        if (match.photo[i].partner >= 0 || match.render[j].partner >= 0) continue;
        match.photo[i].partner = static_cast<int>(j);
        match.render[j].partner = static_cast<int>(i);
        distances.push_back(apart);
        common += a[i].area + b[j].area;
    }
    for (const MatchedReflex& reflex : a) all += reflex.area;
    for (const MatchedReflex& reflex : b) all += reflex.area;

    match.in_photo = static_cast<int>(a.size());
    match.in_render = static_cast<int>(b.size());
    match.matched = static_cast<int>(distances.size());
    match.f1 = 2.0 * match.matched / (match.in_photo + match.in_render);
    match.area_f1 = common / all;
    const std::vector<Lab> photo_colours = colours_of(in_photo, pictures.photo, pictures.white),
                           render_colours = colours_of(in_render, pictures.render, pictures.white);
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (match.photo[i].partner < 0 || chroma(photo_colours[i]) <= k_coloured) continue;
        const auto j = static_cast<std::size_t>(match.photo[i].partner);
        ++match.coloured;
        if (same_hue(photo_colours[i], render_colours[j])) ++match.same_hue;
    }
    if (match.coloured > 0) {
        match.hue_agreement = static_cast<double>(match.same_hue) / match.coloured;
    }
    if (!distances.empty()) {
        match.displacement = upper_median(std::move(distances)) / pictures.diameter;
    }
    return match;
}

}  // namespace culet
