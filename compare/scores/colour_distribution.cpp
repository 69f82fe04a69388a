#include "compare/scores/colour_distribution.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "render/colour/colour_difference.h"

namespace culet {

namespace {

constexpr double k_cell = 8;
constexpr int k_most_pixels = 30000;
constexpr std::size_t k_most_cells = 96;  // cv::EMD takes seconds from about 200

struct Colours {
    std::vector<Lab> pixels;
    Lab mean;
    double light = 0;
};

Colours colours_of(const cv::Mat& colour, const cv::Mat& mask, double white) {
    Colours result;
    // A subset of the pixels is enough for a distribution.
    const int step = 1 + cv::countNonZero(mask) / k_most_pixels;
    int count = 0;
    for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
            if (mask.at<unsigned char>(y, x) == 0 || count++ % step != 0) continue;
            const cv::Vec3f v = colour.at<cv::Vec3f>(y, x);
            const auto part = [&](int c) {
                return std::clamp(static_cast<double>(v[c]) / white, 0.0, 1.0);
            };
            result.light += 0.2126 * part(0) + 0.7152 * part(1) + 0.0722 * part(2);
            result.pixels.push_back(lab_from_linear_srgb(part(0), part(1), part(2)));
            result.mean.L += result.pixels.back().L;
            result.mean.a += result.pixels.back().a;
            result.mean.b += result.pixels.back().b;
        }
    }
    const double n = std::max(1.0, static_cast<double>(result.pixels.size()));
    result.mean = {result.mean.L / n, result.mean.a / n, result.mean.b / n};
    result.light /= n;
    return result;
}

// Rows of weight, L, a, b: the mean colour of every non-empty cell.
cv::Mat signature(const std::vector<Lab>& pixels, double cell) {
    struct Gathered {
        double count = 0, L = 0, a = 0, b = 0;
    };
    std::map<std::array<int, 3>, Gathered> cells;
    for (const Lab& c : pixels) {
        const auto index = [&](double v) { return static_cast<int>(std::floor(v / cell)); };
        Gathered& g = cells[{index(c.L), index(c.a), index(c.b)}];
        ++g.count;
        g.L += c.L;
        g.a += c.a;
        g.b += c.b;
    }
    cv::Mat rows(static_cast<int>(cells.size()), 4, CV_32F);
    int row = 0;
    for (const auto& [index, g] : cells) {
        float* to = rows.ptr<float>(row++);
        to[0] = static_cast<float>(g.count / static_cast<double>(pixels.size()));
        to[1] = static_cast<float>(g.L / g.count);
        to[2] = static_cast<float>(g.a / g.count);
        to[3] = static_cast<float>(g.b / g.count);
    }
    return rows;
}

double earth_movers_distance(const std::vector<Lab>& photo, const std::vector<Lab>& render) {
    // The same cell size for both, or equal pictures could differ.
    for (double cell = k_cell;; cell *= 1.25) {
        const cv::Mat p = signature(photo, cell), r = signature(render, cell);
        if (static_cast<std::size_t>(std::max(p.rows, r.rows)) > k_most_cells) continue;
        return static_cast<double>(cv::EMD(p, r, cv::DIST_L2));
    }
}

}  // namespace

ColourDistributions colour_distributions(const MatchedPictures& pictures) {
    const Colours photo = colours_of(pictures.photo, pictures.mask, pictures.white),
                  render = colours_of(pictures.render, pictures.mask, pictures.white);
    ColourDistributions result;
    result.photo_light = photo.light;
    result.render_light = render.light;
    if (photo.pixels.empty()) return result;
    result.body_difference = ciede2000(photo.mean, render.mean);
    result.emd = earth_movers_distance(photo.pixels, render.pixels);
    return result;
}

}  // namespace culet
