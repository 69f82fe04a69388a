// Expectations: the frames and conventions of docs/rendering.md, closed forms, and conservation in
// whole pictures.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/reference/light_field.h"
#include "render/reference/probe.h"
#include "render/render.h"
#include "render/scene/scene_io.h"
#include "stone/text/errors.h"
#include "tests/folder_test.h"

namespace {

using namespace culet;

Solid octahedron() {
    std::vector<NamedPlane> planes;
    int count = 0;
    for (double x : {-1, 1}) {
        for (double y : {-1, 1}) {
            for (double z : {-1, 1})
                planes.push_back(
                    {"f" + std::to_string(count++), {glm::normalize(Vec3{x, y, z}), 1}});
        }
    }
    planes.push_back({"T", {{0, 0, 1}, 0.8}});
    return intersect_half_spaces(planes).solid;
}

Scene scene_with(const std::string& material) {
    Scene scene;
    scene.stone.name = "test stone";
    scene.stone.solid = octahedron();
    scene.stone.material = catalogue_material(material);
    scene.stone.crystal.axes[0] = glm::normalize(Vec3{0.3, 0.1, 0.9});
    scene.camera.position = {3, 2, 12};
    scene.camera.fov = 0.35;
    scene.camera.width = 24;
    scene.camera.height = 20;
    scene.lights.constant = 1;
    scene.settings.samples = 4;
    scene.settings.depth = 6;
    scene.settings.tolerance = 0;
    return scene;
}

TEST(Camera, CentreLooksAtTheTargetAndYRunsDown) {
    Camera camera;
    camera.position = {0, 0, 10};
    camera.width = 200;
    camera.height = 100;
    camera.fov = std::numbers::pi / 2;
    const EyeRays eyes(camera);
    EXPECT_NEAR(glm::length(eyes.through(100, 50).direction - Vec3{0, 0, -1}), 0, 1e-15);
    // Vertical field of 90 degrees: the middle of the top edge looks up (camera up = +y) by 45.
    EXPECT_NEAR(glm::length(eyes.through(100, 0).direction - glm::normalize(Vec3{0, 1, -1})), 0,
                1e-15);
    EXPECT_GT(eyes.through(200, 50).direction.x, 0) << "right is +x when up is +y and the view -z";
    camera.orthographic_width = 8;
    EXPECT_NEAR(EyeRays(camera).through(200, 50).origin.x, 4, 1e-15);
    camera.orthographic_width.reset();
    camera.aperture_radius = 0.5;
    camera.focus_distance = 10;
    // All rays of a pixel meet in the plane of focus.
    const EyeRay ray = EyeRays(camera).through(150, 20, 0.6, -0.7),
                 chief = EyeRays(camera).through(150, 20);
    const Vec3 a = ray.origin - ray.origin.z / ray.direction.z * ray.direction;
    const Vec3 b = chief.origin - chief.origin.z / chief.direction.z * chief.direction;
    EXPECT_NEAR(glm::length(a - b), 0, 1e-13);
}

TEST(Environment, LatLongHasTheContractsFrame) {
    // 8 x 4 texels: red is the column, green the row.
    EnvironmentMap map;
    map.width = 8;
    map.height = 4;
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 8; ++x) map.rgb.insert(map.rgb.end(), {float(x), float(y), 0});
    }
    EXPECT_NEAR(map.at({0, 0, 1})[1], 0, 1e-12) << "top row is +z";
    EXPECT_NEAR(map.at({0, 0, -1})[1], 3, 1e-12);
    EXPECT_NEAR(map.at({1, 0, 0})[0], 3.5, 1e-12) << "+x is between the middle columns";
    // Azimuth 90 degrees (+y) is to the left: a quarter of the width.
    EXPECT_NEAR(map.at({0, 1, 0})[0], 1.5, 1e-12);
    EXPECT_NEAR(map.at({0, -1, 0})[0], 5.5, 1e-12);
    EXPECT_NEAR(map.at({-1, 1e-15, 0})[0], 3.5, 1e-9)
        << "wraps between the last and the first column";
}

TEST(Lights, EachKindShinesWhereItShould) {
    const WavelengthSet one({550});
    const auto seen = [&](const Lights& lights, const Vec3& origin, const Vec3& direction) {
        double radiance = 0;
        LightField(lights, one).add_radiance(origin, glm::normalize(direction), 1, 0, 1, &radiance);
        return radiance;
    };
    Lights lights;
    lights.sources.push_back(CosinePowerLight{{0, 0, 1}, 2, {3.0}});
    EXPECT_NEAR(seen(lights, {0, 0, 0}, {0, 1, 1}), 1.5, 1e-12);
    EXPECT_EQ(seen(lights, {0, 0, 0}, {0, 0, -1}), 0);
    lights = {};
    lights.sources.push_back(HemisphereLight{{0, 0, 1}, {2.0}});
    EXPECT_EQ(seen(lights, {0, 0, 0}, {1, 0, 0.01}), 2);
    EXPECT_EQ(seen(lights, {0, 0, 0}, {1, 0, -0.01}), 0);
    lights = {};
    lights.sources.push_back(DiscLight{{0, 0, 1}, radians(15), radians(45), {1.0}});
    EXPECT_EQ(seen(lights, {0, 0, 0}, {0, std::tan(radians(14.9)), 1}), 0);
    EXPECT_EQ(seen(lights, {0, 0, 0}, {0, std::tan(radians(15.1)), 1}), 1);
    EXPECT_EQ(seen(lights, {0, 0, 0}, {0, std::tan(radians(45.1)), 1}), 0);
    lights = {};
    lights.constant = 0.1;
    lights.sources.push_back(SphereLight{{0, 0, 10}, 1, {5.0}});
    EXPECT_EQ(seen(lights, {0, 0, 0}, {0, 0, 1}), 5) << "a near light hides what is behind it";
    EXPECT_EQ(seen(lights, {0, 0, 0}, {0, 0.2, 1}), 0.1);
    lights.sources.push_back(
        PlaneLight{{0, 0, 5}, {0, 0, -1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, {7.0}});
    EXPECT_EQ(seen(lights, {0, 0, 0}, {0, 0, 1}), 7) << "the nearest near light wins";
    EXPECT_EQ(seen(lights, {0, 0, 8}, {0, 0, -1}), 0.1) << "a plane is not there from behind";
    EXPECT_EQ(seen(lights, {1.5, 0, 0}, {0, 0, 1}), 0.1) << "beside its half-extent";
}

TEST(Render, ConstantLightOfOneGivesExactlyWhatPathsBringHome) {
    for (const char* material : {"diamond", "corundum", "calcite"}) {
        Scene scene = scene_with(material);
        scene.settings.wavelengths_nm = {550};  // the balance holds for one wavelength
        const RenderResult result = render(scene);
        for (std::size_t i = 0; i < result.picture.pixels(); ++i) {
            const float covered = result.picture.coverage[i];
            if (covered == 0) {
                EXPECT_EQ(result.picture.rgb[3 * i], 1.0f) << "background";
            }
        }
        EXPECT_NEAR(result.stats.mean_radiance + result.stats.remainder, 1, 1e-12) << material;
        scene.settings.depth = 0;
        scene.settings.tolerance = 0.01;
        scene.settings.engine = "reference";  // beams sum in single precision
        const RenderResult full = render(scene);
        EXPECT_NEAR(full.stats.mean_radiance + full.stats.remainder + full.stats.cut, 1, 1e-12)
            << material;
        EXPECT_GT(full.stats.mean_radiance, 0.9) << material;
    }
}

TEST(Render, SameBytesForAnyNumberOfThreads) {
    Scene scene = scene_with("corundum");
    scene.lights.constant = 0;
    scene.lights.sources.push_back(
        CosinePowerLight{glm::normalize(Vec3{1, 1, 1}), 3, {Rgb{1, 2, 0.5}}});
    scene.settings.depth = 0;
    scene.settings.tolerance = 0.02;
    scene.settings.threads = 1;
    const RenderResult one = render(scene);
    for (int threads : {2, 3}) {
        scene.settings.threads = threads;
        EXPECT_EQ(render(scene).picture.rgb, one.picture.rgb) << threads;
    }
}

TEST(Render, SplittingAtRandomAgreesWithFollowingBothWaves) {
    Scene scene = scene_with("calcite");
    scene.lights.constant = 0;
    scene.lights.sources.push_back(HemisphereLight{glm::normalize(Vec3{1, 0.3, 1}), {1.0}});
    scene.settings.wavelengths_nm = {589.3};
    scene.settings.depth = 7;
    const double exact = render(scene).stats.mean_radiance;
    scene.settings.tolerance = 1e-6;  // depth 7 prunes nothing, but weak paths choose one wave
    scene.settings.samples = 49;
    const double sampled = render(scene).stats.mean_radiance;
    scene.settings.tolerance = 0;
    const double exact_fine = render(scene).stats.mean_radiance;
    // The choice's scatter: under 2 % of paths are below the splitting weight, with 10^4 rays; plus
    // pixel sampling.
    EXPECT_NEAR(sampled, exact_fine, 2e-3);
    EXPECT_NEAR(exact, exact_fine, 2e-2);
}

TEST(Render, EffectsCanBeSwitchedOffAndSaySo) {
    Scene scene = scene_with("ruby_pale");
    const RenderResult on = render(scene);
    for (const EffectDecision& decision : on.stats.effects) {
        EXPECT_EQ(decision.on,
                  decision.effect != Effects::aperture && decision.effect != Effects::coherence)
            << name_of(decision.effect);
        EXPECT_FALSE(decision.why.empty());
    }
    scene.settings.effects_auto = false;
    scene.settings.effects.fill(false);
    const RenderResult off = render(scene);
    EXPECT_EQ(off.stats.absorbed, 0);
    EXPECT_GT(on.stats.absorbed, 0);
    Scene clear = scene_with("fluorite");
    for (const EffectDecision& decision : render(clear).stats.effects) {
        const bool on_expected =
            decision.effect == Effects::dispersion || decision.effect == Effects::polarization;
        EXPECT_EQ(decision.on, on_expected) << name_of(decision.effect);
    }
}

TEST(Render, ACrystalsTreeHasABudget) {
    // 2^40 paths would never end: beyond the budget one wave is followed, and the balance still
    // holds.
    Scene scene = scene_with("calcite");
    scene.settings.depth = 40;
    scene.settings.wavelengths_nm = {589.3};
    const ProbeResult result = probe(scene, {{3, 2, 12}, glm::normalize(Vec3{-3, -2, -12})});
    EXPECT_TRUE(result.sampled);
    double sum = result.remainder[0] + result.absorbed[0] + result.cut[0];
    for (const ProbedPath& path : result.paths) sum += path.weight[0];
    EXPECT_NEAR(sum, 1, 1e-11);
    EXPECT_THROW(
        probe(scene, {{3, 2, 12}, glm::normalize(Vec3{-3, -2, -12})}, [](double) { return false; }),
        Interrupted);
    EXPECT_THROW(probe(scene, {{0, 0, 0}, {0, 0, 1}}), InputError) << "starts inside";
}

TEST(Render, ARoughMeshIsDrawnByItsPlanesAndSaysSo) {
    Scene scene = scene_with("diamond");
    scene.stone.solid.vertices[0] *= 1.005;
    const RenderResult result = render(scene);
    ASSERT_EQ(result.stats.notes.size(), 1u);
    EXPECT_NE(result.stats.notes[0].find("planes"), std::string::npos);
    scene.stone.solid.vertices[0] *= 1.2;
    EXPECT_THROW(render(scene), InputError);
}

TEST(Render, StoppingThrowsAndReturnsNothing) {
    EXPECT_THROW(render(scene_with("diamond"), [](double) { return false; }), Interrupted);
}

TEST(Render, RefusesWhatItCannotDo) {
    Scene inside = scene_with("diamond");
    inside.camera.position = {0.1, 0, 0};
    EXPECT_THROW(render(inside), InputError);
    Scene open = scene_with("diamond");
    open.stone.solid.facets.pop_back();
    EXPECT_THROW(render(open), InputError);
}

TEST(Probe, WeightsAndLossesSumToOneAndAMissHasNoPaths) {
    for (const char* material : {"diamond", "emerald", "calcite"}) {
        Scene scene = scene_with(material);
        scene.settings.wavelengths_nm = {450, 650};
        const ProbeResult result = probe(scene, {{3, 2, 12}, glm::normalize(Vec3{-3, -2, -12})});
        ASSERT_TRUE(result.hit);
        for (std::size_t w = 0; w < 2; ++w) {
            double sum = result.remainder[w] + result.absorbed[w] + result.cut[w], leaves = 0;
            for (const ProbedPath& path : result.paths) leaves += path.weight[w];
            EXPECT_NEAR(sum + leaves, 1, 1e-12) << material;
            EXPECT_NEAR(result.radiance[w], leaves, 1e-12) << "constant light of 1";
        }
        const ProbeResult miss = probe(scene, {{3, 2, 12}, {0, 0, 1}});
        EXPECT_TRUE(miss.paths.empty());
        EXPECT_EQ(miss.radiance[0], 1);
    }
}

class SceneFiles : public test::FolderTest {
protected:
    void SetUp() override { write_solid(octahedron(), folder_ / "stone.obj"); }
    std::string message(const std::string& text) {
        std::ofstream(folder_ / "scene.toml") << text;
        try {
            read_scene(folder_ / "scene.toml");
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
};

TEST_F(SceneFiles, TheContractsKeysAreRead) {
    std::ofstream(folder_ / "scene.toml") << R"(
mesh = "stone.obj"
material = "diamond"
[camera]
position = [0, 0, 40]
fov = 20
size = [80, 60]
[light]
constant = 1.0
[[light.sphere]]
center = [0, 0, 50]
radius = 10
radiance = [1, 0.5, 0.25]
[[light.lobe]]
direction = [0, 0, 2]
exponent = 8
[[light.hemisphere]]
direction = [0, 0, 1]
[[light.cap]]
direction = [0, 0, 1]
half_angle = 0.27
radiance = "A"
[[light.plane]]
point = [0, 0, -30]
normal = [0, 0, 1]
radiance = 0.2
[render]
engine = "reference"
depth = 8
tolerance = 0
effects = ["dispersion", "polarization"]
wavelengths = [650, 450]
)";
    const Scene scene =
        read_scene(folder_ / "scene.toml", {"render.depth=5", "camera.size=[10,20]"});
    EXPECT_EQ(scene.settings.depth, 5);
    EXPECT_EQ(scene.camera.height, 20);
    EXPECT_EQ(scene.settings.wavelengths_nm, (std::vector<double>{450, 650}));
    EXPECT_EQ(count_lights<SphereLight>(scene.lights), 1u);
    EXPECT_EQ(nth_light<CosinePowerLight>(scene.lights, 0).direction, (Vec3{0, 0, 1}));
    EXPECT_TRUE(scene.settings.effects[0]);
    EXPECT_FALSE(scene.settings.effects[1]);
}

TEST_F(SceneFiles, EveryMistakeIsAnsweredWithItsLine) {
    const std::string head = "mesh = \"stone.obj\"\nmaterial = \"diamond\"\n";
    const std::vector<std::pair<std::string, std::string>> cases{
        {"material = \"diamond\"\n[light]\nconstant = 1\n", "mesh"},
        {"mesh = \"no.obj\"\nmaterial = \"diamond\"\n[light]\nconstant = 1\n", "no.obj"},
        {"mesh = \"stone.obj\"\nmaterial = \"dimond\"\n[light]\nconstant = 1\n", "diamond"},
        {head, "dark"},
        {head + "[light]\n", "dark"},
        {head + "[light]\nconstant = -1\n", ":4:"},
        {head + "[light]\nconstant = nan\n", ":4:"},
        {head + "[light]\nconstant = \"bright\"\n", ":4:"},
        {head + "[light]\nconstan = 1\n", "constant"},
        {head + "[light]\npreset = \"disco\"\n", "aset"},
        {head + "[light]\nenvironment = \"stone.obj\"\n", "stone.obj"},
        {head + "[camera]\nfov = 180\n[light]\nconstant = 1\n", ":4:"},
        {head + "[camera]\nsize = [0, 10]\n[light]\nconstant = 1\n", ":4:"},
        {head + "[camera]\nsize = [10]\n[light]\nconstant = 1\n", ":4:"},
        {head + "[camera]\nposition = [0, 0, 0]\n[light]\nconstant = 1\n", "own position"},
        {head + "[camera]\nup = [0, 0, 1]\n[light]\nconstant = 1\n", "up"},
        {head + "[camera]\naperture_radius = 1\n[light]\nconstant = 1\n", "focus_distance"},
        {head + "[light]\nconstant = 1\n[render]\ntolerance = 0\n", "depth"},
        {head + "[light]\nconstant = 1\n[render]\nengine = \"warp\"\n", "warp"},
        {head + "[light]\nconstant = 1\n[render]\neffects = [\"dispersoin\"]\n", "dispersion"},
        {head + "[light]\nconstant = 1\n[render]\nwavelengths = [0.589]\n", "nm"},
        {head + "[light]\nconstant = 1\n[render]\nwavelengths = [500, 500]\n", "twice"},
        {head + "[light]\nconstant = 1\n[[light.cap]]\ndirection = [0,0,0]\nhalf_angle = 1\n",
         ":6:"},
        {head + "[light]\nconstant = 1\n[[light.sphere]]\ncenter = [0,0,9]\nradius = 0\n",
         "positive"},
        {head + "[[object]]\nkind = \"sphere\"\n[light]\nconstant = 1\n", "shape is missing"},
        {"[broken\n", "TOML"},
    };
    for (const auto& [text, expected] : cases) {
        const std::string line = message(text);
        EXPECT_NE(line.find(expected), std::string::npos) << text << "\n-> " << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    }
}

}  // namespace
