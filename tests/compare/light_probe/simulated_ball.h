#pragma once
// Photographs of a mirror ball under a known panorama, traced ray by ray: a camera at a finite
// distance, a perfect sphere, light from infinity. Independent of compare/light: the reflection is
// a vector equation at the point that a ray meets.

#include <cmath>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "compare/photo/photo.h"
#include "render/image/image_io.h"
#include "render/scene/scene.h"

namespace culet::simulated {

using Panorama = std::function<Rgb(const Vec3&)>;

/// Rooms with smooth and sharp-edged light: a sky over a ground, coloured walls, windows, lamps.
inline Panorama room(unsigned seed) {
    std::mt19937_64 random(seed);
    const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1.0p-53; };
    struct Patch {
        Vec3 direction;
        double cosine, edge;
        Rgb colour;
    };
    std::vector<Patch> patches;
    for (int i = 0; i < 25; ++i) {
        const double z = 2 * uniform() - 1, a = 2 * std::numbers::pi * uniform();
        const double r = std::sqrt(1 - z * z), size = 0.05 + 0.5 * uniform() * uniform();
        const double bright = 0.05 * std::pow(100.0, uniform() * uniform());
        patches.push_back({{r * std::cos(a), r * std::sin(a), z},
                           std::cos(size),
                           (0.006 + 0.02 * uniform()) * std::sin(size),
                           {bright * (0.6 + 0.8 * uniform()), bright * (0.6 + 0.8 * uniform()),
                            bright * (0.6 + 0.8 * uniform())}});
    }
    return [patches](const Vec3& d) {
        Rgb light{0.2 + 0.1 * d.z, 0.2 + 0.1 * d.z, 0.25 + 0.15 * d.z};
        for (const Patch& p : patches) {
            const double t =
                std::clamp((glm::dot(d, p.direction) - p.cosine) / p.edge + 0.5, 0.0, 1.0);
            if (t == 0) continue;
            for (std::size_t c = 0; c < 3; ++c)
                light[c] += (p.colour[c] - light[c]) * t * t * (3 - 2 * t);
        }
        return light;
    };
}

inline Panorama panorama_of(const EnvironmentMap& map) {
    return [&map](const Vec3& d) { return map.at(d); };
}

/// Reads a panorama as a map of that width, which must divide the file's: a ball resolves every
/// texel only if there are not too many for its pixels.
inline EnvironmentMap coarse_panorama(const std::filesystem::path& file, int width) {
    const Picture whole = read_picture(file).picture;
    EnvironmentMap map;
    map.width = width;
    map.height = width / 2;
    const int factor = whole.width / map.width;
    map.rgb.assign(3 * static_cast<std::size_t>(map.width) * map.height, 0.0f);
    for (int y = 0; y < factor * map.height; ++y) {
        for (int x = 0; x < factor * map.width; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                map.rgb[3 * (static_cast<std::size_t>(y / factor) * map.width + x / factor) + c] +=
                    std::max(0.0f, whole.at(x, y)[c]) / static_cast<float>(factor * factor);
            }
        }
    }
    return map;
}

struct BallShot {
    int width = 640, height = 480;
    double centre_x = 320.3, centre_y = 238.6, radius = 200;  ///< approximate, see `distance`
    double distance = 20;                                     ///< ball radii
    /// Columns: the camera's right, up and backward directions in the world.
    glm::dmat3 world_from_camera{Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(-1, 0, 0)};
    double reflectance = 0.6;
    double photographer = 0;  ///< half angle of a black disc behind the camera, radians
    int samples = 4;          ///< per pixel and axis
    std::function<Rgb(double, double)> background;  ///< by pixel; empty: the panorama itself
    /// Near objects, in front of the panorama: their light along a line, in ball radii and the
    /// world's frame, in which `place` is the ball's centre.
    std::function<std::optional<Rgb>(const Vec3&, const Vec3&)> near;
    Vec3 place{0, 0, 0};
};

inline glm::dmat3 camera_at(double azimuth, double elevation) {
    const double ca = std::cos(azimuth), sa = std::sin(azimuth);
    const double ce = std::cos(elevation), se = std::sin(elevation);
    const Vec3 forward(ce * ca, ce * sa, se), up(-se * ca, -se * sa, ce);
    return {glm::cross(forward, up), up, -forward};
}

struct Taken {
    Photo photo;
    double x = 0, y = 0, radius = 0;  ///< a circle about the outline: the mean of its four extremes
};

/// The ball's middle appears at (centre_x, centre_y). The focal length is that of a ball with
/// `radius` pixels in the picture's middle.
inline Taken take(const BallShot& shot, const Panorama& panorama) {
    Taken taken;
    Photo& photo = taken.photo;
    photo.width = shot.width;
    photo.height = shot.height;
    const double focal = shot.radius * std::sqrt(shot.distance * shot.distance - 1);
    const double px = (shot.width - 1) / 2.0, py = (shot.height - 1) / 2.0;
    const auto ray = [&](double x, double y) {
        return glm::normalize(Vec3((x - px) / focal, -(y - py) / focal, -1));
    };
    const Vec3 axis = ray(shot.centre_x, shot.centre_y), centre = shot.distance * axis;
    const auto hits = [&](const Vec3& v) {
        const Vec3 beside = glm::dot(v, centre) * v - centre;
        return glm::dot(beside, beside) < 1;
    };
    photo.rgb.resize(3 * static_cast<std::size_t>(shot.width) * shot.height);
    const int n = shot.samples;
    for (int y = 0; y < shot.height; ++y) {
        for (int x = 0; x < shot.width; ++x) {
            Rgb sum{};
            for (int k = 0; k < n * n; ++k) {
                const double sx = x - 0.5 + (k % n + 0.5) / n, sy = y - 0.5 + (k / n + 0.5) / n;
                const Vec3 v = ray(sx, sy);
                Rgb light{};
                if (hits(v)) {
                    const double along = glm::dot(v, centre);
                    const double t =
                        along - std::sqrt(along * along - glm::dot(centre, centre) + 1);
                    const Vec3 normal = t * v - centre;
                    const Vec3 out = v - 2 * glm::dot(v, normal) * normal;
                    const bool photographer =
                        glm::dot(out, -axis) > std::cos(shot.photographer) && shot.photographer > 0;
                    const Vec3 in_world = shot.world_from_camera * out;
                    std::optional<Rgb> near;
                    if (shot.near)
                        near = shot.near(shot.place + shot.world_from_camera * normal, in_world);
                    if (!photographer) light = near ? *near : panorama(in_world);
                    for (double& c : light) c *= shot.reflectance;
                } else {
                    light = shot.background ? shot.background(sx, sy)
                                            : panorama(shot.world_from_camera * v);
                }
                for (std::size_t c = 0; c < 3; ++c) sum[c] += light[c] / (n * n);
            }
            for (std::size_t c = 0; c < 3; ++c)
                photo.rgb[3 * (static_cast<std::size_t>(y) * shot.width + x) + c] =
                    static_cast<float>(sum[c]);
        }
    }
    // The ball's edge along a direction from the middle, by bisection.
    const auto edge = [&](double dx, double dy) {
        double inside = 0, outside = 2 * shot.radius;
        for (int i = 0; i < 60; ++i) {
            const double t = (inside + outside) / 2;
            (hits(ray(shot.centre_x + t * dx, shot.centre_y + t * dy)) ? inside : outside) = t;
        }
        return inside;
    };
    const double left = shot.centre_x - edge(-1, 0), right = shot.centre_x + edge(1, 0);
    const double top = shot.centre_y - edge(0, -1), bottom = shot.centre_y + edge(0, 1);
    taken.x = (left + right) / 2;
    taken.y = (top + bottom) / 2;
    taken.radius = (right - left + bottom - top) / 4;
    return taken;
}

/// Photon and sensor noise, and 16 bits up to `white`.
inline void expose(Photo& photo, double white, double electrons, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    for (float& v : photo.rgb) {
        const double full = std::min(v / white, 1.0) * electrons;
        const double read = full + std::sqrt(full + 4) * normal(random);
        v = static_cast<float>(std::clamp(read / electrons, 0.0, 1.0) * white);
    }
    photo.saturation = white;
}

}  // namespace culet::simulated
