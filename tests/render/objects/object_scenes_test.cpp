// Scenes with objects and several stones, against closed forms and against equivalent scenes. Means
// of many random rays lie within five of their standard errors, estimated from the pictures' own
// pixels or seeds.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/engine/engine.h"
#include "render/optics/fresnel.h"
#include "render/planner/pilot_picture.h"
#include "render/render.h"
#include "stone/text/errors.h"
#include "tests/render/carved_solids.h"
#include "tests/render/ray_stones.h"

namespace culet {
namespace {

// One wavelength: pictures are grey, and surfaces have one number.
Scene empty_scene(int side, int samples) {
    Scene scene;
    scene.camera.width = scene.camera.height = side;
    scene.camera.position = {0, 0, 20};
    scene.camera.look_at = {0, 0, 0};
    scene.camera.up = {0, 1, 0};
    scene.settings.samples = samples;
    scene.settings.wavelengths_nm = {589.3};
    return scene;
}

Stone stone_of(Solid solid, double index) {
    Stone stone;
    stone.solid = std::move(solid);
    stone.material.index[0].n = index;
    return stone;
}

struct Estimate {
    double mean = 0, error = 0;
};
// Over pixels that all show the same.
Estimate mean_of(const Scene& scene) {
    const RenderResult result = render(scene);
    double sum = 0, squares = 0;
    const double count = static_cast<double>(result.picture.pixels());
    for (std::size_t i = 0; i < result.picture.pixels(); ++i) {
        const auto v = static_cast<double>(result.picture.rgb[3 * i + 1]);
        sum += v;
        squares += v * v;
    }
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean) / count)};
}

// Means of each pixel over pictures with several seeds.
std::vector<Estimate> pixels_of(Scene scene, int seeds) {
    std::vector<double> sum, squares;
    for (int seed = 1; seed <= seeds; ++seed) {
        scene.settings.seed = static_cast<std::uint64_t>(seed);
        const RenderResult result = render(scene);
        sum.resize(result.picture.pixels());
        squares.resize(sum.size());
        for (std::size_t i = 0; i < sum.size(); ++i) {
            const auto v = static_cast<double>(result.picture.rgb[3 * i + 1]);
            sum[i] += v / seeds;
            squares[i] += v * v / seeds;
        }
    }
    std::vector<Estimate> pixels;
    for (std::size_t i = 0; i < sum.size(); ++i) {
        pixels.push_back(
            {sum[i], std::sqrt(std::max(0.0, squares[i] - sum[i] * sum[i]) / (seeds - 1.0))});
    }
    return pixels;
}

// Pixel by pixel, and on average, where the error is smaller by the root of their number.
void expect_same(const std::vector<Estimate>& a, const std::vector<Estimate>& b) {
    ASSERT_EQ(a.size(), b.size());
    double apart = 0, variance = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double error = std::hypot(a[i].error, b[i].error);
        // An error estimated from few seeds is uncertain itself: seven for the worst of many.
        EXPECT_NEAR(a[i].mean, b[i].mean, 7 * error + 1e-6) << i;
        apart += a[i].mean - b[i].mean;
        variance += error * error;
    }
    EXPECT_NEAR(apart, 0, 5 * std::sqrt(variance) + 1e-6 * static_cast<double>(a.size()));
}

// Conservation of energy: where the same light comes from everywhere and nothing absorbs,
// everything looks like that light.
TEST(ObjectScenes, VanishInAFurnace) {
    Scene scene = empty_scene(48, 64);
    scene.lights.constant = 1;
    std::mt19937_64 random(1);
    scene.stone = stone_of(random_stone(random, 30), 1.8);
    Stone second = stone_of(random_stone(random, 30), 2.4);
    for (Vec3& v : second.solid.vertices) v += Vec3{3, 0, 0};
    for (Facet& f : second.solid.facets) f.plane.offset += f.plane.normal.x * 3;
    scene.more_stones = {second};
    BoxShape box;
    box.center = {0, 3, 0};
    scene.objects = {
        {PlaneShape{{0, 0, -2}, {0, 0, 1}}, DiffuseMaterial{{1.0}}},
        {SphereShape{{-3, 0, 0}, 1}, MetalMaterial{{1.0}, {0.0}, SurfaceColour{1.0}, 0}},
        {SphereShape{{-3, 3, 0}, 1}, MetalMaterial{{1.0}, {0.0}, SurfaceColour{1.0}, 0.6}},
        {SphereShape{{3, 3, 0}, 1}, DielectricMaterial{1.5, {0.0}}},
        {SphereShape{{-3, -3, 0}, 1}, MirrorMaterial{{1.0}}},
        {SphereShape{{0, -3, 0}, 1}, DiffuseMaterial{{1.0}}},
        {box, DielectricMaterial{1.7, {0.0}}},
    };
    const Estimate furnace = mean_of(scene);
    EXPECT_NEAR(furnace.mean, 1, 1e-3);
    EXPECT_LT(furnace.error, 1e-3);
}

// Lambert: a cap of half angle a about the normal gives the irradiance pi L sin^2 a.
TEST(ObjectScenes, ADiffusePlaneUnderACap) {
    Scene scene = empty_scene(32, 16);
    scene.lights.sources = {DiscLight{{0, 0, 1}, 0, 0.3, {5.0}}};
    scene.objects = {{PlaneShape{}, DiffuseMaterial{{0.6}}}};
    const Estimate seen = mean_of(scene);
    EXPECT_NEAR(seen.mean, 0.6 * 5 * std::pow(std::sin(0.3), 2), 5 * seen.error);
    EXPECT_LT(seen.error, 0.01 * seen.mean);
}

// A sphere of radius r at distance d gives pi L (r/d)^2 cos, both as a light and as an emitter.
TEST(ObjectScenes, ADiffusePlaneUnderASphereThatShines) {
    const Vec3 center{3, 0, 4};
    const double wanted = 0.5 * 7 * std::pow(1.5 / 5, 2) * 4 / 5;
    for (const bool emitter : {false, true}) {
        Scene scene = empty_scene(32, 16);
        scene.camera.orthographic_width = 1e-3;
        scene.objects = {{PlaneShape{}, DiffuseMaterial{{0.5}}}};
        if (emitter) {
            scene.objects.push_back({SphereShape{center, 1.5}, EmitterMaterial{{7.0}}});
        } else {
            scene.lights.sources = {SphereLight{center, 1.5, {7.0}}};
        }
        const Estimate seen = mean_of(scene);
        EXPECT_NEAR(seen.mean, wanted, 5 * seen.error + 1e-3 * wanted);
        EXPECT_LT(seen.error, 0.01 * wanted);
    }
}

TEST(ObjectScenes, ThingsCastShadows) {
    Scene scene = empty_scene(8, 4);
    scene.camera.position = {0, -20, 20};
    scene.camera.orthographic_width = 0.1;
    scene.lights.sources = {DiscLight{{0, 0, 1}, 0, 0.01, {5.0}}};
    scene.objects = {{PlaneShape{}, DiffuseMaterial{{1.0}}},
                     {SphereShape{{0, 0, 3}, 1}, DiffuseMaterial{{0.0}}}};
    EXPECT_EQ(mean_of(scene).mean, 0);
    std::get<SphereShape>(scene.objects[1].shape).center.x = 3;
    EXPECT_GT(mean_of(scene).mean, 0);
}

// Polished surfaces polarise: in even light an analyser across the plane of incidence passes R_s /
// 2, along it R_p / 2 (Born & Wolf, 14.2).
TEST(ObjectScenes, AMetalPolarisesWhatItReflects) {
    const double n = 1.2, k = 7.26, angle = 1.2;
    Scene scene = empty_scene(2, 1);
    scene.camera.position = 20.0 * Vec3{0, -std::sin(angle), std::cos(angle)};
    scene.camera.up = {0, 0, 1};
    scene.camera.orthographic_width = 1e-6;
    scene.lights.constant = 1;
    scene.objects = {{PlaneShape{}, MetalMaterial{{n}, {k}, {}, 0}}};
    const std::complex<double> m(n, k), q = std::sqrt(m * m - std::pow(std::sin(angle), 2));
    const double cosine = std::cos(angle);
    const double R_s = std::norm((cosine - q) / (cosine + q)),
                 R_p = std::norm((m * m * cosine - q) / (m * m * cosine + q));
    EXPECT_NEAR(mean_of(scene).mean, 0.5 * (R_s + R_p), 1e-6);
    scene.camera.optics.analyzer = 0;
    EXPECT_NEAR(mean_of(scene).mean, 0.5 * R_s, 1e-6);
    scene.camera.optics.analyzer = std::acos(0.0);
    EXPECT_NEAR(mean_of(scene).mean, 0.5 * R_p, 1e-6);
    scene.camera.optics.analyzer = std::acos(0.0) / 2;
    EXPECT_NEAR(mean_of(scene).mean, 0.25 * (R_s + R_p), 1e-6);
}

// A plate of glass at normal incidence: (1 - R)^2 a / (1 - R^2 a^2), the sum of all its
// reflections.
TEST(ObjectScenes, APlateOfColouredGlass) {
    Scene scene = empty_scene(32, 64);
    scene.camera.orthographic_width = 0.1;
    scene.lights.sources = {HemisphereLight{{0, 0, -1}, {1.0}}};
    BoxShape plate;
    plate.half = {50, 50, 1};
    scene.objects = {{plate, DielectricMaterial{2.0, {0.4}}}};
    const double R = 1.0 / 9, a = std::exp(-0.8);
    const Estimate seen = mean_of(scene);
    EXPECT_NEAR(seen.mean, (1 - R) * (1 - R) * a / (1 - R * R * a * a), 5 * seen.error + 1e-6);
    EXPECT_LT(seen.error, 0.01);
}

Scene between_two_lights(int side, int samples) {
    Scene scene = empty_scene(side, samples);
    scene.camera.position = {3, -14, 9};
    scene.camera.up = {0, 0, 1};
    scene.camera.orthographic_width = 5;
    scene.lights.sources = {HemisphereLight{{0.6, 0, 0.8}, {1.0}},
                            CosinePowerLight{{0, -0.6, 0.8}, 3, {2.0}}};
    return scene;
}

// The same cube as a stone, by the tree of all its paths, and as an object, by random paths: two
// implementations. With an analyser, so that all four Stokes parameters matter.
TEST(ObjectScenes, ACubeOfGlassIsAStone) {
    std::vector<NamedPlane> planes;
    for (int axis = 0; axis < 3; ++axis) {
        for (int sign : {-1, 1}) {
            Vec3 n{0, 0, 0};
            n[axis] = sign;
            planes.push_back({"p", {n, 1}});
        }
    }
    BoxShape box;
    box.half = {1, 1, 1};
    for (const bool polarised : {false, true}) {
        Scene with_stone = between_two_lights(6, 64);
        if (polarised) {
            with_stone.camera.optics.analyzer = 0.4;
            with_stone.lights.sources.push_back(
                DiscLight{{0, 0, 1}, 0, 0.5, {3.0, LinearPolarisation{{1, 0, 0}, {}, 1}}});
        }
        Scene with_object = with_stone;
        with_stone.stone = stone_of(intersect_half_spaces(planes).solid, 1.6);
        with_stone.settings.tolerance = 0;
        with_stone.settings.depth = 60;
        with_object.objects = {{box, DielectricMaterial{1.6, {0.0}}}};
        expect_same(pixels_of(with_object, 12), pixels_of(with_stone, 2));
    }
}

// The picture does not depend on which of two stones is the scene's own, nor on an object that no
// ray meets.
TEST(ObjectScenes, StonesSeeEachOther) {
    std::mt19937_64 random(5);
    Stone a = stone_of(random_stone(random, 20), 1.7), b = stone_of(random_stone(random, 20), 2.2);
    for (Vec3& v : b.solid.vertices) v += Vec3{2.3, 0, 0};
    for (Facet& f : b.solid.facets) f.plane.offset += f.plane.normal.x * 2.3;
    Scene one = between_two_lights(6, 64), other = one;
    one.stone = a;
    one.more_stones = {b};
    other.stone = b;
    other.more_stones = {a};
    expect_same(pixels_of(one, 12), pixels_of(other, 12));
}

TEST(ObjectScenes, AThingOutOfSightChangesNothing) {
    std::mt19937_64 random(6);
    Scene alone = between_two_lights(6, 16);
    alone.stone = stone_of(random_stone(random, 20), 1.7);
    Scene has_objects = alone;
    // Behind the camera, in the dark half, as small as a grain.
    has_objects.objects = {{SphereShape{{30, -140, -90}, 1e-3}, DiffuseMaterial{}}};
    expect_same(pixels_of(has_objects, 12), pixels_of(alone, 2));
}

TEST(ObjectScenes, AreTheSameWhateverTheThreads) {
    std::mt19937_64 random(7);
    Scene scene = between_two_lights(40, 4);
    scene.stone = stone_of(random_stone(random, 20), 1.7);
    scene.objects = {{PlaneShape{{0, 0, -2}, {0, 0, 1}}, DiffuseMaterial{}},
                     {SphereShape{{3, 0, 0}, 1}, DielectricMaterial{}}};
    scene.settings.threads = 1;
    const RenderResult one = render(scene);
    scene.settings.threads = 2;
    EXPECT_EQ(render(scene).picture.rgb, one.picture.rgb);
    scene.settings.seed = 2;
    EXPECT_NE(render(scene).picture.rgb, one.picture.rgb);
}

TEST(ObjectScenes, AreRefusedByEnginesThatDoNotDrawThem) {
    Scene scene = between_two_lights(8, 1);
    std::mt19937_64 random(8);
    scene.stone = stone_of(random_stone(random, 20), 1.7);
    scene.objects = {{SphereShape{}, DiffuseMaterial{}}};
    scene.settings.engine = k_beam_engine;
    try {
        render(scene);
        FAIL() << "drawn";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("objects"), std::string::npos) << error.what();
    }
}

// A stone in glass would be drawn as in air.
TEST(ObjectScenes, RefuseStonesAndCamerasInsideGlass) {
    std::mt19937_64 random(9);
    Scene scene = between_two_lights(8, 1);
    scene.stone = stone_of(random_stone(random, 20), 1.7);
    scene.objects = {{SphereShape{{0, 0, 0}, 3}, DielectricMaterial{}}};
    EXPECT_THROW(render(scene), InputError);
    std::get<SphereShape>(scene.objects[0].shape).center = scene.camera.position;
    EXPECT_THROW(render(scene), InputError);
    std::get<SphereShape>(scene.objects[0].shape).center = {9, 0, 0};
    EXPECT_NO_THROW(render(scene));
}

// Through both arms of a U to a light behind them. A ray that leaves the first arm meets the black
// ball between the arms before the second arm.
TEST(ObjectScenes, ThingsStandBetweenAStoneAndItself) {
    Scene scene = empty_scene(16, 16);
    scene.stone = stone_of(carved::u_prism(), 1.5);
    scene.stone.convex = false;
    scene.camera.position = {-20, 2, 0.5};
    scene.camera.look_at = {0, 2, 0.5};
    scene.camera.up = {0, 0, 1};
    scene.camera.orthographic_width = 0.2;
    scene.lights.sources = {DiscLight{{1, 0, 0}, 0, 0.01, {1.0}}};
    // Far away and invisible, but it makes this a scene with objects.
    scene.objects = {{SphereShape{{0, 90, 0}, 1e-3}, DiffuseMaterial{{0.0}}}};
    // A pile of m plates of reflectance R per face transmits (1 - R) / (1 + (2 m - 1) R) (Stokes
    // 1862).
    const double R = 0.04;
    const Estimate open = mean_of(scene);
    EXPECT_NEAR(open.mean, (1 - R) / (1 + 3 * R), 5 * open.error + 1e-4);
    std::get<SphereShape>(scene.objects[0].shape) = {{1.5, 2, 0.5}, 0.45};
    EXPECT_EQ(mean_of(scene).mean, 0);
}

// A bound on indirect light reports what it removes: nothing where it is not reached.
TEST(ObjectScenes, ClampedLightIsAtMostTheBound) {
    Scene scene = empty_scene(16, 16);
    scene.camera.position = {0, -20, 20};
    scene.lights.constant = 1;
    scene.objects = {{PlaneShape{}, DiffuseMaterial{{0.5}}},
                     {SphereShape{{0, 0, 1}, 1}, DiffuseMaterial{{0.8}}}};
    const RenderResult whole = render(scene);
    scene.settings.clamp_indirect = 1;
    EXPECT_EQ(render(scene).picture.rgb, whole.picture.rgb);
    scene.settings.clamp_indirect = 0.1;
    EXPECT_NE(render(scene).picture.rgb, whole.picture.rgb);
}

// The work limit sets the number of rays, and the standard error falls with its square root. A ball
// on the ground, no stone, so that rays share no wavelengths.
TEST(ObjectScenes, MoreWorkAllowedIsLessNoise) {
    Scene scene = empty_scene(64, 0);
    scene.camera.position = {0, -20, 20};
    scene.lights.constant = 0.2;
    scene.lights.sources = {DiscLight{{0, 0, 1}, 0, 0.3, {4.0}}};
    scene.objects = {{PlaneShape{}, DiffuseMaterial{{0.5}}},
                     {SphereShape{{0, 0, 1}, 1}, DiffuseMaterial{{0.8}}}};
    scene.settings.tolerance = 1e-4;
    const auto drawn = [&](double ns, int threads) {
        scene.settings.allowed_ns = ns;
        scene.settings.threads = threads;
        return render(scene);
    };
    const RenderResult little = drawn(5e7, 1), much = drawn(8e8, 1);
    // A grid's side is an integer: slightly less than the limit.
    EXPECT_NEAR(much.stats.standard_error / little.stats.standard_error, 1.0 / 4, 0.08);
    EXPECT_EQ(drawn(8e8, 2).picture.rgb, much.picture.rgb);
    // As many rays as bring the noise to the tolerance, however many are allowed.
    scene.settings.tolerance = 0.02;
    const RenderResult enough = drawn(1e12, 1);
    EXPECT_LE(enough.stats.sampling_error / k_halves_over_noise, 1.25 * 0.02);
    EXPECT_GE(enough.stats.sampling_error / k_halves_over_noise, 0.5 * 0.02);
}

// Alpha is where objects are, if the film asks for it.
TEST(ObjectScenes, AlphaIsWhereThingsStand) {
    Scene scene = empty_scene(16, 4);
    scene.camera.orthographic_width = 4;
    scene.lights.constant = 1;
    scene.objects = {{SphereShape{{0, 0, 0}, 1}, DiffuseMaterial{}}};
    scene.film.alpha = true;
    const RenderResult result = render(scene);
    EXPECT_EQ(result.picture.coverage[0], 0);
    EXPECT_EQ(result.picture.coverage[8 * 16 + 8], 1);
}

}  // namespace
}  // namespace culet
