#include "refine/spin/surface_edges.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <opencv2/imgproc.hpp>

#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

constexpr double k_blur = 0.8;            // pixels
constexpr double k_sweep = 1.5;           // pixels between places of the sweep
constexpr int k_neighbours = 4;           // steps: a peak is higher than all others so near
constexpr int k_samples = 17;             // along an edge
constexpr double k_dull = 2;              // levels a pixel: brighter edges count by their logarithm
constexpr double k_least_strength = 2.5;  // robust standard deviations
constexpr double k_finest = 0.25;         // pixels

glm::dvec2 projected(const Projection& p, const Vec3& place) {
    const auto row = [&](std::size_t i) {
        return p[i][0] * place.x + p[i][1] * place.y + p[i][2] * place.z + p[i][3];
    };
    return {row(0) / row(2) - 0.5, row(1) / row(2) - 0.5};
}

// Bilinear; 0 beyond the picture.
double at(const cv::Mat& slopes, const glm::dvec2& place) {
    if (!(place.x >= 0 && place.y >= 0 && place.x < slopes.cols - 1 && place.y < slopes.rows - 1))
        return 0;
    const int column = int(place.x), row = int(place.y);
    const double u = place.x - column, v = place.y - row;
    const float *above = slopes.ptr<float>(row) + column,
                *below = slopes.ptr<float>(row + 1) + column;
    return (1 - v) * ((1 - u) * double(above[0]) + u * double(above[1])) +
           v * ((1 - u) * double(below[0]) + u * double(below[1]));
}

double shown_by(const SweptFrame& frame, const Vec3& begin, const Vec3& end) {
    const glm::dvec2 a = projected(frame.projection, begin), b = projected(frame.projection, end);
    const double length = glm::distance(a, b);
    if (!(length > 0)) return 0;
    const glm::dvec2 normal{(a.y - b.y) / length, (b.x - a.x) / length};
    double sum = 0;
    for (int i = 0; i < k_samples; ++i) {
        const glm::dvec2 place = a + (double(i) / (k_samples - 1)) * (b - a);
        sum += normal.x * at(frame.along_x, place) + normal.y * at(frame.along_y, place);
    }
    return std::log1p(std::abs(sum) / k_samples / k_dull);
}

// Mean over the frames of how steep the picture is across the line.
double score(const std::vector<SweptFrame>& frames, const SweptSide& side, double radius,
             double height) {
    const Vec3 out{std::cos(side.azimuth), std::sin(side.azimuth), 0}, along{-out.y, out.x, 0};
    const Vec3 middle = radius * out + side.middle * along + Vec3(0, 0, height);
    double sum = 0;
    for (const SweptFrame& frame : frames)
        sum +=
            shown_by(frame, middle - side.half_length * along, middle + side.half_length * along);
    return sum / double(frames.size());
}

SurfaceEdge sharpened(const std::vector<SweptFrame>& frames, const SweptSide& side,
                      SurfaceEdge edge) {
    for (double step = k_sweep / 2; step >= k_finest; step /= 2) {
        SurfaceEdge best = edge;
        double most = -1;
        for (int i = -3; i <= 3; ++i) {
            for (int k = -3; k <= 3; ++k) {
                const double here =
                    score(frames, side, edge.radius + i * step, edge.height + k * step);
                if (!(here > most)) continue;
                most = here;
                best.radius = edge.radius + i * step;
                best.height = edge.height + k * step;
            }
        }
        edge = best;
    }
    return edge;
}

}  // namespace

SweptFrame swept_frame(const LevelPicture& picture) {
    const cv::Mat levels(picture.height, picture.width, CV_8UC3,
                         const_cast<std::uint8_t*>(picture.rgb.data()));
    cv::Mat grey;
    cv::cvtColor(levels, grey, cv::COLOR_RGB2GRAY);
    grey.convertTo(grey, CV_32F);
    cv::GaussianBlur(grey, grey, {0, 0}, k_blur);
    SweptFrame frame;
    cv::Sobel(grey, frame.along_x, CV_32F, 1, 0, 3, 1 / 8.0);
    cv::Sobel(grey, frame.along_y, CV_32F, 0, 1, 3, 1 / 8.0);
    return frame;
}

std::vector<SurfaceEdge> surface_edges(const std::vector<SweptFrame>& frames,
                                       const SweptSide& side) {
    const int radii = int((side.most_radius - side.least_radius) / k_sweep) + 1,
              heights = int((side.most_height - side.least_height) / k_sweep) + 1;
    if (radii < 1 || heights < 1 || frames.empty()) return {};
    std::vector<double> scores(std::size_t(radii * heights));
    tbb::parallel_for(0, radii, [&](int i) {
        for (int k = 0; k < heights; ++k)
            scores[std::size_t(i * heights + k)] = score(
                frames, side, side.least_radius + i * k_sweep, side.least_height + k * k_sweep);
    });
    const double middle = upper_median(scores);
    std::vector<double> off;
    for (const double s : scores) off.push_back(std::abs(s - middle));
    const double spread = std::max(1.4826 * upper_median(off), 1e-12);
    std::vector<SurfaceEdge> edges;
    for (int i = 0; i < radii; ++i) {
        for (int k = 0; k < heights; ++k) {
            const double here = scores[std::size_t(i * heights + k)];
            bool is_peak = here - middle > k_least_strength * spread;
            for (int a = std::max(0, i - k_neighbours);
                 is_peak && a <= std::min(radii - 1, i + k_neighbours); ++a) {
                for (int b = std::max(0, k - k_neighbours);
                     b <= std::min(heights - 1, k + k_neighbours); ++b)
                    is_peak = is_peak && scores[std::size_t(a * heights + b)] <= here;
            }
            if (!is_peak) continue;
            edges.push_back(sharpened(frames, side,
                                      {side.azimuth, side.least_radius + i * k_sweep,
                                       side.least_height + k * k_sweep, (here - middle) / spread}));
        }
    }
    std::stable_sort(edges.begin(), edges.end(), [](const SurfaceEdge& a, const SurfaceEdge& b) {
        return a.strength > b.strength;
    });
    return edges;
}

SurfaceEdge found_again(const std::vector<SweptFrame>& frames, const SweptSide& side,
                        const SurfaceEdge& edge) {
    return sharpened(frames, side, edge);
}

}  // namespace culet
