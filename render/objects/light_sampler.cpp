#include "render/objects/light_sampler.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/scene/environment_layout.h"
#include "stone/solid/perpendicular.h"

namespace culet {

namespace {

constexpr double k_pi = std::numbers::pi;
// Least exponent of lobes that are sampled; wider ones are left to the surface.
constexpr double k_narrow_lobe = 2;
constexpr int k_sky_height = 128;

double brightness(const LightColour& colour) {
    if (const double* number = std::get_if<double>(&colour.value)) return *number;
    if (const Rgb* rgb = std::get_if<Rgb>(&colour.value)) return std::abs(luminance(*rgb));
    return 1;
}

// The direction with this cosine to `axis` and this azimuth about it.
Vec3 about(const Vec3& axis, double cosine, double azimuth) {
    const Vec3 x = perpendicular_to(axis), y = glm::cross(axis, x);
    const double sine = std::sqrt(std::max(0.0, (1 - cosine) * (1 + cosine)));
    return glm::normalize(sine * (std::cos(azimuth) * x + std::sin(azimuth) * y) + cosine * axis);
}

// 1 - cosine of the angle that a ball subtends from `distance`, without cancellation.
double cap_height(double radius, double distance) {
    const double sine = radius / distance;
    return sine * sine / (1 + std::sqrt((1 - sine) * (1 + sine)));
}

// Approximately, for an area seen from afar; at most half of all directions.
double solid_angle(const Vec3& to, double area) {
    return area / std::max(glm::dot(to, to), area / (2 * k_pi));
}

}  // namespace

std::optional<Vec3> LightSampler::sample(const Ball& ball, const Vec3& from, Random& random) {
    const Vec3 to = ball.center - from;
    const double distance = glm::length(to);
    if (!(distance > ball.radius)) return std::nullopt;
    const double cosine = 1 - random.uniform() * cap_height(ball.radius, distance);
    return about(to / distance, cosine, 2 * k_pi * random.uniform());
}

double LightSampler::density(const Ball& ball, const Vec3& from, const Vec3& direction) {
    const Vec3 to = ball.center - from;
    const double distance = glm::length(to), along = glm::dot(to, direction);
    if (!(distance > ball.radius) || !(along > 0)) return 0;
    const Vec3 beside = to - along * direction;
    if (glm::dot(beside, beside) > ball.radius * ball.radius) return 0;
    return 1 / (2 * k_pi * cap_height(ball.radius, distance));
}

std::optional<Vec3> LightSampler::sample(const Flat& flat, const Vec3& from, Random& random) {
    double a = 2 * random.uniform() - 1, b = 2 * random.uniform() - 1;
    if (flat.round) {
        const double r = std::sqrt(0.5 * (a + 1)), azimuth = k_pi * b;
        a = r * std::cos(azimuth);
        b = r * std::sin(azimuth);
    }
    const Vec3 to = flat.center + a * flat.u + b * flat.v - from;
    const double distance = glm::length(to);
    if (!(distance > 0)) return std::nullopt;
    return to / distance;
}

double LightSampler::density(const Flat& flat, const Vec3& from, const Vec3& direction) {
    const double rate = glm::dot(direction, flat.normal);
    const double distance = glm::dot(flat.center - from, flat.normal) / rate;
    if (!(distance > 0) || !std::isfinite(distance)) return 0;
    const Vec3 at = from + distance * direction - flat.center;
    // Coordinates along u and v, which need not be perpendicular.
    const Vec3 across = glm::cross(flat.u, flat.v);
    const double scale = 1 / glm::dot(across, across);
    const double a = glm::dot(glm::cross(at, flat.v), across) * scale,
                 b = glm::dot(glm::cross(flat.u, at), across) * scale;
    const bool inside = flat.round ? a * a + b * b <= 1 : std::abs(a) <= 1 && std::abs(b) <= 1;
    return inside ? distance * distance / (std::abs(rate) * flat.area) : 0;
}

std::optional<Vec3> LightSampler::sample(const Ring& ring, const Vec3&, Random& random) {
    const double cosine = ring.to_cosine + random.uniform() * (ring.from_cosine - ring.to_cosine);
    return about(ring.axis, cosine, 2 * k_pi * random.uniform());
}

double LightSampler::density(const Ring& ring, const Vec3&, const Vec3& direction) {
    const double cosine = glm::dot(ring.axis, direction);
    if (cosine > ring.from_cosine || cosine < ring.to_cosine) return 0;
    return 1 / (2 * k_pi * (ring.from_cosine - ring.to_cosine));
}

std::optional<Vec3> LightSampler::sample(const Lobe& lobe, const Vec3&, Random& random) {
    const double cosine = std::pow(1 - random.uniform(), 1 / (lobe.exponent + 1));
    return about(lobe.axis, cosine, 2 * k_pi * random.uniform());
}

double LightSampler::density(const Lobe& lobe, const Vec3&, const Vec3& direction) {
    const double cosine = glm::dot(lobe.axis, direction);
    if (!(cosine > 0)) return 0;
    return (lobe.exponent + 1) / (2 * k_pi) * std::pow(cosine, lobe.exponent);
}

std::optional<Vec3> LightSampler::sample(const Sky& sky, const Vec3&, Random& random) {
    const auto chosen =
        std::upper_bound(sky.sums.begin(), sky.sums.end(), random.uniform() * sky.sums.back());
    const auto cell = static_cast<int>(
        std::min(chosen - sky.sums.begin(), static_cast<std::ptrdiff_t>(sky.sums.size()) - 1));
    const int row = cell / sky.width, column = cell % sky.width;
    const double top = std::cos(k_pi * row / sky.height),
                 bottom = std::cos(k_pi * (row + 1) / sky.height);
    const double z = top + random.uniform() * (bottom - top);
    // In EnvironmentMap's frame.
    const double azimuth = (0.5 - (column + random.uniform()) / sky.width) * 2 * k_pi;
    const double across = std::sqrt(std::max(0.0, (1 - z) * (1 + z)));
    return Vec3{across * std::cos(azimuth), across * std::sin(azimuth), z};
}

double LightSampler::density(const Sky& sky, const Vec3&, const Vec3& direction) {
    const double polar = std::acos(std::clamp(direction.z, -1.0, 1.0));
    const double azimuth = std::atan2(direction.y, direction.x);
    const int row = std::min(static_cast<int>(polar / k_pi * sky.height), sky.height - 1);
    const double place = 0.5 - azimuth / (2 * k_pi);
    const int column =
        std::min(static_cast<int>((place - std::floor(place)) * sky.width), sky.width - 1);
    return sky.density[static_cast<std::size_t>(row * sky.width + column)];
}

LightSampler::LightSampler(const Scene& scene) {
    add_lights(scene.lights, scene.camera.look_at);
    add_emitters(scene.objects, scene.camera.look_at);
    double sum = 0;
    for (const double power : share_) sum += power;
    for (double& power : share_) power /= sum;
}

void LightSampler::add(Part part, double power) {
    if (!(power > 0) || !std::isfinite(power)) return;
    parts_.push_back(std::move(part));
    share_.push_back(power);
}

void LightSampler::add_lights(const Lights& lights, const Vec3& about) {
    const auto near_power = [&](const Vec3& center, double area, double bright) {
        return bright * solid_angle(center - about, area);
    };
    static_assert(std::variant_size_v<Light> == 6, "a new kind of light is sampled here, too");
    for (const Light& light : lights.sources) {
        const double bright = brightness(colour_of(light));
        if (const auto ball = ball_of(light)) {
            add(Ball{ball->center, ball->radius},
                near_power(ball->center, k_pi * ball->radius * ball->radius, bright));
        } else if (const auto* plane = std::get_if<PlaneLight>(&light); plane && plane->u) {
            const double area = 4 * glm::length(glm::cross(*plane->u, *plane->v));
            add(Flat{plane->point, plane->normal, *plane->u, *plane->v, false, area},
                near_power(plane->point, area, bright));
        } else if (const auto* cap = std::get_if<DiscLight>(&light)) {
            const DiscCosines cosines = cosines_of(*cap);
            const double from = std::min(cosines.from, 1.0), to = std::max(cosines.to, -1.0);
            add(Ring{cap->direction, from, to}, bright * 2 * k_pi * (from - to));
        } else if (const auto* lobe = std::get_if<CosinePowerLight>(&light);
                   lobe && lobe->exponent >= k_narrow_lobe) {
            add(Lobe{lobe->direction, lobe->exponent}, bright * 2 * k_pi / (lobe->exponent + 1));
        }
    }
    if (lights.environment) add_sky(*lights.environment);
}

void LightSampler::add_sky(const EnvironmentMap& map) {
    Sky sky;
    sky.height = std::min(k_sky_height, map.height);
    sky.width = 2 * sky.height;
    std::vector<double> power(static_cast<std::size_t>(sky.width * sky.height), 0.0);
    for (int row = 0; row < map.height; ++row) {
        const double angle = lat_long_solid_angle(row, map.width, map.height);
        for (int column = 0; column < map.width; ++column) {
            const auto texel = static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                               static_cast<std::size_t>(column);
            const int cell_row =
                          static_cast<int>(static_cast<long long>(row) * sky.height / map.height),
                      cell_column =
                          static_cast<int>(static_cast<long long>(column) * sky.width / map.width);
            power[static_cast<std::size_t>(cell_row * sky.width + cell_column)] +=
                angle * luminance(map.rgb.data() + 3 * texel);
        }
    }
    double sum = 0;
    for (const double p : power) {
        sum += p;
        sky.sums.push_back(sum);
    }
    for (std::size_t i = 0; i < power.size(); ++i) {
        const int row = static_cast<int>(i) / sky.width;
        sky.density.push_back(power[i] / sum / lat_long_solid_angle(row, sky.width, sky.height));
    }
    add(std::move(sky), sum);
}

void LightSampler::add_emitters(const std::vector<SceneObject>& objects, const Vec3& about) {
    for (const SceneObject& object : objects) {
        const auto* emitter = std::get_if<EmitterMaterial>(&object.material);
        if (emitter == nullptr) continue;
        const double bright = brightness(emitter->radiance);
        const auto add_ball = [&](const Vec3& center, double radius) {
            add(Ball{center, radius}, bright * solid_angle(center - about, k_pi * radius * radius));
        };
        if (const auto* sphere = std::get_if<SphereShape>(&object.shape)) {
            add_ball(sphere->center, sphere->radius);
        } else if (const auto* box = std::get_if<BoxShape>(&object.shape)) {
            add_ball(box->center, glm::length(box->half));
        } else if (const auto* disc = std::get_if<DiscShape>(&object.shape)) {
            const Vec3 x = perpendicular_to(disc->normal), y = glm::cross(disc->normal, x);
            const double area = k_pi * disc->radius * disc->radius;
            add(Flat{disc->center, disc->normal, disc->radius * x, disc->radius * y, true, area},
                bright * solid_angle(disc->center - about, area));
        } else if (const auto* shape = std::get_if<MeshShape>(&object.shape)) {
            Vec3 low(shape->mesh->vertices.front()), high = low;
            for (const Vec3& vertex : shape->mesh->vertices) {
                low = glm::min(low, vertex);
                high = glm::max(high, vertex);
            }
            add_ball(0.5 * (low + high), 0.5 * glm::length(high - low));
        }
    }
}

std::optional<Vec3> LightSampler::sample(const Vec3& from, Random& random) const {
    double left = random.uniform();
    std::size_t chosen = 0;
    while (chosen + 1 < share_.size() && left >= share_[chosen]) left -= share_[chosen++];
    return std::visit([&](const auto& part) { return sample(part, from, random); }, parts_[chosen]);
}

double LightSampler::density(const Vec3& from, const Vec3& direction) const {
    double sum = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        sum +=
            share_[i] *
            std::visit([&](const auto& part) { return density(part, from, direction); }, parts_[i]);
    }
    return sum;
}

}  // namespace culet
