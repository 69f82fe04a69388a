#include "tests/compare/simulated_photo.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "compare/pose/stone_view.h"
#include "render/colour/colour.h"
#include "stone/numbers/quantile.h"
#include "stone/numbers/units.h"
#include "stone/solid/perpendicular.h"
#include "stone/text/errors.h"

namespace culet::synthetic {

namespace {

double normal(std::mt19937_64& random) {
    return std::normal_distribution<double>()(random);
}

double uniform(std::mt19937_64& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

/// Writes and reads a JPEG, in 8 bits through the sRGB curve.
void compress(Photo& photo, int quality) {
    cv::Mat shown(photo.height, photo.width, CV_8UC3), back;
    for (std::size_t i = 0; i < photo.rgb.size(); ++i)
        shown.data[i] = static_cast<unsigned char>(
            std::lround(255 * srgb_encoded(static_cast<double>(photo.rgb[i]))));
    cv::cvtColor(shown, shown, cv::COLOR_RGB2BGR);
    std::vector<unsigned char> bytes;
    cv::imencode(".jpg", shown, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
    cv::cvtColor(cv::imdecode(bytes, cv::IMREAD_COLOR), back, cv::COLOR_BGR2RGB);
    for (std::size_t i = 0; i < photo.rgb.size(); ++i)
        photo.rgb[i] = static_cast<float>(srgb_decoded(back.data[i] / 255.0));
}

}  // namespace

Solid tilted_facets(const Solid& solid, double sigma, std::mt19937_64& random) {
    std::vector<NamedPlane> planes;
    for (const Facet& facet : solid.facets) {
        const Vec3 middle = corner_mean(solid, facet);
        const Vec3 across = perpendicular_to(facet.plane.normal);
        const Vec3 along = glm::cross(facet.plane.normal, across);
        const double turn = uniform(random, 0, 2 * std::numbers::pi);
        const double tilt = sigma * normal(random);
        const Vec3 tilted =
            glm::normalize(facet.plane.normal +
                           std::tan(tilt) * (std::cos(turn) * across + std::sin(turn) * along));
        planes.push_back({facet.name, {tilted, glm::dot(tilted, middle)}});
    }
    return intersect_half_spaces(planes).solid;
}

Photo photographed(const Picture& picture, const CameraFaults& faults, std::mt19937_64& random) {
    cv::Mat light(picture.height, picture.width, CV_32FC3);
    std::copy(picture.rgb.begin(), picture.rgb.end(), light.ptr<float>());
    if (faults.blur_px > 0) {
        cv::GaussianBlur(light, light, {0, 0}, faults.blur_px, faults.blur_px,
                         cv::BORDER_REPLICATE);
    }
    std::vector<float> bright;
    for (std::size_t p = 0; p < picture.pixels(); ++p) {
        if (!picture.coverage.empty() && picture.coverage[p] < 0.5f) continue;
        const float* rgb = light.ptr<float>() + 3 * p;
        bright.push_back(std::max({rgb[0], rgb[1], rgb[2]}));
    }
    const double exposure =
        1 / std::max(1e-9, static_cast<double>(quantile(std::move(bright), faults.exposure_share)));
    Photo photo;
    photo.width = picture.width;
    photo.height = picture.height;
    photo.saturation = 1;
    photo.encoding = "8-bit sRGB";
    for (int y = 0; y < light.rows; ++y) {
        for (int i = 0; i < 3 * light.cols; ++i) {
            const double electrons =
                faults.full_well * exposure * static_cast<double>(light.ptr<float>(y)[i]);
            const double counted =
                electrons + normal(random) * std::sqrt(std::max(0.0, electrons) +
                                                       faults.read_noise * faults.read_noise);
            double value = std::clamp(counted / faults.full_well, 0.0, 1.0);
            if (faults.eight_bit) value = srgb_decoded(std::round(255 * srgb_encoded(value)) / 255);
            photo.rgb.push_back(static_cast<float>(value));
        }
    }
    if (faults.jpeg_quality > 0) compress(photo, faults.jpeg_quality);
    return photo;
}

Photo cropped(const Photo& photo, int left, int top, int width, int height) {
    Photo part = photo;
    part.width = width;
    part.height = height;
    part.rgb.clear();
    for (int y = top; y < top + height; ++y) {
        const auto row =
            photo.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * photo.width + left);
        part.rgb.insert(part.rgb.end(), row, row + 3 * static_cast<std::ptrdiff_t>(width));
    }
    return part;
}

Photo mirrored(const Photo& photo) {
    Photo turned = photo;
    for (int y = 0; y < photo.height; ++y) {
        for (int x = 0; x < photo.width; ++x) {
            const auto to = static_cast<std::size_t>(y * photo.width + x);
            const auto from = static_cast<std::size_t>(y * photo.width + photo.width - 1 - x);
            for (std::size_t c = 0; c < 3; ++c) turned.rgb[3 * to + c] = photo.rgb[3 * from + c];
        }
    }
    return turned;
}

Lights named_lights(const std::string& name) {
    Lights lights;
    const Vec3 up(0, 0, 1);
    if (name == "windows") {
        // A box: dim walls above, a grey floor, two windows and a lamp.
        lights.sources.push_back(HemisphereLight{up, {0.1}});
        lights.sources.push_back(HemisphereLight{-up, {0.03}});
        lights.sources.push_back(
            DiscLight{glm::normalize(Vec3(1, 0.3, 0.6)), 0, radians(20), {3.0}});
        lights.sources.push_back(
            DiscLight{glm::normalize(Vec3(-0.6, 1, 0.9)), 0, radians(12), {2.0}});
        lights.sources.push_back(
            DiscLight{glm::normalize(Vec3(-0.3, -1, 0.5)), 0, radians(8), {2.5}});
    } else if (name == "dome") {
        // A panorama: bands and patches of sky over a grey ground.
        auto map = std::make_shared<EnvironmentMap>();
        map->width = 256;
        map->height = 128;
        for (int y = 0; y < map->height; ++y) {
            for (int x = 0; x < map->width; ++x) {
                const double azimuth = 2 * std::numbers::pi * (x + 0.5) / map->width;
                const double from_top = std::numbers::pi * (y + 0.5) / map->height;
                double sky = 0.08;
                if (from_top < 0.5 * std::numbers::pi) {
                    sky = 0.5 +
                          0.4 * std::sin(3 * azimuth + 5 * from_top) * std::sin(7 * from_top + 1) +
                          (std::sin(5 * azimuth) * std::sin(4 * from_top) > 0.8 ? 3.0 : 0.0);
                }
                const auto pixel = {0.9f, 1.0f, 1.1f};
                for (float tint : pixel) map->rgb.push_back(static_cast<float>(sky) * tint);
            }
        }
        lights.environment = map;
    } else if (name == "ring") {
        lights.sources.push_back(HemisphereLight{-up, {0.25}});
        lights.sources.push_back(DiscLight{up, radians(14), radians(75), {1.0}});
    } else if (name == "overcast") {
        lights.sources.push_back(HemisphereLight{up, {0.6}});
        lights.sources.push_back(HemisphereLight{-up, {0.15}});
        lights.sources.push_back(CosinePowerLight{glm::normalize(Vec3(0.4, 0.2, 1)), 3, {0.8}});
    } else {
        throw InputError("no lights " + name);
    }
    return lights;
}

Camera camera_at(const Solid& solid, const Standpoint& place) {
    const Vec3 middle = centroid(solid);
    const Vec3 towards(std::sin(place.tilt) * std::cos(place.azimuth),
                       std::sin(place.tilt) * std::sin(place.azimuth), std::cos(place.tilt));
    const double size = diameter(solid);
    Camera camera;
    camera.width = camera.height = place.size;
    const double distance = (place.diameters > 0 ? place.diameters : 20) * size;
    camera.position = middle + distance * towards;
    camera.look_at = middle;
    const Vec3 right = glm::normalize(glm::cross(Vec3(0, 1, 0.01), towards));
    const Vec3 up = glm::cross(towards, right);
    camera.up = std::cos(place.roll) * up + std::sin(place.roll) * right;
    const double width = size / place.share;
    if (place.diameters > 0) {
        camera.fov = 2 * std::atan(0.5 * width / distance);
    } else {
        camera.orthographic_width = width;
    }
    const Vec3 camera_right = glm::normalize(glm::cross(-towards, camera.up));
    const Vec3 shift = width * (place.off_x * camera_right + place.off_y * camera.up);
    camera.position += shift;
    camera.look_at += shift;
    return camera;
}

Camera disturbed(const Camera& camera, const Solid& solid, double angle, double scale,
                 std::mt19937_64& random) {
    StoneView view = stone_view(camera, centroid(solid));
    Vec3 axis(normal(random), normal(random), normal(random));
    axis = glm::normalize(axis);
    view.turn = rotation_by(angle * axis) * view.turn;
    view.scale *= scale;
    view.nearness *= scale;
    view.at = {0.5 * camera.width, 0.5 * camera.height};
    return camera_of(view, camera);
}

}  // namespace culet::synthetic
