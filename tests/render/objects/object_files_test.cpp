// `[[object]]` and `[[stone]]` of scene files, and the meshes that they name.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "render/scene/fingerprint.h"
#include "render/scene/scene_io.h"
#include "render/scene/turntable.h"
#include "stone/text/errors.h"
#include "tests/folder_test.h"

namespace culet {
namespace {

const std::string k_camera_and_light =
    "[camera]\nposition = [0, -9, 5]\nlook_at = [0, 0, 0]\n[light]\nconstant = 1\n";

class ObjectFiles : public test::FolderTest {
protected:
    Scene read(const std::string& text) const {
        write("scene.toml", k_camera_and_light + text);
        return read_scene(folder_ / "scene.toml");
    }
    // The message of the InputError; empty if there is none.
    std::string refusal(const std::string& text) const {
        try {
            read(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }
};

TEST_F(ObjectFiles, ShapesAndMaterials) {
    const Scene scene = read(
        "[[object]]\nshape = \"sphere\"\ncenter = [1, 2, 3]\nradius = 2\n"
        "material = { kind = \"metal\", f0 = [1, 0.7, 0.3], roughness = 0.2 }\n"
        "[[object]]\nshape = \"plane\"\nnormal = [0, 0, 2]\nmaterial = { kind = \"diffuse\" }\n"
        "[[object]]\nshape = \"disc\"\nradius = 3\nmaterial = { kind = \"emitter\", radiance = 5 "
        "}\n"
        "[[object]]\nshape = \"box\"\nsize = [1, 2, 3]\n"
        "transform = { scale = 2, rotate = [0, 0, 90], translate = [1, 0, 0] }\n"
        "material = { kind = \"dielectric\", index = 1.7, absorption = [0.1, 0.2, 0.3] }\n");
    ASSERT_EQ(scene.objects.size(), 4u);
    EXPECT_FALSE(scene.has_stone());
    const auto& metal = std::get<MetalMaterial>(scene.objects[0].material);
    EXPECT_EQ(std::get<Rgb>(metal.f0->value), (Rgb{1, 0.7, 0.3}));
    EXPECT_EQ(std::get<PlaneShape>(scene.objects[1].shape).normal, Vec3(0, 0, 1));
    const auto& box = std::get<BoxShape>(scene.objects[3].shape);
    EXPECT_EQ(box.half, Vec3(1, 2, 3));
    EXPECT_NEAR(glm::length(box.axes[0] - Vec3(0, 1, 0)), 0, 1e-15);
    EXPECT_EQ(box.center, Vec3(1, 0, 0));
}

TEST_F(ObjectFiles, TransformsAreStepsOrMatrices) {
    const auto placed = [&](const std::string& transform) {
        return std::get<SphereShape>(read("[[object]]\nshape = \"sphere\"\ncenter = [1, 0, 0]\n"
                                          "radius = 1\nmaterial = { kind = \"diffuse\" }\n"
                                          "transform = " +
                                          transform + "\n")
                                         .objects[0]
                                         .shape);
    };
    const SphereShape steps = placed("{ scale = 2, rotate = [0, 0, 90], translate = [5, 0, 1] }");
    const SphereShape matrix = placed("[0, -2, 0, 5,  2, 0, 0, 0,  0, 0, 2, 1]");
    EXPECT_NEAR(glm::length(steps.center - Vec3(5, 2, 1)), 0, 1e-14);
    EXPECT_NEAR(glm::length(matrix.center - steps.center), 0, 1e-14);
    EXPECT_NEAR(steps.radius, 2, 1e-14);
    EXPECT_NEAR(matrix.radius, 2, 1e-14);
}

TEST_F(ObjectFiles, WhatIsWrongIsSaidWithItsLine) {
    const std::string sphere = "[[object]]\nshape = \"sphere\"\nradius = 1\n";
    const std::string diffuse = "material = { kind = \"diffuse\" }\n";
    const std::vector<std::pair<std::string, std::string>> cases{
        {"[[object]]\nradius = 1\n" + diffuse, "shape is missing"},
        {"[[object]]\nshape = \"cone\"\n" + diffuse, "no shape \"cone\""},
        {"[[object]]\nshape = \"sphere\"\n" + diffuse, "radius is missing"},
        {"[[object]]\nshape = \"sphere\"\nradius = -1\n" + diffuse, "must be positive"},
        {sphere + "size = [1, 1, 1]\n" + diffuse, "size"},
        {sphere, "material is missing"},
        {sphere + "material = { albedo = 1 }\n", "kind is missing"},
        {sphere + "material = { kind = \"wood\" }\n", "no kind \"wood\""},
        {sphere + "material = { kind = \"diffuse\", albedo = 1.2 }\n", "0 to 1"},
        {sphere + "material = { kind = \"diffuse\", albedo = [1, 2] }\n", "three numbers"},
        {sphere + "material = { kind = \"metal\" }\n", "f0"},
        {sphere + "material = { kind = \"metal\", f0 = 0.5, index = 1 }\n", "not both"},
        {sphere + "material = { kind = \"metal\", f0 = 0.5, roughness = 2 }\n", "roughness"},
        {sphere + "material = { kind = \"dielectric\", index = 0.5 }\n", "refractive index"},
        {sphere + "transform = { scale = [1, 2, 1] }\n" + diffuse, "scaled alike"},
        {sphere + "transform = { scale = 0 }\n" + diffuse, "flat"},
        {sphere + "transform = [1, 2, 3]\n" + diffuse, "12 or 16 numbers"},
        {sphere + "transform = { turn = 3 }\n" + diffuse, "turn"},
        {"[[object]]\nshape = \"plane\"\nmaterial = { kind = \"dielectric\" }\n", "closed shape"},
        {"[[object]]\nshape = \"mesh\"\n" + diffuse, "file is missing"},
        {"[[object]]\nshape = \"mesh\"\nfile = \"none.obj\"\n" + diffuse, "none.obj"},
        {"[[object]]\nshape = \"mesh\"\nfile = \"a.xyz\"\n" + diffuse, "unknown kind"},
        {"[[stone]]\nmaterial = \"diamond\"\n", "names its file"},
    };
    write("a.xyz", "x");
    for (const auto& [text, wanted] : cases) {
        const std::string said = refusal(text);
        EXPECT_NE(said.find(wanted), std::string::npos) << text << "said: " << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
}

const std::string k_tetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST_F(ObjectFiles, SeveralStonesStandWhereTheyArePut) {
    write("t.obj", k_tetrahedron);
    const Scene scene = read(
        "[[stone]]\nmesh = \"t.obj\"\nmaterial = \"diamond\"\n"
        "[[stone]]\nmesh = \"t.obj\"\nmaterial = \"quartz\"\noptic_axis = [1, 0, 0]\nunit = "
        "\"cm\"\n"
        "transform = { rotate = [0, 0, 90], translate = [2, 0, 0] }\n");
    ASSERT_EQ(scene.more_stones.size(), 1u);
    const Stone& second = scene.more_stones[0];
    // Centimetres, converted to the first stone's millimetres after the stone was placed in its own
    // unit.
    double far = 0;
    for (const Vec3& v : second.solid.vertices) far = std::max(far, v.x);
    EXPECT_NEAR(far, 20, 1e-12);
    EXPECT_NEAR(glm::length(second.crystal.axes[0] - Vec3(0, 1, 0)), 0, 1e-12);
    for (const Facet& facet : second.solid.facets) {
        for (const int corner : facet.corners) {
            EXPECT_NEAR(
                height_above(facet.plane, second.solid.vertices[static_cast<std::size_t>(corner)]),
                0, 1e-12);
        }
    }
    EXPECT_NE(refusal("[[stone]]\nmesh = \"t.obj\"\nmaterial = \"diamond\"\n"
                      "transform = { scale = [1, 1, -1] }\n"),
              "");
}

TEST_F(ObjectFiles, FingerprintsTellObjectsApart) {
    write("t.obj", k_tetrahedron);
    const auto print = [&](const std::string& text) {
        Fingerprint of;
        of.add(read(text));
        return of.hex();
    };
    const std::string mesh = "[[object]]\nshape = \"mesh\"\nfile = \"t.obj\"\n";
    const std::string one = print(mesh + "material = { kind = \"diffuse\", albedo = 0.5 }\n");
    EXPECT_EQ(one, print(mesh + "material = { kind = \"diffuse\", albedo = 0.5 }\n"));
    EXPECT_NE(one, print(mesh + "material = { kind = \"diffuse\", albedo = 0.6 }\n"));
    EXPECT_NE(one, print(mesh + "material = { kind = \"mirror\", albedo = 0.5 }\n"));
    EXPECT_NE(one,
              print(mesh + "smooth = true\nmaterial = { kind = \"diffuse\", albedo = 0.5 }\n"));
}

TEST_F(ObjectFiles, ATurntableTurnsEverything) {
    write("t.obj", k_tetrahedron);
    const Scene scene = read(
        "[[stone]]\nmesh = \"t.obj\"\nmaterial = \"diamond\"\n[[object]]\nshape = \"sphere\"\n"
        "center = [5, 0, 0]\nradius = 1\nmaterial = { kind = \"diffuse\" }\n");
    const Scene half = turned(scene, std::acos(-1.0));
    const Vec3 middle = centroid(scene.stone.solid);
    EXPECT_NEAR(glm::length(std::get<SphereShape>(half.objects[0].shape).center -
                            Vec3(2 * middle.x - 5, 2 * middle.y, 0)),
                0, 1e-12);
}

// A polygon with a notch, starting at the notch's far side: a fan would cover area outside of it.
TEST_F(ObjectFiles, PolygonsWithNotchesBecomeTrianglesOfTheirArea) {
    write("notch.obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 2 3 4 5 1\n");
    const TriangleMesh mesh = read_triangle_mesh(folder_ / "notch.obj");
    double sum = 0;
    for (const auto& t : mesh.triangles) {
        const auto at = [&](int k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
        const double z = glm::cross(at(1) - at(0), at(2) - at(0)).z / 2;
        EXPECT_GT(z, 0);
        sum += z;
    }
    EXPECT_NEAR(sum, 16 - 6, 1e-12);  // the square less the notch: 4 x 3 / 2
}

// One triangle: three positions of three floats, no indices.
std::string gltf(const std::string& node, const std::string& count = "3") {
    return "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[" +
           node +
           "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
           "\"bufferView\":0,\"componentType\":5126,\"count\":" +
           count +
           ",\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":36}"
           "],\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
           // (0 0 0) (1 0 0) (0 1 0)
           "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";
}

// +y of glTF is up, and its unit is the metre.
TEST_F(ObjectFiles, GltfIsReadWithItsAxesAndUnit) {
    write("a.gltf", gltf("{\"mesh\":0,\"translation\":[0,0,2]}"));
    const TriangleMesh mesh = read_triangle_mesh(folder_ / "a.gltf");
    ASSERT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.vertices[0], Vec3(0, -2, 0));
    EXPECT_EQ(mesh.vertices[1], Vec3(1, -2, 0));
    EXPECT_EQ(mesh.vertices[2], Vec3(0, -2, 1));
    const Scene scene = read(
        "[[object]]\nshape = \"mesh\"\nfile = \"a.gltf\"\nmaterial = { kind = \"diffuse\" }\n");
    EXPECT_EQ(std::get<MeshShape>(scene.objects[0].shape).mesh->vertices[1], Vec3(1000, -2000, 0));
}

TEST_F(ObjectFiles, DamagedGltfIsOneLine) {
    const std::string good = gltf("{\"mesh\":0}");
    const std::vector<std::string> bad{gltf("{\"mesh\":3}"),
                                       gltf("{\"mesh\":0,\"children\":[0]}"),
                                       gltf("{\"mesh\":0}", "4"),
                                       gltf("{\"mesh\":0}", "99999999999"),
                                       "glTF",
                                       "{}",
                                       good.substr(0, good.size() / 2)};
    for (const std::string& text : bad) {
        write("bad.gltf", text);
        EXPECT_THROW(read_triangle_mesh(folder_ / "bad.gltf"), InputError) << text;
    }
    // Changes every byte, one at a time: the file is read or refused, nothing worse.
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::string changed = good;
        changed[i] = static_cast<char>(changed[i] ^ 0x15);
        write("changed.gltf", changed);
        try {
            read_triangle_mesh(folder_ / "changed.gltf");
        } catch (const InputError&) {
        }
    }
}

}  // namespace
}  // namespace culet
