#include "render/objects/object_surroundings.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "render/reference/prepared_scene.h"
#include "stone/solid/perpendicular.h"

namespace culet {

namespace {

// Depends on the ray only, so pictures do not depend on threads.
Random random_of(std::uint64_t seed, const Vec3& origin, const Vec3& direction) {
    std::uint64_t state = Random::mixed(seed);
    for (const double c : {origin.x, origin.y, origin.z, direction.x, direction.y, direction.z})
        state = Random::mixed(state + 0x9e3779b97f4a7c15ull + std::bit_cast<std::uint64_t>(c));
    return Random(state);
}

// Exits of less weight are followed with proportional probability.
constexpr double k_exit_threshold = 0.25;

}  // namespace

SceneWithObjects::SceneWithObjects(const Scene& scene, const WavelengthSet& wavelengths)
    : world(scene),
      lights(scene.lights, wavelengths),
      sampler(scene),
      polarised_lights(polarised(scene.lights)),
      nodes(wavelengths.size()),
      brightest(lights.max_radiance()),
      most_indirect(
          scene.settings.clamp_indirect.value_or(std::numeric_limits<double>::infinity())),
      seed(scene.settings.seed) {
    for (const SceneObject& object : scene.objects) {
        surfaces.emplace_back(object.material, wavelengths, scene.immersion);
        if (surfaces.back().kind != SurfaceKind::emitter) continue;
        for (const double radiance : surfaces.back().colour)
            brightest = std::max(brightest, radiance);
    }
    Scene of_stone;
    of_stone.camera = scene.camera;
    of_stone.lights = scene.lights;
    of_stone.objects = scene.objects;
    of_stone.more_stones = scene.more_stones;
    of_stone.immersion = scene.immersion;
    of_stone.settings = scene.settings;
    of_stone.settings.wavelengths_nm = wavelengths.wavelengths_nm();
    const auto prepare = [&](const Stone& stone) {
        of_stone.stone = stone;
        ReadyStone& ready = stones.emplace_back(ReadyStone{make_optical_setup(of_stone), {}});
        ready.limits = limits_with_objects(of_stone, ready.setup);
    };
    if (scene.has_stone()) prepare(scene.stone);
    for (const Stone& stone : scene.more_stones) prepare(stone);
}

WorldRay ObjectSurroundings::ray(const Vec3& origin, const Vec3& direction, const Vec3& u,
                                 const Vec3& v) const {
    return {origin, direction, u, v, {-1, -1, scene_.world.has_first_stone() ? 0 : -1}};
}

double ObjectSurroundings::ask(WorldRay ray, double weight, int first, int count, int planes,
                               ArrivingLight& light) const {
    Random random = random_of(scene_.seed, ray.origin, ray.direction);
    ray.importance = weight;
    return ObjectPaths(scene_, first, count, planes, random)
        .arriving_if_it_matters(ray, k_exit_threshold, light);
}

void ObjectSurroundings::add_radiance(const Vec3& origin, const Vec3& direction, double weight,
                                      int first, int count, double* radiance) const {
    const Vec3 u = perpendicular_to(direction), v = glm::cross(direction, u);
    for (int start = first; start < first + count; start += k_band_nodes) {
        const int some = std::min(k_band_nodes, first + count - start);
        ArrivingLight light;
        const double gain = ask(ray(origin, direction, u, v), weight, start, some, 1, light);
        if (gain == 0) return;
        for (int i = 0; i < some; ++i) radiance[start - first + i] += weight * gain * light[0][i];
    }
}

void ObjectSurroundings::add_stokes(const PathEnd& end, int first, int count, double* stokes,
                                    int stride) const {
    const double weight =
        end.coherency.power() *
        *std::max_element(end.transmitted.begin(), end.transmitted.begin() + count);
    ArrivingLight light;
    const double gain =
        ask(ray(end.at, end.direction, end.u, end.v), weight, first, count, 4, light);
    if (gain == 0) return;
    for (int i = 0; i < count; ++i) {
        const Stokes seen =
            stokes_of_light(end.coherency, {light[0][i], light[1][i], light[2][i], light[3][i]});
        for (int k = 0; k < 4; ++k)
            stokes[k * stride + first + i] += gain * end.transmitted[i] * seen[k];
    }
}

void ObjectSurroundings::add_direct_stokes(const EyeRay& eye, const EyeFrame& frame, int nodes,
                                           double* stokes) const {
    for (int first = 0; first < nodes; first += k_band_nodes) {
        const int count = std::min(k_band_nodes, nodes - first);
        ArrivingLight light;
        ask(ray(eye.origin, eye.direction, frame.x, frame.y), 1, first, count, 4, light);
        for (int k = 0; k < 4; ++k) {
            for (int i = 0; i < count; ++i) stokes[k * nodes + first + i] += light[k][i];
        }
    }
}

double ObjectSurroundings::nearest_distance(const Vec3& origin, const Vec3& direction) const {
    const WorldRay from = ray(origin, direction, Vec3(0), Vec3(0));
    return std::min(scene_.world.nearest(origin, direction, from.start).distance,
                    scene_.lights.nearest_distance(origin, direction));
}

WorldHit ObjectSurroundings::first_hit(const Vec3& origin, const Vec3& direction) const {
    const WorldRay from = ray(origin, direction, Vec3(0), Vec3(0));
    const WorldHit hit = scene_.world.nearest(origin, direction, from.start);
    return scene_.lights.nearest_distance(origin, direction) < hit.distance ? WorldHit() : hit;
}

bool ObjectSurroundings::stands_at(const Vec3& origin, const Vec3& direction) const {
    return first_hit(origin, direction).met();
}

std::string ObjectSurroundings::name_at(const Vec3& origin, const Vec3& direction) const {
    const WorldHit hit = first_hit(origin, direction);
    if (!hit.met()) return scene_.lights.name_at(origin, direction);
    return hit.stone >= 0 ? fmt::format("stone {}", hit.stone)
                          : fmt::format("object {}", hit.object);
}

std::unique_ptr<const Surroundings> surroundings_of(const Scene& scene,
                                                    const WavelengthSet& wavelengths) {
    if (scene.has_objects()) return std::make_unique<ObjectSurroundings>(scene, wavelengths);
    return std::make_unique<LightField>(scene.lights, wavelengths);
}

}  // namespace culet
