#include "compare/light_probe/view_agreement.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "compare/light_probe/even_directions.h"
#include "compare/light_probe/weighted_pairs.h"
#include "compare/photo/pixels.h"
#include "render/colour/colour.h"
#include "render/scene/environment_layout.h"

namespace culet {

namespace {

constexpr double k_floor = 2e-3;  // of the mean luminance; below, stops mean nothing

}  // namespace

double floor_of(const Photo& picture) {
    return k_floor * std::max(cv::mean(luminance(colour_of(picture)))[0], 1e-30);
}

cv::Mat stops_of(const Photo& picture, double sigma_px) {
    cv::Mat plane;
    cv::GaussianBlur(luminance(colour_of(picture)), plane, {}, sigma_px, sigma_px,
                     cv::BORDER_REPLICATE);
    cv::log(plane + floor_of(picture), plane);
    return plane / std::numbers::ln2;
}

double stops_at(const cv::Mat& plane, const PixelPlace& place) {
    return between_pixels(plane, place.x, place.y);
}

double correlation_of(const ViewPair& pair, const ViewParameters& p) {
    const MirrorBall a = pair.ball(p, false), b = pair.ball(p, true);
    const glm::dmat3 back = glm::transpose(pair.rotation(p));
    const Photo &one = *pair.first.picture, &two = *pair.second.picture;
    const cv::Mat first = stops_of(one, 1);
    const cv::Mat second = stops_of(two, 1);
    WeightedPairs pairs;
    for (const Vec3& d : even_directions(16000)) {
        const double qa = pair.first.quality(d), qb = pair.second.quality(back * d);
        if (qa < 1e-2 || qb < 1e-2) continue;
        const auto in_a = a.place_of(d), in_b = b.place_of(back * d);
        if (!in_a || !in_b) continue;
        pairs.add(std::sqrt(qa * qb), stops_at(first, *in_a), stops_at(second, *in_b));
    }
    return pairs.weight > 0 ? pairs.correlation() : 0;
}

double gain_of(const ViewPair& pair, const ViewParameters& p) {
    constexpr int k_width = 256, k_block = 8;
    BallView a = pair.first, b = pair.second;
    a.ball = pair.ball(p, false);
    b.ball = pair.ball(p, true);
    b.world_from_camera = pair.rotation(p);
    const ViewMap first = view_map(a, k_width), second = view_map(b, k_width);
    std::vector<std::pair<double, double>> ratios;  // stops, weight
    double all = 0;
    for (int y = 0; y < first.height; y += k_block) {
        for (int x = 0; x < k_width; x += k_block) {
            double one = 0, two = 0, weight = 0;
            for (int k = 0; k < k_block * k_block; ++k) {
                const int row = y + k / k_block;
                const std::size_t i = static_cast<std::size_t>(row) * k_width + x + k % k_block;
                if (first.quality[i] < 1e-2f || second.quality[i] < 1e-2f || first.over[i] > 0 ||
                    second.over[i] > 0)
                    continue;
                const double w = std::sqrt(first.quality[i] * second.quality[i]) *
                                 lat_long_solid_angle(row, k_width, first.height);
                one += w * luminance(&first.rgb[3 * i]);
                two += w * luminance(&second.rgb[3 * i]);
                weight += w;
            }
            if (one <= 0 || two <= 0) continue;
            ratios.emplace_back(std::log2(one / two), weight);
            all += weight;
        }
    }
    std::sort(ratios.begin(), ratios.end());
    double sum = 0;
    for (const auto& [stops, weight] : ratios) {
        sum += weight;
        if (sum >= all / 2) return std::exp2(stops);
    }
    return std::exp2(p[10]);
}

}  // namespace culet
