#include "tests/refine/lit_stone.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/photo/rendered_photo.h"
#include "render/beams/frame_renderer.h"
#include "stone/numbers/units.h"
#include "tests/refine/spin_frames.h"

namespace culet::synthetic {

namespace {

// Radiances; white paper in the picture is 1.
constexpr double k_dome = 1.3, k_wall = 0.6, k_camera = 0.03, k_ground = 0.35;
constexpr double k_camera_cap = radians(27), k_horizon = radians(100);  // from the line of sight
constexpr double k_blur = 0.7, k_halo = 1.2, k_sharpening = 0.6;
constexpr double k_shadow = 0.35;  // of the ground's light, where it is darkest

// Brightest above; dark round the camera.
Lights surround(const Vec3& sight) {
    Lights lights;
    lights.constant = k_camera;
    lights.sources.push_back(DiscLight{sight, k_camera_cap, k_horizon, {k_wall - k_camera}});
    lights.sources.push_back(DiscLight{sight, k_horizon, std::numbers::pi, {k_ground - k_camera}});
    lights.sources.push_back(CosinePowerLight{{0, 0, 1}, 2, {k_dome - k_wall}});
    return lights;
}

// Of the light that falls straight down past the stone, blurred over a tenth of its size.
cv::Mat shadow(const SpinTruth& truth, double turn) {
    const PictureAxes at = picture_axes(truth.series.camera, turn);
    double depth = 0;
    for (const Vec3& v : truth.solid.vertices) depth = std::max(depth, -v.z);
    std::vector<cv::Point> foot, hull;
    for (const Vec3& v : truth.solid.vertices) {
        const Vec3 below(v.x, v.y, -depth);
        const double near = 1 - glm::dot(at.nearing, below);
        foot.emplace_back(
            int(std::lround(truth.size / 2.0 + at.dx + glm::dot(at.across, below) / near)),
            int(std::lround(truth.size / 2.0 - at.dy - glm::dot(at.along, below) / near)));
    }
    cv::convexHull(foot, hull);
    cv::Mat light(truth.size, truth.size, CV_32F, cv::Scalar(1));
    cv::fillConvexPoly(light, hull, cv::Scalar(1 - k_shadow));
    cv::GaussianBlur(light, light, {0, 0}, diameter(truth.solid) / 10);
    return light;
}

cv::Mat through(const cv::Mat& picture, double power) {
    cv::Mat result;
    cv::pow(cv::max(picture, 0.0), power, result);
    return result;
}

}  // namespace

Scene LitStone::scene_at(double turn) const {
    // The stone turns; camera and light stand still.
    const PictureAxes at = picture_axes(truth_.series.camera, 0);
    const Vec3 sight = glm::normalize(at.nearing);
    const double distance = 1 / glm::length(at.nearing), half = truth_.size / 2.0;
    Scene scene;
    scene.stone.solid = truth_.solid;
    scene.stone.up_facet = "T";
    const double c = std::cos(turn), s = std::sin(turn);
    const auto turned = [&](const Vec3& v) {
        return Vec3(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
    };
    for (Vec3& v : scene.stone.solid.vertices) v = turned(v);
    for (Facet& f : scene.stone.solid.facets) f.plane.normal = turned(f.plane.normal);
    scene.stone.material = catalogue_material("diamond");
    scene.camera.position = distance * sight;
    scene.camera.up = at.along;
    scene.camera.fov = 2 * std::atan(half / distance);
    scene.camera.width = scene.camera.height = truth_.size;
    scene.camera.principal_point = {{half + at.dx, half - at.dy}};
    scene.lights = surround(sight);
    scene.settings.engine = k_beam_engine;
    scene.settings.depth = 8;
    scene.settings.tolerance = 0.03;
    scene.settings.wavelengths_nm = {460, 550, 620};
    scene.settings.effects_auto = false;
    scene.settings.effects = {true, false, false, false, false, false, false};
    scene.settings.check = Check::none;
    return scene;
}

cv::Mat LitStone::on(const cv::Mat& ground, double turn) const {
    FrameRenderer renderer(scene_at(turn));
    const Photo photo = photo_of(renderer.draw().picture);
    const cv::Mat stone(photo.height, photo.width, CV_32FC3, const_cast<float*>(photo.rgb.data()));
    const cv::Mat shade = shadow(truth_, turn);
    cv::Mat light;
    ground.convertTo(light, CV_32FC3, 1 / 255.0);
    light = through(light, 2.2);
    for (int y = 0; y < light.rows; ++y) {
        for (int x = 0; x < light.cols; ++x) {
            const float bare = 1 - photo.coverage[std::size_t(y * photo.width + x)];
            // The renderer's own background is the surround below the horizon.
            light.at<cv::Vec3f>(y, x) = bare * shade.at<float>(y, x) * light.at<cv::Vec3f>(y, x) +
                                        stone.at<cv::Vec3f>(y, x) -
                                        cv::Vec3f::all(bare * float(k_ground));
        }
    }
    cv::GaussianBlur(light, light, {0, 0}, k_blur);
    cv::Mat levels = 255 * through(cv::min(light, 1.0), 1 / 2.2), soft;
    cv::GaussianBlur(levels, soft, {0, 0}, k_halo);
    levels = (1 + k_sharpening) * levels - k_sharpening * soft;
    levels.convertTo(levels, CV_8UC3);
    return levels;
}

void compress(LevelPicture& picture, int quality) {
    cv::Mat levels(picture.height, picture.width, CV_8UC3, picture.rgb.data()), bgr;
    cv::cvtColor(levels, bgr, cv::COLOR_RGB2BGR);
    std::vector<unsigned char> bytes;
    cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    cv::cvtColor(cv::imdecode(bytes, cv::IMREAD_COLOR), levels, cv::COLOR_BGR2RGB);
}

}  // namespace culet::synthetic
