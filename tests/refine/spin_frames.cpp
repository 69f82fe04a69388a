#include "tests/refine/spin_frames.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>

#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"
#include "stone/solid/least_rotation.h"
#include "tests/fit/test_stones.h"
#include "tests/refine/lit_stone.h"

namespace culet::synthetic {

namespace {

constexpr int k_fine = 4;  // parts of a pixel's side that are drawn

// Specks that lie on the ground beside the stone.
void draw_dust(const SpinTruth& truth, double turn, cv::Mat& picture) {
    const PictureAxes at = picture_axes(truth.series.camera, turn);
    double depth = 0;
    for (const Vec3& v : truth.solid.vertices) depth = std::max(depth, -v.z);
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> part(-1, 1);
    for (int i = 0; i < truth.specks; ++i) {
        const Vec3 place(part(random) * truth.size / 2, part(random) * truth.size / 2, -depth);
        const double near = 1 - glm::dot(at.nearing, place), level = 195 + 40 * part(random);
        const double u = truth.size / 2.0 + at.dx + glm::dot(at.across, place) / near,
                     v = truth.size / 2.0 - at.dy - glm::dot(at.along, place) / near;
        cv::circle(
            picture,
            {int(std::lround(16 * (k_fine * u - 0.5))), int(std::lround(16 * (k_fine * v - 0.5)))},
            int(16 * k_fine * (0.7 + 0.3 * part(random))), cv::Scalar::all(level), cv::FILLED,
            cv::LINE_8, 4);
    }
}

void draw_flat_facets(const SpinTruth& truth, double turn, std::mt19937_64& random,
                      cv::Mat& picture) {
    const PictureAxes at = picture_axes(truth.series.camera, turn);
    const Vec3 sight = glm::normalize(at.nearing);
    const Vec3 eye = sight / truth.series.camera.perspective;
    for (const Facet& facet : truth.solid.facets) {
        const int level = random() % 3 == 0 ? 238 : int(20 + random() % 90);
        if (height_above(facet.plane, eye) <= 0) continue;
        std::vector<cv::Point> corners;
        for (const int c : facet.corners) {
            const Vec3& place = truth.solid.vertices[std::size_t(c)];
            const double near = 1 - glm::dot(at.nearing, place);
            const double u = truth.size / 2.0 + at.dx + glm::dot(at.across, place) / near,
                         v = truth.size / 2.0 - at.dy - glm::dot(at.along, place) / near;
            // OpenCV counts from the first pixel's centre, in 1/16.
            corners.emplace_back(int(std::lround(16 * (k_fine * u - 0.5))),
                                 int(std::lround(16 * (k_fine * v - 0.5))));
        }
        cv::fillPoly(picture, std::vector{corners}, cv::Scalar::all(level), cv::LINE_8, 4);
    }
}

cv::Mat drawn(const SpinTruth& truth, double turn, const std::optional<LitStone>& stone,
              std::mt19937_64& random) {
    const int size = truth.size * k_fine;
    cv::Mat picture(size, size, CV_8UC3, cv::Scalar(196, 194, 190));
    draw_dust(truth, turn, picture);
    if (!stone) draw_flat_facets(truth, turn, random, picture);
    cv::resize(picture, picture, {truth.size, truth.size}, 0, 0, cv::INTER_AREA);
    if (stone) return stone->on(picture, turn);
    cv::GaussianBlur(picture, picture, {0, 0}, 0.7);
    return picture;
}

// Distance from the middle of mass, seen along a facet's normal, to the facet's nearest side: where
// it is positive, the stone stands on that facet.
double steadiness(const Solid& solid, const Facet& facet, const Vec3& middle) {
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < facet.corners.size(); ++i) {
        const Vec3 &a = solid.vertices[std::size_t(facet.corners[i])],
                   &b = solid.vertices[std::size_t(facet.corners[(i + 1) % facet.corners.size()])];
        const Vec3 inwards = glm::cross(facet.plane.normal, b - a);
        if (glm::length(inwards) > 0)
            least = std::min(least, glm::dot(glm::normalize(inwards), middle - a));
    }
    return least;
}

}  // namespace

SpinTruth lying_step_cut(int frames) {
    SpinTruth truth;
    const Solid cut = test::off_standard(make_cut("step"), 0.3, 0, 3);
    const double length = diameter(cut);
    std::vector<NamedPlane> planes;
    const double c = std::cos(radians(48)), s = std::sin(radians(48));
    for (const Facet& facet : cut.facets) {
        const Vec3& n = facet.plane.normal;
        const Vec3 lying{c * n.x + s * n.z, n.y, c * n.z - s * n.x};
        planes.push_back(
            {facet.name,
             {lying, 190 / length * facet.plane.offset + glm::dot(lying, Vec3(3, -2, 6))}});
    }
    truth.solid = intersect_half_spaces(planes).solid;
    truth.series.camera = {2.3, radians(0.4), radians(48), 1 / (60 * 190.0)};
    std::mt19937_64 random(4);
    std::normal_distribution<double> uneven(0, radians(0.3));
    for (int i = 0; i < frames; ++i)
        truth.series.turns.push_back(2 * std::numbers::pi * i / frames + uneven(random));
    return truth;
}

SpinTruth lying(const Solid& upright, double length, double elevation, int frames, unsigned seed) {
    SpinTruth truth;
    const Vec3 middle = centroid(upright);
    double best = -HUGE_VAL;
    Vec3 down(0, 0, -1);
    for (const Facet& facet : upright.facets) {
        const double steady = steadiness(upright, facet, middle);
        const Vec3& n = facet.plane.normal;
        if (n.z > -0.2 || n.z < -0.99 || steady <= best) continue;
        best = steady;
        down = n;
    }
    const double scale = length / diameter(upright);
    const auto laid = [&](const Vec3& v) { return turned_with(down, {0, 0, -1}, v); };
    const Vec3 shift(3, -2, 6);
    truth.solid = upright;
    for (Vec3& v : truth.solid.vertices) v = scale * laid(v - middle) + shift;
    for (Facet& f : truth.solid.facets) {
        const double offset = f.plane.offset - glm::dot(f.plane.normal, middle);
        f.plane.normal = laid(f.plane.normal);
        f.plane.offset = scale * offset + glm::dot(f.plane.normal, shift);
    }
    truth.series.camera = {2.3, radians(0.4), elevation, 1 / (60 * length)};
    std::mt19937_64 random(seed);
    std::normal_distribution<double> uneven(0, radians(0.2));
    for (int i = 0; i < frames; ++i)
        truth.series.turns.push_back(2 * std::numbers::pi * i / frames + uneven(random));
    truth.series.turns[0] += radians(1.3);
    return truth;
}

std::vector<SpinFrame> frames_of(const SpinTruth& truth) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> noise(0, 1.5);
    std::vector<SpinFrame> frames;
    std::optional<LitStone> stone;
    if (truth.lit) stone.emplace(truth);
    for (const double turn : truth.series.turns) {
        const cv::Mat picture = drawn(truth, turn, stone, random);
        SpinFrame& frame = frames.emplace_back();
        frame.name = fmt::format("frame-{:03}.png", frames.size());
        frame.picture.width = frame.picture.height = truth.size;
        for (int y = 0; y < truth.size; ++y) {
            for (int x = 0; x < truth.size; ++x) {
                for (int k = 0; k < 3; ++k)
                    frame.picture.rgb.push_back(cv::saturate_cast<std::uint8_t>(
                        picture.at<cv::Vec3b>(y, x)[k] + noise(random)));
            }
        }
        if (truth.lit) compress(frame.picture, 90);
    }
    return frames;
}

}  // namespace culet::synthetic
