#include "refine/spin/zone_shares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <opencv2/core.hpp>

#include "render/colour/colour.h"
#include "render/raytable/seen_exits.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr double k_sodium_nm = 589.3;

struct Ring {
    const char* name;
    double from_deg, to_deg;
    int sectors;
};
constexpr Ring k_rings[] = {
    {"below", -90, -30, 1}, {"ground", -30, 0, 4}, {"low", 0, 25, 4},
    {"high", 25, 55, 4},    {"top", 55, 90, 1},
};
constexpr std::array k_sides{"front", "right", "back", "left"};

// Rows are the axes of the picture's right, its up, and the direction to the camera.
struct View {
    Vec3 right{0}, up{0}, toward{0}, eye{0};
    double focal = 1, u = 0, v = 0;  // pixels
};

View view_of(const Projection& p) {
    const auto row = [&](std::size_t i) { return Vec3(p[i][0], p[i][1], p[i][2]); };
    View view;
    const double steep = glm::length(row(2));
    view.toward = -row(2) / steep;
    // What lies far along the line of sight falls on the principal point.
    view.u = glm::dot(row(0), -view.toward) / steep;
    view.v = glm::dot(row(1), -view.toward) / steep;
    const Vec3 across = row(0) - view.u * row(2);
    view.focal = glm::length(across) / steep;
    view.right = glm::normalize(across);
    view.up = glm::cross(view.toward, view.right);
    const glm::dmat3 rows = glm::transpose(glm::dmat3(row(0), row(1), row(2)));
    view.eye = -(glm::inverse(rows) * Vec3(p[0][3], p[1][3], p[2][3]));
    return view;
}

Scene scene_of(const Solid& solid, const Material& material, const View& view,
               const ShrunkFrame& frame, int threads) {
    Scene scene;
    scene.stone.solid = solid;
    scene.stone.material = material;
    Camera& camera = scene.camera;
    camera.width = frame.picture->width / frame.shrink;
    camera.height = frame.picture->height / frame.shrink;
    camera.position = view.eye;
    camera.look_at = view.eye - view.toward;
    camera.up = view.up;
    camera.principal_point = {view.u / frame.shrink, view.v / frame.shrink};
    camera.fov = 2 * std::atan(camera.height / (2 * view.focal / frame.shrink));
    scene.settings.samples = frame.rays;
    scene.settings.wavelengths_nm = {k_sodium_nm};
    scene.settings.effects_auto = false;
    scene.settings.effects = {};
    scene.settings.threads = threads;
    return scene;
}

// Directions of the stone's frame to zones.
class Zones {
public:
    Zones(const View& view, const TurningCamera& camera) : toward_(view.toward) {
        const double c = std::cos(camera.elevation);
        up_ = c * std::sin(camera.roll) * view.right + c * std::cos(camera.roll) * view.up +
              std::sin(camera.elevation) * view.toward;
        front_ = glm::normalize(toward_ - glm::dot(toward_, up_) * up_);
        side_ = glm::cross(up_, front_);
    }
    std::size_t of(const Vec3& direction) const {
        if (glm::dot(direction, toward_) > std::cos(k_camera_cap)) return light_zones().size() - 1;
        const double up = degrees(std::asin(std::clamp(glm::dot(direction, up_), -1.0, 1.0)));
        const double azimuth = std::atan2(glm::dot(direction, side_), glm::dot(direction, front_));
        std::size_t zone = 0;
        for (const Ring& ring : k_rings) {
            if (up <= ring.to_deg) {
                const double part = azimuth / (2 * std::numbers::pi) * ring.sectors + 0.5;
                const int sector = int(std::floor(part)) % ring.sectors;
                return zone + std::size_t(sector < 0 ? sector + ring.sectors : sector);
            }
            zone += std::size_t(ring.sectors);
        }
        return zone - 1;
    }

private:
    Vec3 toward_, up_, front_, side_;
};

}  // namespace

const std::vector<LightZone>& light_zones() {
    static const std::vector<LightZone> zones = [] {
        std::vector<LightZone> made;
        for (const Ring& ring : k_rings) {
            for (int s = 0; s < ring.sectors; ++s) {
                const double width = 2 * std::numbers::pi / ring.sectors;
                made.push_back({ring.sectors == 1
                                    ? std::string(ring.name)
                                    : std::string(ring.name) + " " + k_sides[std::size_t(s)],
                                radians(ring.from_deg), radians(ring.to_deg), (s - 0.5) * width,
                                (s + 0.5) * width});
            }
        }
        made.push_back({"camera", 0, 0, 0, 0});
        return made;
    }();
    return zones;
}

ZoneShares zone_shares(const Solid& solid, const Material& material, const TurningCamera& camera,
                       const ShrunkFrame& frame, int threads) {
    const View view = view_of(frame.projection);
    const Scene scene = scene_of(solid, material, view, frame, threads);
    const std::size_t zones = light_zones().size();
    const std::size_t pixels = std::size_t(scene.camera.width) * std::size_t(scene.camera.height);
    ZoneShares result{cv::Mat::zeros(scene.camera.height, scene.camera.width, CV_8U),
                      std::vector<float>(pixels * zones)};
    const Zones zone(view, camera);
    std::vector<int> hits(pixels);
    std::uint32_t last = UINT32_MAX;
    visit_exits(scene, [&](const SeenExit& exit) {
        const std::size_t pixel = exit.ray / unsigned(frame.rays);
        if (exit.ray != last && ++hits[pixel] == frame.rays) result.stone.data[pixel] = 255;
        last = exit.ray;
        result.shares[pixel * zones + zone.of(exit.direction)] +=
            float(exit.weight) / float(frame.rays);
    });
    return result;
}

cv::Mat shrunk_picture(const ShrunkFrame& frame) {
    const int step = frame.shrink, width = frame.picture->width / step,
              height = frame.picture->height / step;
    std::array<float, 256> light{};
    for (std::size_t k = 0; k < light.size(); ++k)
        light[k] = float(srgb_decoded(double(k) / 255)) / float(step * step);
    cv::Mat result(height, width, CV_32FC3, cv::Scalar::all(0));
    for (int y = 0; y < height * step; ++y) {
        for (int x = 0; x < width * step; ++x) {
            cv::Vec3f& sum = result.at<cv::Vec3f>(y / step, x / step);
            const std::size_t at =
                3 * (std::size_t(y) * std::size_t(frame.picture->width) + std::size_t(x));
            for (std::size_t k = 0; k < 3; ++k) sum[int(k)] += light[frame.picture->rgb[at + k]];
        }
    }
    return result;
}

}  // namespace culet
