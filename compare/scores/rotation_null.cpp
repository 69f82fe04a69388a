#include "compare/scores/rotation_null.h"

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/resampling.h"
#include "compare/scores/chance.h"

namespace culet {

namespace {

// Symmetric square root of a symmetric positive 2 x 2 matrix, and its inverse.
struct Roots {
    cv::Matx22d root, inverse;
};

Roots roots_of(const cv::Matx22d& m) {
    cv::Mat values, vectors;
    cv::eigen(cv::Mat(m), values, vectors);
    Roots result{cv::Matx22d::zeros(), cv::Matx22d::zeros()};
    for (int k = 0; k < 2; ++k) {
        const double value = std::sqrt(std::max(1e-12, values.at<double>(k)));
        const cv::Vec2d axis(vectors.at<double>(k, 0), vectors.at<double>(k, 1));
        result.root += value * (axis * axis.t());
        result.inverse += (1 / value) * (axis * axis.t());
    }
    return result;
}

// Correlation of the render with its rotated self, at thumbnail size.
double likeness(const MatchedPictures& pictures, const Rotation& draw) {
    MatchedPictures self = rotated(pictures, draw);
    self.photo = pictures.render;
    return zncc(self, 0.02).value_or(1);
}

}  // namespace

MatchedPictures rotated(const MatchedPictures& pictures, const Rotation& draw) {
    MatchedPictures result = pictures;
    result.render = resampled(pictures.render, draw.render_from_rotated, pictures.render.size(),
                              Kernel::linear, Beyond::nearest);
    // A separate matrix: assigning directly would overwrite the shared mask.
    const cv::Mat covered = pictures.mask & resampled_mask(pictures.mask, draw.render_from_rotated,
                                                           pictures.mask.size());
    result.mask = covered;
    return result;
}

std::vector<Rotation> draw_rotations(const MatchedPictures& pictures, const cv::Mat& outline,
                                     int count, std::uint64_t seed) {
    const cv::Moments m = cv::moments(outline, true);
    std::vector<Rotation> draws;
    if (!(m.m00 > 0)) return draws;
    const cv::Vec2d middle(m.m10 / m.m00, m.m01 / m.m00);
    const Roots roots = roots_of({m.mu20 / m.m00, m.mu11 / m.m00, m.mu11 / m.m00, m.mu02 / m.m00});

    // A small copy is enough, because the likeness is blurred by 2 % of the diameter.
    MatchedPictures small = pictures;
    const double scale = std::min(1.0, 160 / pictures.diameter);
    if (scale < 1) {
        cv::resize(pictures.render, small.render, {}, scale, scale, cv::INTER_AREA);
        cv::resize(pictures.mask, small.mask, small.render.size(), 0, 0, cv::INTER_NEAREST);
        small.diameter *= scale;
    }
    small.photo = small.render;

    Chance chance(seed);
    for (int attempt = 0; attempt < 20 * count && static_cast<int>(draws.size()) < count;
         ++attempt) {
        const double angle = 2 * std::numbers::pi * chance.uniform();
        const double mirror = draws.size() % 2 == 0 ? 1 : -1;
        const double c = std::cos(angle), s = std::sin(angle);
        const cv::Matx22d rotation(c, -s * mirror, s, c * mirror);
        const cv::Matx22d about = roots.root * rotation * roots.inverse;
        const auto matrix = [&](double factor) {
            // Pixel centres of the small copy are at (p + 0.5) * factor - 0.5.
            const cv::Vec2d at((middle[0] + 0.5) * factor - 0.5, (middle[1] + 0.5) * factor - 0.5);
            const cv::Vec2d origin = at - about * at;
            return cv::Matx23d(about(0, 0), about(0, 1), origin[0], about(1, 0), about(1, 1),
                               origin[1]);
        };
        if (likeness(small, {matrix(scale)}) > k_same_render) continue;
        draws.push_back({matrix(1)});
    }
    return draws;
}

}  // namespace culet
