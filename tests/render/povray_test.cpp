// Expectations: the scene's contents, closed meshes, and, where POV-Ray 3.7 is installed, its own
// pictures of the same scenes.

#include "render/export/povray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>
#include <map>
#include <regex>
#include <sstream>

#include "render/image/image_io.h"
#include "render/render.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/folder_test.h"
#include "tests/render/ray_stones.h"

namespace {

using namespace culet;
namespace fs = std::filesystem;

Scene stone_scene() {
    Scene scene;
    std::mt19937_64 random(71);
    scene.stone.solid = random_stone(random, 30);
    scene.stone.material.index[0].n = 1.9;
    scene.camera.position = {4, 2, 7};
    scene.camera.fov = 0.36;
    scene.camera.width = scene.camera.height = 64;
    scene.lights.constant = 0.3;
    scene.settings.depth = 5;
    scene.settings.tolerance = 0;
    scene.settings.samples = 1;
    scene.settings.effects_auto = false;
    scene.settings.effects.fill(false);
    return scene;
}

// An L-shaped prism: 6 sides, two ends of 6 corners one of which points inwards.
Solid corner_bracket() {
    const double outline[6][2] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
    Solid solid;
    for (double z : {-0.5, 0.5}) {
        for (const auto& p : outline) solid.vertices.push_back({p[0], p[1], z});
    }
    // The inward corner is the first of the one end and the fourth of the other.
    solid.facets.push_back({"top", {}, {9, 10, 11, 6, 7, 8}});
    solid.facets.push_back({"bottom", {}, {5, 4, 3, 2, 1, 0}});
    for (int i = 0; i < 6; ++i) {
        const int next = (i + 1) % 6;
        solid.facets.push_back({"side", {}, {i, next, next + 6, i + 6}});
    }
    for (Facet& facet : solid.facets) {
        std::vector<Vec3> loop;
        for (int corner : facet.corners) loop.push_back(solid.vertices[corner]);
        facet.plane = plane_through(loop);
    }
    return solid;
}

struct WrittenMesh {
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> triangles;
};

// The last mesh2 of a text, which is the stone's.
WrittenMesh mesh_of(const std::string& text) {
    std::string mesh = text.substr(text.rfind("mesh2"));
    mesh = mesh.substr(0, mesh.find("pigment"));
    const std::size_t faces = mesh.find("face_indices");
    const std::regex triple("<([^,>]+), ([^,>]+), ([^,>]+)>");
    WrittenMesh result;
    for (std::sregex_iterator it(mesh.begin(), mesh.end(), triple), end; it != end; ++it) {
        const std::array<double, 3> v{std::stod((*it)[1]), std::stod((*it)[2]),
                                      std::stod((*it)[3])};
        if (static_cast<std::size_t>(it->position()) < faces) {
            result.vertices.push_back({v[0], v[1], v[2]});
        } else {
            result.triangles.push_back(
                {static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])});
        }
    }
    return result;
}

void expect_same_solid(const Solid& solid, const std::string& text) {
    const WrittenMesh mesh = mesh_of(text);
    ASSERT_EQ(mesh.vertices.size(), solid.vertices.size());
    // y and z exchanged, and a scale that is a power of two.
    const double scale = glm::length(mesh.vertices[0]) / glm::length(solid.vertices[0]);
    EXPECT_EQ(std::exp2(std::round(std::log2(scale))), std::round(scale * 1e6) / 1e6);
    std::map<std::pair<int, int>, int> edges;
    double six_volumes = 0, twice_area = 0;
    for (const auto& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
        const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
        six_volumes += glm::dot(a, glm::cross(b, c));
        twice_area += glm::length(glm::cross(b - a, c - a));
    }
    // Closed: every edge once each way.
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
    // Mirrored, so inside out. No triangle is outside its facet: the area is no more than the
    // facets'.
    double whole = 0;
    for (const Facet& facet : solid.facets) whole += area(solid, facet);
    EXPECT_NEAR(six_volumes / (6 * std::pow(scale, 3)), -volume(solid), 1e-9 * volume(solid));
    EXPECT_NEAR(0.5 * twice_area / (scale * scale), whole, 1e-9 * whole);
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}
bool noted(const ExportedScene& scene, const std::string& part) {
    return std::any_of(scene.notes.begin(), scene.notes.end(),
                       [&](const std::string& note) { return holds(note, part); });
}

TEST(Povray, MeshesAreTheStoneAndClosed) {
    const Scene scene = stone_scene();
    const ExportedScene written = povray_scene(scene);
    expect_same_solid(scene.stone.solid, written.text);
    EXPECT_TRUE(written.notes.empty()) << written.notes.front();
}

TEST(Povray, FacetsWithInwardCornersAreCutIntoTrianglesInsideThem) {
    Scene scene = stone_scene();
    scene.stone.solid = corner_bracket();
    scene.stone.convex = false;
    expect_same_solid(scene.stone.solid, povray_scene(scene).text);
}

TEST(Povray, CornersOffTheirPlanesAreWrittenAsThePlanesMeet) {
    Scene scene = stone_scene();
    const Solid exact = scene.stone.solid;
    scene.stone.solid.vertices[0] += Vec3{1e-3, -2e-3, 1e-3};
    const WrittenMesh mesh = mesh_of(povray_scene(scene).text);
    ASSERT_EQ(mesh.vertices.size(), exact.vertices.size());
    const double scale = std::exp2(std::ceil(std::log2(1024 / diameter(scene.stone.solid))));
    for (const Vec3& vertex : exact.vertices) {
        double nearest = 1;
        for (const Vec3& v : mesh.vertices)
            nearest = std::min(nearest, glm::length(Vec3{v.x, v.z, v.y} / scale - vertex));
        EXPECT_LT(nearest, 1e-9);
    }
}

TEST(Povray, LevelIsOneMoreThanTheDepthAndIndexIsRelative) {
    Scene scene = stone_scene();
    for (int depth : {1, 2, 9, 255}) {
        scene.settings.depth = depth;
        EXPECT_TRUE(
            holds(povray_scene(scene).text, "max_trace_level " + std::to_string(depth + 1) + " "));
    }
    EXPECT_FALSE(noted(povray_scene(scene), "deeper"));
    scene.settings.depth = 256;
    EXPECT_TRUE(noted(povray_scene(scene), "deeper than 255"));
    scene.settings.depth = 0;
    scene.settings.tolerance = 0.01;
    EXPECT_TRUE(noted(povray_scene(scene), "tolerance"));
    EXPECT_TRUE(holds(povray_scene(scene).text, "ior 1.9 "));
    scene.immersion = 1.25;
    EXPECT_TRUE(holds(povray_scene(scene).text, "ior 1.52 "));
}

TEST(Povray, SaysWhatItLeavesOut) {
    Scene scene = stone_scene();
    scene.settings.effects_auto = true;
    EXPECT_TRUE(noted(povray_scene(scene), "polarisation"));
    scene.camera.aperture_radius = 0.1;
    scene.camera.focus_distance = 8;
    EXPECT_TRUE(noted(povray_scene(scene), "lens"));
    scene.stone.material = catalogue_material("quartz");
    EXPECT_TRUE(noted(povray_scene(scene), "double refraction"));
    EXPECT_TRUE(noted(povray_scene(scene), "dispersion"));
    scene.lights.sources.push_back(DiscLight{{0, 0, 1}, 0, 1, {std::string("A")}});
    EXPECT_TRUE(noted(povray_scene(scene), "illuminant A"));
    // Every note is also in the file.
    const ExportedScene written = povray_scene(scene);
    for (const std::string& note : written.notes) EXPECT_TRUE(holds(written.text, note)) << note;
}

TEST(Povray, RefusesWhatHasNoPictureThere) {
    const Scene good = stone_scene();
    Scene scene = good;
    scene.camera.cone = 0.3;
    EXPECT_THROW(povray_scene(scene), InputError);
    scene = good;
    scene.camera.optics.analyzer = 0.5;
    EXPECT_THROW(povray_scene(scene), InputError);
    scene = good;
    scene.camera.optics.two_windows = true;
    EXPECT_THROW(povray_scene(scene), InputError);
    scene = good;
    scene.lights.polarisation = LinearPolarisation{};
    EXPECT_THROW(povray_scene(scene), InputError);
    scene = good;
    scene.lights.environment = std::make_shared<EnvironmentMap>();
    EXPECT_THROW(povray_scene(scene), InputError);
    scene = good;
    scene.stone.solid.facets.pop_back();
    EXPECT_THROW(povray_scene(scene), InputError);
    scene = good;
    scene.camera.position = {0, 0, 0.1};
    EXPECT_THROW(povray_scene(scene), InputError);
}

TEST(Povray, PlaneLightsAreLeftOutBehindAndClearFromBehind) {
    Scene scene = stone_scene();
    scene.lights.sources.push_back(PlaneLight{{0, 0, 20}, {0, 0, 1}, {}, {}, {1.0}});
    EXPECT_TRUE(holds(povray_scene(scene).text, "not there"));
    nth_light<PlaneLight>(scene.lights, 0) = {{0, 0, 20}, {0, 0, -1}, {}, {}, {1.0}};
    EXPECT_FALSE(holds(povray_scene(scene).text, "interior_texture"));
    EXPECT_FALSE(noted(povray_scene(scene), "back"));
    // Between camera and stone, facing the one and then the other.
    nth_light<PlaneLight>(scene.lights, 0) = {{0, 0, 3}, {0, 0, -1}, {}, {}, {1.0}};
    EXPECT_THROW(povray_scene(scene), InputError);
    nth_light<PlaneLight>(scene.lights, 0) = {{0, 0, 3}, {0, 0, 1}, {}, {}, {1.0}};
    EXPECT_TRUE(holds(povray_scene(scene).text, "interior_texture"));
    EXPECT_TRUE(noted(povray_scene(scene), "back"));
}

// Root mean square difference in linear radiance from POV-Ray's picture.
class PovrayPictures : public test::FolderTest {
protected:
    void SetUp() override {
        if (std::system("povray --version >/dev/null 2>&1") != 0)
            GTEST_SKIP() << "povray is not installed: its pictures are not compared";
    }
    double rmse(const Scene& scene) const {
        const fs::path in = folder_ / "scene.pov", out = folder_ / "picture.png";
        write_text(in, povray_scene(scene).text);
        std::ostringstream command;
        command << "povray '+I" << in.string() << "' '+O" << out.string() << "' +W"
                << scene.camera.width << " +H" << scene.camera.height
                << " -A -D -V +WT1 +FN16 File_Gamma=sRGB >'" << (folder_ / "said.txt").string()
                << "' 2>&1";
        if (std::system(command.str().c_str()) != 0) {
            ADD_FAILURE() << read_text(folder_ / "said.txt");
            return 1;
        }
        const Picture theirs = read_picture(out).picture, ours = render(scene).picture;
        double squares = 0;
        for (std::size_t i = 0; i < ours.rgb.size(); ++i)
            squares += std::pow(static_cast<double>(ours.rgb[i]) - theirs.rgb[i], 2);
        return std::sqrt(squares / static_cast<double>(ours.rgb.size()));
    }
};

// 16-bit sRGB is good to 2e-5. A pixel or two on an edge, where POV-Ray's single precision takes
// the other side, stay below this.
constexpr double k_same_picture = 1e-3;

TEST_F(PovrayPictures, ColouredDistantLights) {
    Scene scene = stone_scene();
    scene.lights.constant = 0.05;
    scene.lights.sources.push_back(
        HemisphereLight{glm::normalize(Vec3{0.2, 0.1, 1}), {Rgb{0.3, 0.2, 0.1}}});
    scene.lights.sources.push_back(
        CosinePowerLight{glm::normalize(Vec3{-1, 0.5, 0.3}), 2.5, {Rgb{0.1, 0.3, 0.5}}});
    scene.lights.sources.push_back(DiscLight{{0, 0, 1}, 0.2, 0.9, {Rgb{0.5, 0.1, 0.3}}});
    scene.lights.sources.push_back(DiscLight{{1, 0, 0}, 0, 0.5, {0.1}});
    EXPECT_LT(rmse(scene), k_same_picture);
}

TEST_F(PovrayPictures, AbsorptionInADomeWithNearLights) {
    Scene scene = stone_scene();
    scene.settings.effects[static_cast<std::size_t>(Effects::absorption)] = true;
    scene.stone.material.absorption_per_mm[0] = Spectrum(0.35);
    scene.camera.orthographic_width = 3.4;
    scene.camera.width = 80;
    scene.lights.sources.push_back(SphereLight{{0, 0, 0}, 40, {0.4}});
    scene.lights.sources.push_back(SphereLight{{-6, 5, 3}, 2.5, {1.0}});
    scene.lights.sources.push_back(PlaneLight{{0, 0, -5}, {0, 0, 1}, {}, {}, {0.2}});
    scene.lights.sources.push_back(PlaneLight{{8, 1, 9},
                                              glm::normalize(Vec3{-8, -1, -9}),
                                              glm::normalize(Vec3{1, -8, 0}) * 3.0,
                                              glm::normalize(Vec3{72, 9, -65}) * 2.0,
                                              {0.9}});
    EXPECT_LT(rmse(scene), k_same_picture);
}

// Mirrors and emitters: these scenes contain nothing random.
TEST_F(PovrayPictures, MirrorsAndThingsThatShine) {
    Scene scene;
    scene.camera.position = {1, -9, 5};
    scene.camera.up = {0, 0, 1};
    scene.camera.fov = 0.7;
    scene.camera.width = 96;
    scene.camera.height = 72;
    scene.settings = stone_scene().settings;
    scene.settings.depth = 60;
    scene.lights.constant = 0.1;
    scene.lights.sources = {HemisphereLight{glm::normalize(Vec3{0.2, 0.1, 1}), {0.3}},
                            CosinePowerLight{glm::normalize(Vec3{0.5, -0.5, 0.7}), 4, {0.4}}};
    BoxShape box;
    box.center = {0.2, 2, 0.2};
    box.half = {0.6, 0.9, 1.2};
    box.axes[0] = glm::normalize(Vec3{1, 0.5, 0.3});
    box.axes[1] = glm::normalize(glm::cross(Vec3{0, 0, 1}, box.axes[0]));
    box.axes[2] = glm::cross(box.axes[0], box.axes[1]);
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->vertices = {{-1, -1.5, 0.5}, {1, -1.5, 0}, {0, -1, 1.5}, {0, -0.2, 0.3}};
    mesh->triangles = {{0, 1, 2}, {1, 3, 2}, {3, 0, 2}, {0, 3, 1}};
    scene.objects = {
        {PlaneShape{{0, 0, -1}, {0, 0, 1}}, MirrorMaterial{{0.9}}},
        {SphereShape{{-2.4, 0, 0}, 1}, MirrorMaterial{{1.0}}},
        {box, EmitterMaterial{{Rgb{0.6, 0.5, 0.2}}}},
        {DiscShape{{2.5, 2, 1}, glm::normalize(Vec3{-0.3, -1, 0.2}), 0.9}, EmitterMaterial{{0.8}}},
        {MeshShape{mesh}, EmitterMaterial{{Rgb{0.2, 0.5, 0.7}}}}};
    EXPECT_LT(rmse(scene), k_same_picture);
    scene.objects[1].material = DiffuseMaterial{};
    EXPECT_TRUE(noted(povray_scene(scene), "light_source"));
}

}  // namespace
