#include "compare/turntable/edge_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "compare/photo/pixels.h"

namespace culet {

namespace {

// Of the derivative along the normal, pixels: that of a camera's own edges.
constexpr double k_edge_blur = 0.7;
// Levels a pixel: dust, noise and soft shadows stay below; root mean square of R, G, B.
constexpr float k_sharp = 5;
constexpr double k_steep = 6.5;  // of linear light: 4 levels a pixel at a ground of level 200
constexpr int k_close = 7, k_open = 9;  // pixels: gaps in the stone's edges; hairs beside it
constexpr double k_least_area = 400;
constexpr double k_picture_edge = 3;
// Along the outline, pixels: from one place to the next; half of what is averaged.
constexpr double k_apart = 3;
constexpr int k_half_average = 2;
// Along the normal: samples; how far inside of the outermost peak a steeper one is looked for.
constexpr double k_fine = 0.25, k_halo = 2.5;
// Least steepness of an edge, in that of the next: a halo is less steep.
constexpr double k_no_halo = 0.35;

cv::Mat view_of(const LevelPicture& picture) {
    return cv::Mat(picture.height, picture.width, CV_8UC3,
                   const_cast<std::uint8_t*>(picture.rgb.data()));
}

// Root mean square over the channels, levels a pixel.
cv::Mat steepness(const cv::Mat& levels) {
    cv::Mat smooth, along_x, along_y;
    levels.convertTo(smooth, CV_32FC3);
    cv::GaussianBlur(smooth, smooth, {0, 0}, k_edge_blur);
    cv::Sobel(smooth, along_x, CV_32F, 1, 0, 1, 0.5);
    cv::Sobel(smooth, along_y, CV_32F, 0, 1, 1, 0.5);
    const cv::Mat squares = along_x.mul(along_x) + along_y.mul(along_y);
    cv::Mat mean, steep;
    cv::transform(squares, mean, cv::Matx13f(1 / 3.f, 1 / 3.f, 1 / 3.f));
    cv::sqrt(mean, steep);
    return steep;
}

glm::dvec2 from_middle(const LevelPicture& picture, double x, double y) {
    return {x - (picture.width - 1) / 2.0, (picture.height - 1) / 2.0 - y};
}

// Linear light by level, 255 the brightest: there a blurred edge is steepest where it is.
const std::array<double, 256>& light_of_level() {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> light{};
        for (std::size_t i = 0; i < light.size(); ++i)
            light[i] = 255 * std::pow(double(i) / 255, 2.2);
        return light;
    }();
    return table;
}

// Bilinear, R, G, B; the border's value beyond it.
std::array<double, 3> light_at(const LevelPicture& picture, const glm::dvec2& place) {
    const double x = std::clamp(place.x + (picture.width - 1) / 2.0, 0.0, picture.width - 1.001);
    const double y = std::clamp((picture.height - 1) / 2.0 - place.y, 0.0, picture.height - 1.001);
    const int column = int(x), row = int(y);
    const std::array<double, 256>& light = light_of_level();
    const double u = x - column, v = y - row;
    const std::uint8_t* above =
        &picture.rgb[3 * (std::size_t(row) * std::size_t(picture.width) + std::size_t(column))];
    const std::uint8_t* below = above + 3 * picture.width;
    std::array<double, 3> level{};
    for (std::size_t c = 0; c < 3; ++c) {
        level[c] = (1 - v) * ((1 - u) * light[above[c]] + u * light[above[c + 3]]) +
                   v * ((1 - u) * light[below[c]] + u * light[below[c + 3]]);
    }
    return level;
}

// A closed polygon by the length along it.
class Walk {
public:
    explicit Walk(const std::vector<glm::dvec2>& corners) : corners_(corners) {
        for (std::size_t k = 0; k < corners.size(); ++k)
            ends_.push_back(length() + glm::distance(corners[k], corner(k + 1)));
    }
    double length() const { return ends_.empty() ? 0 : ends_.back(); }
    glm::dvec2 at(double along) const {
        along -= length() * std::floor(along / length());
        const auto end =
            std::min(std::upper_bound(ends_.begin(), ends_.end(), along), ends_.end() - 1);
        const auto k = std::size_t(end - ends_.begin());
        const double begin = k > 0 ? ends_[k - 1] : 0;
        return glm::mix(corners_[k], corner(k + 1), (along - begin) / (*end - begin));
    }

private:
    const glm::dvec2& corner(std::size_t k) const { return corners_[k % corners_.size()]; }

    const std::vector<glm::dvec2>& corners_;
    std::vector<double> ends_;
};

// How steep the picture is along the normal, from `from` pixels outside in; the mean beside the
// outline, which may have a corner there.
std::vector<double> steepness_along(const LevelPicture& picture, const Walk& outline, double place,
                                    const glm::dvec2& normal, double from, int count) {
    constexpr int k_half = 8;  // samples, nearly three standard deviations
    std::vector<std::array<double, 3>> profile(std::size_t(count + 2 * k_half));
    for (int a = -k_half_average; a <= k_half_average; ++a) {
        const glm::dvec2 beside = outline.at(place + a);
        for (std::size_t i = 0; i < profile.size(); ++i) {
            const auto level =
                light_at(picture, beside + (from - (double(i) - k_half) * k_fine) * normal);
            for (std::size_t c = 0; c < 3; ++c)
                profile[i][c] += level[c] / (2 * k_half_average + 1);
        }
    }
    std::vector<double> steep;
    for (int i = 0; i < count; ++i) {
        std::array<double, 3> slope{};
        for (int k = -k_half; k <= k_half; ++k) {
            const double t = k * k_fine / k_edge_blur;
            // Derivative of a Gaussian.
            const double weight = t * std::exp(-t * t / 2) * k_fine /
                                  (k_edge_blur * k_edge_blur * std::sqrt(2 * std::numbers::pi));
            for (std::size_t c = 0; c < 3; ++c)
                slope[c] += weight * profile[std::size_t(i + k + k_half)][c];
        }
        double squares = 0;
        for (const double s : slope) squares += s * s / 3;
        steep.push_back(std::sqrt(squares));
    }
    return steep;
}

std::optional<double> edge_along(const std::vector<double>& steep, std::size_t most) {
    for (std::size_t i = 1; i <= most && i + 1 < steep.size(); ++i) {
        const double before = steep[i - 1], here = steep[i], after = steep[i + 1];
        if (here < k_steep || here < before || here <= after) continue;
        const auto end = std::min(steep.size(), i + std::size_t(k_halo / k_fine) + 1);
        const double strongest = *std::max_element(steep.begin() + std::ptrdiff_t(i),
                                                   steep.begin() + std::ptrdiff_t(end));
        if (here < k_no_halo * strongest) continue;
        return double(i) + (after - before) / (2 * (2 * here - before - after));
    }
    return std::nullopt;
}

}  // namespace

LevelPicture levels_of(const Photo& photo) {
    LevelPicture picture{photo.width, photo.height, {}};
    picture.rgb.resize(photo.rgb.size());
    cv::Mat levels = view_of(picture);
    encoded(colour_of(photo)).convertTo(levels, CV_8U, 255);
    return picture;
}

CoarseOutline coarse_outline(const LevelPicture& picture) {
    CoarseOutline result;
    const auto disc = [](int size) {
        return cv::getStructuringElement(cv::MORPH_ELLIPSE, {size, size});
    };
    cv::Mat sharp = steepness(view_of(picture)) > k_sharp;
    cv::morphologyEx(sharp, sharp, cv::MORPH_CLOSE, disc(k_close));
    std::vector<std::vector<cv::Point>> contours;
    const auto largest = [&] {
        cv::findContours(sharp, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
        return std::max_element(contours.begin(), contours.end(), [](const auto& a, const auto& b) {
            return cv::contourArea(a) < cv::contourArea(b);
        });
    };
    auto found = largest();
    if (found != contours.end()) {
        sharp = cv::Scalar(0);
        cv::drawContours(sharp, contours, int(found - contours.begin()), cv::Scalar(255),
                         cv::FILLED);
        cv::morphologyEx(sharp, sharp, cv::MORPH_OPEN, disc(k_open));
        found = largest();
    }
    if (found == contours.end() || cv::contourArea(*found) < k_least_area) {
        result.trouble = "no stone with sharp edges before a plain ground";
        return result;
    }
    std::vector<cv::Point> hull;
    cv::convexHull(*found, hull);
    const cv::Rect box = cv::boundingRect(hull);
    if (box.x < k_picture_edge || box.y < k_picture_edge ||
        box.br().x > picture.width - k_picture_edge || box.br().y > picture.height - k_picture_edge)
        result.trouble = "what has sharp edges reaches the picture's border";
    for (const cv::Point& p : hull) result.corners.push_back(from_middle(picture, p.x, p.y));
    return result;
}

std::vector<glm::dvec2> places_along(const std::vector<glm::dvec2>& outline) {
    std::vector<glm::dvec2> places;
    const Walk walk(outline);
    for (double along = k_apart / 2; along < walk.length(); along += k_apart)
        places.push_back(walk.at(along));
    return places;
}

std::vector<glm::dvec2> edge_points(const LevelPicture& picture,
                                    const std::vector<glm::dvec2>& outline, double reach) {
    std::vector<glm::dvec2> points;
    const std::size_t most = std::size_t(2 * reach / k_fine);
    const int count = int((2 * reach + k_halo) / k_fine) + 1;
    const Walk walk(outline);
    for (double place = k_apart / 2; place < walk.length(); place += k_apart) {
        const glm::dvec2 chord = walk.at(place + k_half_average) - walk.at(place - k_half_average);
        if (!(glm::length(chord) > 0)) continue;
        const glm::dvec2 normal = glm::normalize(glm::dvec2(chord.y, -chord.x));
        const auto at =
            edge_along(steepness_along(picture, walk, place, normal, reach, count), most);
        if (at) points.push_back(walk.at(place) + (reach - *at * k_fine) * normal);
    }
    return points;
}

}  // namespace culet
