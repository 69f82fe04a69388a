#include "compare/light_probe/view_alignment.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "compare/light_probe/even_directions.h"
#include "compare/light_probe/weighted_pairs.h"
#include "compare/pose/stone_view.h"
#include "render/colour/colour.h"
#include "render/scene/environment_layout.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

// Alexa 2022, Super-Fibonacci Spirals: psi solves psi^4 = psi + 4.
std::vector<glm::dmat3> even_rotations(int count) {
    constexpr double k_phi = std::numbers::sqrt2, k_psi = 1.533751168755204288118041;
    std::vector<glm::dmat3> result;
    for (int i = 0; i < count; ++i) {
        const double s = i + 0.5, t = s / count;
        const double alpha = 2 * std::numbers::pi * s / k_phi,
                     beta = 2 * std::numbers::pi * s / k_psi;
        const double r = std::sqrt(t), big = std::sqrt(1 - t);
        result.push_back(glm::mat3_cast(glm::dquat(big * std::cos(beta), r * std::sin(alpha),
                                                   r * std::cos(alpha), big * std::sin(beta))));
    }
    return result;
}

// Log-luminance of a view in its camera's frame, low-passed, as a lat-long map.
struct SmoothMap {
    int width = 0, height = 0;
    std::vector<float> value, weight;

    void at(const Vec3& d, float& v, float& w) const {
        const MapPlace place = lat_long_place(d, width, height);
        const int x = std::min(static_cast<int>(place.column), width - 1);
        const int y = std::min(static_cast<int>(place.row), height - 1);
        const std::size_t i = static_cast<std::size_t>(y) * width + x;
        v = value[i];
        w = weight[i];
    }
};

// Normalised convolution with a Gaussian on the sphere, truncated at 2.5 sigma.
SmoothMap smoothed(const ViewMap& map, double sigma, int width) {
    SmoothMap result{width, width / 2, {}, {}};
    const std::size_t texels = static_cast<std::size_t>(width) * (width / 2);
    result.value.resize(texels);
    result.weight.resize(texels);
    std::vector<Vec3> direction;
    std::vector<float> value, weight, row_of;
    double mean = 0;
    for (std::size_t i = 0; i < map.quality.size(); ++i) mean += luminance(&map.rgb[3 * i]);
    mean = std::max(mean / static_cast<double>(map.quality.size()), 1e-30);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * map.width + x;
            direction.push_back(lat_long_direction(x + 0.5, y + 0.5, map.width, map.height));
            value.push_back(
                static_cast<float>(std::log2(luminance(&map.rgb[3 * i]) / mean + 1e-3)));
            weight.push_back(static_cast<float>(std::sqrt(map.quality[i]) *
                                                lat_long_solid_angle(y, map.width, map.height)));
        }
    }
    const double reach = 2.5 * sigma, least_cosine = std::cos(reach);
    tbb::parallel_for(0, result.height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const Vec3 d = lat_long_direction(x + 0.5, y + 0.5, result.width, result.height);
            const double polar = (y + 0.5) * std::numbers::pi / result.height;
            const int from =
                std::max(0, static_cast<int>((polar - reach) / std::numbers::pi * map.height));
            const int to = std::min(
                map.height - 1, static_cast<int>((polar + reach) / std::numbers::pi * map.height));
            double sum = 0, total = 0, bell = 0;
            for (int j = from; j <= to; ++j) {
                for (int i = 0; i < map.width; ++i) {
                    const std::size_t k = static_cast<std::size_t>(j) * map.width + i;
                    const double cosine = glm::dot(d, direction[k]);
                    if (cosine < least_cosine) continue;
                    const double g = std::exp((cosine - 1) / (sigma * sigma));
                    sum += g * weight[k] * value[k];
                    total += g * weight[k];
                    bell += g * lat_long_solid_angle(j, map.width, map.height);
                }
            }
            const std::size_t at = static_cast<std::size_t>(y) * width + x;
            result.value[at] = total > 0 ? static_cast<float>(sum / total) : 0;
            result.weight[at] = bell > 0 ? static_cast<float>(total / bell) : 0;
        }
    });
    return result;
}

struct SmoothPoints {
    std::vector<Vec3> direction;
    std::vector<float> value, weight;
};
SmoothPoints points_of(const SmoothMap& map, int count) {
    SmoothPoints points;
    for (const Vec3& d : even_directions(count)) {
        float v = 0, w = 0;
        map.at(d, v, w);
        if (w < 0.05f) continue;
        points.direction.push_back(d);
        points.value.push_back(v);
        points.weight.push_back(w);
    }
    return points;
}

// Weighted correlation; too small an overlap does not count.
double correlation(const SmoothPoints& first, const SmoothMap& second,
                   const glm::dmat3& first_from_second, double least_weight) {
    const glm::dmat3 second_from_first = glm::transpose(first_from_second);
    WeightedPairs pairs;
    for (std::size_t i = 0; i < first.direction.size(); ++i) {
        float v = 0, w = 0;
        second.at(second_from_first * first.direction[i], v, w);
        pairs.add(static_cast<double>(w) * first.weight[i], first.value[i], v);
    }
    const double n = pairs.weight;
    if (n <= 0) return -1;
    const double r = pairs.correlation();
    return n < least_weight ? r * n / least_weight : r;
}

struct Candidate {
    glm::dmat3 rotation{1.0};
    double score = -1;
};

// Hill climbing along six directions with shrinking steps.
Candidate climbed(const SmoothPoints& points, const SmoothMap& map, Candidate at, double step,
                  double least_step, double least_weight) {
    at.score = correlation(points, map, at.rotation, least_weight);
    while (step > least_step) {
        Candidate best = at;
        for (int k = 0; k < 6; ++k) {
            Vec3 axis(0);
            axis[k / 2] = k % 2 == 0 ? step : -step;
            const glm::dmat3 tried = rotation_by(axis) * at.rotation;
            const double score = correlation(points, map, tried, least_weight);
            if (score > best.score) best = {tried, score};
        }
        if (best.score > at.score) {
            at = best;
        } else {
            step /= 2;
        }
    }
    return at;
}

std::vector<Candidate> distinct(std::vector<Candidate> list, double apart, std::size_t most) {
    std::sort(list.begin(), list.end(),
              [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    std::vector<Candidate> kept;
    for (const Candidate& c : list) {
        const bool near = std::any_of(kept.begin(), kept.end(), [&](const Candidate& k) {
            return angle_of(glm::transpose(k.rotation) * c.rotation) < apart;
        });
        if (!near) kept.push_back(c);
        if (kept.size() == most) break;
    }
    return kept;
}

RoughTurn over_all_rotations(const ViewMap& first, const ViewMap& second) {
    // The overlap must have half the weight that two views at right angles have.
    const auto asked = [](const SmoothPoints& points, const SmoothMap& map) {
        double weight = 0;
        for (int k = 0; k < 2; ++k) {
            const glm::dmat3 quarter =
                rotation_by({0, k == 0 ? std::numbers::pi / 2 : -std::numbers::pi / 2, 0});
            double sum = 0;
            for (std::size_t i = 0; i < points.direction.size(); ++i) {
                float v = 0, w = 0;
                map.at(glm::transpose(quarter) * points.direction[i], v, w);
                sum += static_cast<double>(w) * points.weight[i];
            }
            weight = std::max(weight, sum);
        }
        return weight / 2;
    };
    const SmoothMap coarse = smoothed(second, radians(6), 96);
    const SmoothPoints few = points_of(smoothed(first, radians(6), 96), 600);
    const double coarse_weight = asked(few, coarse);
    const std::vector<glm::dmat3> rotations = even_rotations(24000);  // about 9 degrees apart
    std::vector<Candidate> all(rotations.size());
    tbb::parallel_for(std::size_t{0}, rotations.size(), [&](std::size_t i) {
        all[i] = {rotations[i], correlation(few, coarse, rotations[i], coarse_weight)};
    });
    // Usual rotations, which win ties.
    for (const double degrees : {90.0, -90.0})
        all.push_back(
            {rotation_by({0, radians(degrees), 0}),
             correlation(few, coarse, rotation_by({0, radians(degrees), 0}), coarse_weight)});
    std::vector<Candidate> best = distinct(all, radians(12), 24);
    tbb::parallel_for(std::size_t{0}, best.size(), [&](std::size_t i) {
        best[i] = climbed(few, coarse, best[i], radians(5), radians(1), coarse_weight);
    });
    best = distinct(best, radians(6), 8);
    const SmoothMap fine = smoothed(second, radians(1.5), 256);
    const SmoothPoints many = points_of(smoothed(first, radians(1.5), 256), 6000);
    const double fine_weight = asked(many, fine);
    tbb::parallel_for(std::size_t{0}, best.size(), [&](std::size_t i) {
        best[i] = climbed(many, fine, best[i], radians(2), radians(0.2), fine_weight);
    });
    best = distinct(best, radians(6), 8);
    return {best.front().rotation, best.front().score, best.size() > 1 ? best[1].score : -1.0};
}

}  // namespace

MirrorBall ball_of(const ViewPrior& prior, double otherwise) {
    if (prior.focal_px > 0)
        return MirrorBall::with_focal_length(prior.circle, prior.principal, prior.focal_px);
    return MirrorBall::at_distance(prior.circle, prior.principal,
                                   prior.distance > 0 ? prior.distance : otherwise);
}

RoughTurn rough_turn(const BallView& first, const BallView& second) {
    // In camera frames, independent of the views' world frames.
    BallView a = first, b = second;
    a.world_from_camera = b.world_from_camera = glm::dmat3(1.0);
    return over_all_rotations(view_map(a, 256), view_map(b, 256));
}

}  // namespace culet
