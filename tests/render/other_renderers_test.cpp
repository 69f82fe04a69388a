// Scenes for Mitsuba 3 and PBRT-v4. Neither program is available here. Expectations: their
// documented conventions (Mitsuba's plugin reference; Pharr, Jakob & Humphreys 2023), by which this
// test reads the files, and the scene itself.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <regex>
#include <sstream>

#include "render/export/mitsuba.h"
#include "render/export/pbrt.h"
#include "stone/export/mean_material.h"
#include "stone/text/errors.h"
#include "tests/render/ray_stones.h"

namespace culet {
namespace {

constexpr double k_pi = std::numbers::pi;

Scene garnet() {
    Scene scene;
    std::mt19937_64 random(3);
    scene.stone.solid = random_stone(random, 20);
    scene.stone.material = catalogue_material("garnet_almandine");
    scene.camera.position = {4, 2, 7};
    scene.camera.look_at = {0.1, 0.2, -0.1};
    scene.camera.fov = 0.4;
    scene.camera.width = 120;
    scene.camera.height = 80;
    scene.lights.constant = 0.2;
    return scene;
}

std::vector<double> numbers_after(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    EXPECT_NE(at, std::string::npos) << words;
    if (at == std::string::npos) return {};
    std::string rest = text.substr(at + words.size(), 100000);
    for (char& c : rest) {
        if (c == ',') c = ' ';
    }
    std::istringstream in(rest);
    std::vector<double> numbers;
    for (double number = 0; in >> number;) numbers.push_back(number);
    return numbers;
}

Vec3 vector_at(const std::vector<double>& numbers, std::size_t i) {
    return {numbers.at(i), numbers.at(i + 1), numbers.at(i + 2)};
}

double volume_of(const std::vector<Vec3>& vertices,
                 const std::vector<std::array<int, 3>>& triangles) {
    double six = 0;
    for (const auto& t : triangles)
        six += glm::dot(vertices.at(std::size_t(t[0])),
                        glm::cross(vertices.at(std::size_t(t[1])), vertices.at(std::size_t(t[2]))));
    return six / 6;
}

// PBRT's Transform reverses x after LookAt, whose rows are up x direction, direction x that,
// direction. A pixel's place in the screen window is then a direction.
Vec3 pbrt_direction(const std::string& text, const Camera& camera, double x, double y) {
    const std::vector<double> look = numbers_after(text, "LookAt ");
    const Vec3 eye = vector_at(look, 0), at = vector_at(look, 3), up = vector_at(look, 6);
    const Vec3 forward = glm::normalize(at - eye);
    const Vec3 side = glm::normalize(glm::cross(glm::normalize(up), forward));
    const Vec3 above = glm::cross(forward, side);
    const std::vector<double> window = numbers_after(text, "\"float screenwindow\" [");
    const double screen_x = window[0] + (window[1] - window[0]) * x / camera.width;
    const double screen_y = window[3] - (window[3] - window[2]) * y / camera.height;
    return glm::normalize(forward - screen_x * side + screen_y * above);
}

// Mitsuba: the camera's x is up x direction, to the left, and the film's columns run against it.
// The film's middle is the line of sight, its height spans the angle `fov`, and the crop window is
// the picture.
Vec3 mitsuba_direction(const std::string& text, double x, double y) {
    const double fov = numbers_after(text, "\"fov\" value=\"").at(0) * k_pi / 180;
    const double film_width = numbers_after(text, "\"width\" value=\"").at(0),
                 film_height = numbers_after(text, "\"height\" value=\"").at(0);
    if (text.find("crop_offset_x") != std::string::npos) {
        x += numbers_after(text, "\"crop_offset_x\" value=\"").at(0);
        y += numbers_after(text, "\"crop_offset_y\" value=\"").at(0);
    }
    const Vec3 eye = vector_at(numbers_after(text, "lookat origin=\""), 0),
               at = vector_at(numbers_after(text, "target=\""), 0),
               up = vector_at(numbers_after(text, "up=\""), 0);
    const Vec3 forward = glm::normalize(at - eye);
    const Vec3 left = glm::normalize(glm::cross(up, forward));
    const double side = 2 * std::tan(fov / 2) / film_height;
    return glm::normalize(forward + side * (film_width / 2 - x) * left +
                          side * (film_height / 2 - y) * glm::cross(forward, left));
}

TEST(OtherRenderers, LookThroughTheSamePixels) {
    Scene scene = garnet();
    for (const bool shifted : {false, true}) {
        if (shifted) scene.camera.principal_point = {{31.5, 60}};
        const EyeRays rays(scene.camera);
        const std::string pbrt = pbrt_scene(scene, "s").text,
                          mitsuba = mitsuba_scene(scene, "s").text;
        for (const auto& [x, y] : {std::pair{0.5, 0.5}, {119.5, 0.5}, {17.0, 66.0}, {60.0, 40.0}}) {
            const Vec3 truth = rays.through(x, y).direction;
            EXPECT_LT(glm::length(pbrt_direction(pbrt, scene.camera, x, y) - truth), 1e-12);
            EXPECT_LT(glm::length(mitsuba_direction(mitsuba, x, y) - truth), 1e-12);
        }
    }
}

TEST(OtherRenderers, HaveTheStoneAsAClosedMeshSeenFromOutside) {
    const Scene scene = garnet();
    const ExportedScene mitsuba = mitsuba_scene(scene, "s");
    ASSERT_EQ(mitsuba.meshes.size(), 1u);
    EXPECT_NE(mitsuba.text.find(mitsuba.meshes[0].first), std::string::npos);
    std::vector<Vec3> vertices;
    std::vector<std::array<int, 3>> triangles;
    std::istringstream in(mitsuba.meshes[0].second);
    for (std::string word; in >> word;) {
        if (word == "v") {
            Vec3& v = vertices.emplace_back();
            in >> v.x >> v.y >> v.z;
        } else {
            std::array<int, 3>& t = triangles.emplace_back();
            in >> t[0] >> t[1] >> t[2];
            for (int& corner : t) --corner;
        }
    }
    EXPECT_NEAR(volume_of(vertices, triangles) / volume(scene.stone.solid), 1, 1e-12);

    const std::string pbrt = pbrt_scene(scene, "s").text;
    vertices.clear();
    triangles.clear();
    const std::vector<double> points = numbers_after(pbrt, "\"point3 P\" ["),
                              indices = numbers_after(pbrt, "\"integer indices\" [");
    for (std::size_t i = 0; i + 2 < points.size(); i += 3) vertices.push_back(vector_at(points, i));
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        triangles.push_back({int(indices[i]), int(indices[i + 1]), int(indices[i + 2])});
    EXPECT_NEAR(volume_of(vertices, triangles) / volume(scene.stone.solid), 1, 1e-12);
}

TEST(OtherRenderers, HaveIndexAndAbsorptionOfTheMaterial) {
    Scene scene = garnet();
    scene.stone.unit = LengthUnit::cm;
    scene.immersion = 1.33;
    const std::string pbrt = pbrt_scene(scene, "s").text;
    const std::vector<double> eta = numbers_after(pbrt, "\"spectrum eta\" ["),
                              sigma = numbers_after(pbrt, "\"spectrum sigma_a\" [");
    ASSERT_EQ(eta.size(), 2u * 48);  // 360 to 830 nm
    int seen = 0;
    for (std::size_t i = 0; i < eta.size(); i += 2) {
        if (eta[i] < 380 || eta[i] > 780) continue;
        ++seen;
        EXPECT_NEAR(eta[i + 1], mean_index(scene.stone.material, eta[i]) / 1.33, 1e-12);
        EXPECT_NEAR(sigma.at(i + 1), 10 * mean_absorption(scene.stone.material, eta[i]), 1e-12);
    }
    EXPECT_EQ(seen, 41);
    const std::string mitsuba = mitsuba_scene(scene, "s").text;
    EXPECT_NEAR(numbers_after(mitsuba, "\"int_ior\" value=\"").at(0),
                mean_index(scene.stone.material, 589.3), 1e-12);
    EXPECT_EQ(numbers_after(mitsuba, "\"ext_ior\" value=\"").at(0), 1.33);
    const double scale = numbers_after(mitsuba, "\"scale\" value=\"").at(0);
    const std::vector<double> rgb = numbers_after(mitsuba, "\"sigma_t\" value=\"");
    constexpr double k_rgb_nm[]{610, 545, 465};
    for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_LE(rgb.at(c), 1);
        EXPECT_NEAR(scale * rgb.at(c), 10 * mean_absorption(scene.stone.material, k_rgb_nm[c]),
                    1e-12);
    }
}

// Equal areas: the mean of 1, x, x^2, xy, ... over the square equals that over the sphere. The
// midpoint rule with 256 x 256 points has an error of about the square of their distance.
TEST(OtherRenderers, SquareMapOfPbrtHasEqualAreas) {
    constexpr int n = 256;
    Vec3 mean(0), squares(0);
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const Vec3 d = equal_area_direction((x + 0.5) / n, (y + 0.5) / n);
            EXPECT_NEAR(glm::length(d), 1, 1e-12);
            mean += d / double(n * n);
            squares += d * d / double(n * n);
        }
    }
    EXPECT_LT(glm::length(mean), 1e-12);
    for (const double square : {squares.x, squares.y, squares.z})
        EXPECT_NEAR(square, 1.0 / 3, 10.0 / (n * n));
    // The middle is +z, corners are -z, the middles of the sides +x and +y.
    EXPECT_LT(glm::length(equal_area_direction(0.5, 0.5) - Vec3(0, 0, 1)), 1e-12);
    EXPECT_LT(glm::length(equal_area_direction(1, 1) - Vec3(0, 0, -1)), 1e-12);
    EXPECT_LT(glm::length(equal_area_direction(1, 0.5) - Vec3(1, 0, 0)), 1e-12);
    EXPECT_LT(glm::length(equal_area_direction(0.5, 1) - Vec3(0, 1, 0)), 1e-12);
}

// A cap of half angle a has the solid angle 2 pi (1 - cos a). Texels on its rim are sampled 4 x 4
// times: off by a twentieth of the texels there.
TEST(OtherRenderers, MapsHaveTheLightWhereItComesFrom) {
    Scene scene = garnet();
    const double a = radians(10);
    const Vec3 towards = glm::normalize(Vec3{0.3, -0.8, 0.4});
    scene.lights.constant = 0;
    scene.lights.sources.push_back(DiscLight{towards, 0, a, {3.0}});
    const double truth = 3 * 2 * k_pi * (1 - std::cos(a));

    const ExportedScene pbrt = pbrt_scene(scene, "s");
    ASSERT_TRUE(pbrt.environment);
    const Picture& square = pbrt.environment->second;
    double sum = 0;
    Vec3 middle(0);
    for (int y = 0; y < square.height; ++y) {
        for (int x = 0; x < square.width; ++x) {
            const double light = double(square.at(x, y)[0]);
            sum += light;
            middle +=
                light * equal_area_direction((x + 0.5) / square.width, (y + 0.5) / square.height);
        }
    }
    EXPECT_NEAR(sum * 4 * k_pi / double(square.pixels()) / truth, 1, 2e-3);
    EXPECT_LT(angle_between(middle, towards), radians(0.05));

    const ExportedScene mitsuba = mitsuba_scene(scene, "s");
    ASSERT_TRUE(mitsuba.environment);
    const Picture& map = mitsuba.environment->second;
    // Mitsuba's frame, then the file's matrix.
    const std::vector<double> m = numbers_after(mitsuba.text, "<matrix value=\"");
    double energy = 0;
    middle = Vec3(0);
    for (int y = 0; y < map.height; ++y) {
        const double theta = k_pi * (y + 0.5) / map.height;
        for (int x = 0; x < map.width; ++x) {
            const double phi = 2 * k_pi * (x + 0.5) / map.width;
            const Vec3 d{std::sin(phi) * std::sin(theta), std::cos(theta),
                         -std::cos(phi) * std::sin(theta)};
            const Vec3 world{m[0] * d.x + m[1] * d.y + m[2] * d.z,
                             m[4] * d.x + m[5] * d.y + m[6] * d.z,
                             m[8] * d.x + m[9] * d.y + m[10] * d.z};
            const double light = double(map.at(x, y)[0]) * std::sin(theta);
            energy += light;
            middle += light * world;
        }
    }
    EXPECT_NEAR(energy * 2 * k_pi * k_pi / double(map.pixels()) / truth, 1, 2e-3);
    EXPECT_LT(angle_between(middle, towards), radians(0.05));
}

// Every opened tag is closed by its own name, and comments contain no tag.
void expect_well_formed(const std::string& xml) {
    const std::regex tag(R"(<(!--|[?]?/?)([a-z]*)((?:[^<>"]|"[^"<>]*")*)>)");
    std::vector<std::string> open;
    std::size_t covered = 0;
    for (std::sregex_iterator i(xml.begin(), xml.end(), tag), end; i != end; ++i) {
        ++covered;
        const std::string kind = (*i)[1], name = (*i)[2], rest = (*i)[3];
        if (kind == "!--" || kind == "?") continue;
        if (kind == "/") {
            ASSERT_FALSE(open.empty()) << name;
            EXPECT_EQ(open.back(), name);
            open.pop_back();
        } else if (rest.empty() || rest.back() != '/') {
            open.push_back(name);
        }
    }
    EXPECT_TRUE(open.empty());
    EXPECT_EQ(covered, std::size_t(std::count(xml.begin(), xml.end(), '<')));
}

TEST(OtherRenderers, KnowEveryObjectAndLight) {
    Scene scene = garnet();
    scene.lights.sources = {SphereLight{{9, 0, 9}, 1, {2.0}},
                            PlaneLight{{0, 0, 20}, {0, 0, -1}, {}, {}, {1.0}},
                            PlaneLight{{0, 9, 0}, {0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}, {1.0}},
                            HemisphereLight{{0, 0, 1}, {0.5}}};
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh->triangles = {{0, 1, 2}};
    scene.objects = {{SphereShape{{5, 5, 0}, 1}, DiffuseMaterial{}},
                     {PlaneShape{{0, 0, -3}, {0, 0, 1}}, MirrorMaterial{}},
                     {DiscShape{{-5, 0, 0}, {1, 0, 0}, 2}, MetalMaterial{}},
                     {BoxShape{}, DielectricMaterial{1.5, {0.2}}},
                     {MeshShape{mesh}, EmitterMaterial{}}};
    const ExportedScene mitsuba = mitsuba_scene(scene, "s"), pbrt = pbrt_scene(scene, "s");
    expect_well_formed(mitsuba.text);
    const auto count = [](const std::string& text, const std::string& what) {
        int found = 0;
        for (std::size_t at = text.find(what); at != std::string::npos;
             at = text.find(what, at + 1))
            ++found;
        return found;
    };
    // The stone, three near lights, five objects.
    EXPECT_EQ(count(mitsuba.text, "<shape "), 9);
    EXPECT_EQ(count(mitsuba.text, "<emitter type=\"area\">"), 4);
    EXPECT_EQ(count(mitsuba.text, "<emitter type=\"envmap\">"), 1);
    EXPECT_EQ(count(pbrt.text, "\nAttributeBegin"), 9);
    EXPECT_EQ(count(pbrt.text, "AttributeEnd"), 9);
    EXPECT_EQ(count(pbrt.text, "AreaLightSource"), 4);
    EXPECT_EQ(count(pbrt.text, "LightSource \"infinite\""), 1);
    // The box, whose interior absorbs light.
    EXPECT_EQ(count(pbrt.text, "MakeNamedMedium"), 2);
}

TEST(OtherRenderers, SayWhatTheyDoNotCarryAndRefuseInstruments) {
    Scene scene = garnet();
    scene.stone.material = catalogue_material("quartz");
    scene.camera.aperture_radius = 0.1;
    scene.camera.focus_distance = 8;
    for (const ExportedScene& written : {mitsuba_scene(scene, "s"), pbrt_scene(scene, "s")}) {
        std::string all;
        for (const std::string& note : written.notes) {
            all += note + "\n";
            EXPECT_NE(written.text.find(note), std::string::npos) << note;
        }
        for (const char* word : {"polarisation", "lens", "double refraction"})
            EXPECT_NE(all.find(word), std::string::npos) << word;
    }
    scene.camera.cone = 0.3;
    EXPECT_THROW(mitsuba_scene(scene, "s"), InputError);
    EXPECT_THROW(pbrt_scene(scene, "s"), InputError);
}

TEST(OtherRenderers, NamesBesideTheSceneArePlain) {
    Scene scene = garnet();
    scene.lights.sources.push_back(HemisphereLight{{0, 0, 1}, {1.0}});
    const ExportedScene mitsuba = mitsuba_scene(scene, "a \"<&> b");
    EXPECT_EQ(mitsuba.environment->first, "a______b-mitsuba-light.exr");
    expect_well_formed(mitsuba.text);
    EXPECT_EQ(pbrt_scene(scene, "a \"[]").environment->first, "a____-pbrt-light.exr");
}

}  // namespace
}  // namespace culet
