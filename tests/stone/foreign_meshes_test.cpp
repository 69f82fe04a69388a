// Meshes of other programs. Expectations: closed forms of one stone (an octagonal table cut: table
// of radius 1.8 at z = 1, girdle of radius 3 at z = 0, culet at z = -2.2), or a format's
// specification.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/cuts/cuts.h"
#include "stone/mesh/mesh_io.h"
#include "stone/solid/checks.h"
#include "stone/solid_input.h"
#include "stone/stone_io.h"
#include "stone/text/errors.h"
#include "stone/upright.h"
#include "tests/folder_test.h"
#include "tests/says.h"

namespace culet {
namespace {

using namespace culet::test;
using testing::HasSubstr;
using testing::IsEmpty;

using Face = std::vector<int>;
using Place = std::function<Vec3(const Vec3&)>;

struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Face> faces;
};

// Corners 0 to 7 girdle, 8 to 15 table, 16 culet; faces: table, crown, pavilion.
Mesh octagon() {
    Mesh mesh;
    for (int ring = 0; ring < 2; ++ring) {
        for (int i = 0; i < 8; ++i) {
            const double a = std::numbers::pi * (2 * i + 1) / 8, r = ring == 0 ? 3 : 1.8;
            mesh.vertices.emplace_back(r * std::cos(a), r * std::sin(a), ring);
        }
    }
    mesh.vertices.emplace_back(0, 0, -2.2);
    mesh.faces.push_back({8, 9, 10, 11, 12, 13, 14, 15});
    for (int i = 0; i < 8; ++i) mesh.faces.push_back({i, (i + 1) % 8, 8 + (i + 1) % 8, 8 + i});
    for (int i = 0; i < 8; ++i) mesh.faces.push_back({16, (i + 1) % 8, i});
    return mesh;
}

// Area of an octagon of radius r is 2 sqrt(2) r^2; a frustum and a pyramid.
const double k_volume = 2 * std::numbers::sqrt2 * ((9 + 3 * 1.8 + 1.8 * 1.8) / 3 + 9 * 2.2 / 3);

std::string obj_of(const Mesh& mesh, const Place& place = {}) {
    std::string text;
    for (const Vec3& given : mesh.vertices) {
        const Vec3 v = place ? place(given) : given;
        text += fmt::format("v {:.9f} {:.9f} {:.9f}\n", v.x, v.y, v.z);
    }
    for (const Face& face : mesh.faces) {
        text += "f";
        for (const int corner : face) text += fmt::format(" {}", corner + 1);
        text += '\n';
    }
    return text;
}

Mesh mesh_of(const Solid& solid) {
    Mesh mesh{solid.vertices, {}};
    for (const Facet& facet : solid.facets) mesh.faces.push_back(facet.corners);
    return mesh;
}

Vec3 y_up(const Vec3& v) {
    return {v.x, v.z, -v.y};
}

class ForeignMeshes : public FolderTest {};

// The solid of these planes: direction of the normal, offset.
Solid of_planes(const std::vector<std::pair<Vec3, double>>& given) {
    std::vector<NamedPlane> planes;
    for (const auto& [normal, offset] : given)
        planes.push_back({"", {glm::normalize(normal), offset}});
    return intersect_half_spaces(planes).solid;
}

// A dome of facets with these inclinations (degrees, at unit distance) over a flat base at z = 0.
Solid rose(const std::vector<double>& inclinations) {
    std::vector<std::pair<Vec3, double>> planes{{{0, 0, -1}, 0}};
    for (const double tilt_deg : inclinations) {
        for (int i = 0; i < 6; ++i) {
            const double a = std::numbers::pi * i / 3, t = tilt_deg * std::numbers::pi / 180;
            planes.push_back(
                {{std::sin(t) * std::cos(a), std::sin(t) * std::sin(a), std::cos(t)}, 1});
        }
    }
    return of_planes(planes);
}

Solid drop() {
    std::vector<std::pair<Vec3, double>> planes;
    for (int i = 0; i < 8; ++i) {
        const double a = std::numbers::pi * i / 4;
        planes.push_back({{std::cos(a), std::sin(a), 0.3}, 1});
        planes.push_back({{std::cos(a), std::sin(a), -0.9}, 1});
    }
    return of_planes(planes);
}

TEST_F(ForeignMeshes, AreTurnedTableUp) {
    const struct {
        const char* says;
        Place place;
        Vec3 up;
    } cases[] = {
        {"+y", y_up, {0, 1, 0}},
        {"-y",
         [](const Vec3& v) {
             return Vec3{v.x, -v.z, v.y};
         },
         {0, -1, 0}},
        {"-z",
         [](const Vec3& v) {
             return Vec3{v.x, -v.y, -v.z};
         },
         {0, 0, -1}},
        {"+x",
         [](const Vec3& v) {
             return Vec3{v.z, v.y, -v.x};
         },
         {1, 0, 0}},
        {"-x",
         [](const Vec3& v) {
             return Vec3{-v.z, v.y, v.x};
         },
         {-1, 0, 0}},
        {"(",
         [](const Vec3& v) {
             return glm::transpose(turn_upright({0.48, -0.6, 0.64})) * v;
         },
         {0.48, -0.6, 0.64}},
    };
    const Mesh stone = octagon();
    for (const auto& c : cases) {
        const SolidInput read = load_solid(write("stone.obj", obj_of(stone, c.place)));
        ASSERT_EQ(read.notes.size(), 1u) << c.says;
        EXPECT_THAT(read.notes[0], says("faces", c.says, "turned", "up = [0, 0, 1]"));
        EXPECT_LT(glm::length(read.file_up - c.up), 1e-8) << c.says;
        ASSERT_EQ(read.changed.size(), 1u) << c.says;
        EXPECT_EQ(read.changed[0].what, "mesh turned upright");
        EXPECT_NEAR(read.changed[0].before, degrees(angle_between(c.up, {0, 0, 1})), 1e-6);
        EXPECT_NEAR(read.changed[0].after, 0, 1e-6) << c.says;
        // The least rotation undoes each of these.
        for (std::size_t v = 0; v < stone.vertices.size(); ++v)
            EXPECT_LT(glm::length(read.solid.vertices[v] - stone.vertices[v]), 1e-7) << c.says;
        EXPECT_LT(glm::length(read.solid.facets[0].plane.normal - Vec3(0, 0, 1)), 1e-8) << c.says;
    }
}

TEST_F(ForeignMeshes, ThatStandRightOrCannotBeToldAreLeftAsTheyAre) {
    const double third = std::numbers::pi / 180 * 3;
    const std::pair<const char*, Mesh> cases[] = {
        {"right", octagon()},
        {"table tilted by 3 degrees",
         mesh_of(turned(load_solid(write("right.obj", obj_of(octagon()))).solid,
                        turn_upright({std::sin(third), 0, std::cos(third)})))},
        {"cube", mesh_of(of_planes({{{1, 0, 0}, 1},
                                    {{-1, 0, 0}, 1},
                                    {{0, 1, 0}, 1},
                                    {{0, -1, 0}, 1},
                                    {{0, 0, 1}, 1},
                                    {{0, 0, -1}, 1}}))},
        {"octahedron", mesh_of(of_planes({{{1, 1, 1}, 1},
                                          {{-1, 1, 1}, 1},
                                          {{1, -1, 1}, 1},
                                          {{-1, -1, 1}, 1},
                                          {{1, 1, -1}, 1},
                                          {{-1, 1, -1}, 1},
                                          {{1, -1, -1}, 1},
                                          {{-1, -1, -1}, 1}}))},
        {"tetrahedron",
         mesh_of(
             of_planes({{{1, 1, 1}, 1}, {{-1, -1, 1}, 1}, {{-1, 1, -1}, 1}, {{1, -1, -1}, 1}}))},
        {"rose on its flat base", mesh_of(rose({20, 50}))},
        {"rose with an upright girdle", mesh_of(rose({20, 50, 90}))},
        {"drop without a table", mesh_of(drop())},
    };
    for (const auto& [name, mesh] : cases) {
        for (const Place& place : {Place(), Place(y_up)}) {
            if (place && std::string(name).find("right") == 0) continue;
            if (place && std::string(name).find("table") == 0) continue;
            const SolidInput read = load_solid(write("stone.obj", obj_of(mesh, place)));
            EXPECT_EQ(read.file_up, Vec3(0, 0, 1)) << name;
        }
    }
}

TEST_F(ForeignMeshes, WithoutATableAreAskedAbout) {
    EXPECT_THAT(question_of_up(drop()), says("up = "));
    EXPECT_EQ(question_of_up(make_cut("oval")), "");
}

// The catalogue's cuts are table up by definition (cuts.h); those with a table facet T mark it.
TEST_F(ForeignMeshes, StandardCutsAreNeverTurnedWrong) {
    for (const CutKind& kind : cut_kinds()) {
        const Solid solid = make_cut(kind.name);
        if (const auto table = table_by_shape(solid)) {
            EXPECT_GT(solid.facets[std::size_t(*table)].plane.normal.z, 1 - 1e-12) << kind.name;
        } else {
            EXPECT_LT(find_facet(solid, "T"), 0) << kind.name << " has a table";
        }
        for (const glm::dmat3& attitude :
             {turn_upright({0, 1, 0}), turn_upright({0, 0, -1}), turn_upright({0.6, 0.64, 0.48})}) {
            const Solid lying = turned(solid, attitude);
            const auto table = table_by_shape(lying);
            if (!table) continue;
            const Vec3 up = attitude * Vec3(0, 0, 1);
            EXPECT_LT(glm::length(lying.facets[std::size_t(*table)].plane.normal - up), 1e-9)
                << kind.name;
        }
    }
}

TEST_F(ForeignMeshes, AStoneFileSaysWhichWayIsUp) {
    write("stone.obj", obj_of(octagon(), y_up));
    const auto stone_with = [&](const std::string& lines) {
        return read_stone(write("stone.toml",
                                "[stone]\nmesh = \"stone.obj\"\nmaterial = "
                                "\"quartz\"\n" +
                                    lines));
    };
    const double table = stone_with("").stone.solid.vertices[8].z;
    EXPECT_NEAR(table, 1, 1e-8) << "by its shape";
    for (const char* up : {"up = \"f0\"\n", "up = \"table\"\n", "up = [0, 2, 0]\n"}) {
        const StoneFile file = stone_with(up);
        EXPECT_NEAR(file.stone.solid.vertices[8].z, 1, 1e-8) << up;
        EXPECT_LT(glm::length(up_of(file.stone) - Vec3(0, 0, 1)), 1e-8) << up;
        ASSERT_EQ(file.notes.size(), 1u) << up;
        EXPECT_THAT(file.notes[0], says("up", "+y", "turned"));
    }
    const StoneFile given = stone_with("up = [0, 0, 1]\n");
    EXPECT_NEAR(given.stone.solid.vertices[8].y, 1, 1e-8) << "what is stated wins";
    EXPECT_THAT(given.notes, IsEmpty());
    // A stated axis is that of the mesh as it is; without one the axis is up.
    const auto axis = [&](const std::string& lines) {
        return stone_with(lines).stone.crystal.axes[0];
    };
    EXPECT_LT(glm::length(axis("up = \"f0\"\noptic_axis = [0, 1, 0]\n") - Vec3(0, 0, 1)), 1e-12);
    EXPECT_LT(glm::length(axis("up = \"f0\"\n") - Vec3(0, 0, 1)), 1e-12);
}

TEST(ForeignFaces, AreTurnedRoundOrLeftOutWhereEdgesAreSound) {
    const auto reversed = [](Face face) {
        std::reverse(face.begin(), face.end());
        return face;
    };
    const struct {
        const char* what;
        const char* says;
        double inside_out;  // facets, of 17
        std::function<void(Mesh&)> change;
    } cases[] = {
        {"as it is", "", 0, [](Mesh&) {}},
        {"all faces inside out", "all faces", 17,
         [&](Mesh& m) {
             for (Face& f : m.faces) f = reversed(f);
         }},
        {"mirrored vertices", "all faces", 17,
         [](Mesh& m) {
             for (Vec3& v : m.vertices) v.x = -v.x;
         }},
        {"one face", "f3", 1, [&](Mesh& m) { m.faces[3] = reversed(m.faces[3]); }},
        {"every third face", "6 facets", 6,
         [&](Mesh& m) {
             for (std::size_t f = 0; f < m.faces.size(); f += 3) m.faces[f] = reversed(m.faces[f]);
         }},
        {"the table twice", "left out 1 face", 0, [](Mesh& m) { m.faces.push_back(m.faces[0]); }},
        {"each face twice, both ways round", "left out 17 faces", 0,
         [&](Mesh& m) {
             for (std::size_t f = 0; f < 17; ++f) m.faces.push_back(reversed(m.faces[f]));
         }},
        {"a corner in the middle of a neighbour's edge", "a corner of a face lay", 0,
         [](Mesh& m) {
             m.vertices.push_back(0.5 * (m.vertices[0] + m.vertices[1]));
             m.faces[1].insert(m.faces[1].begin() + 1, 17);
         }},
        {"an edge of two facets parted by each elsewhere, twice by one", "3 corners", 0,
         [](Mesh& m) {
             for (const double part : {0.2, 0.4, 0.7})
                 m.vertices.push_back(glm::mix(m.vertices[0], m.vertices[1], part));
             m.faces[1].insert(m.faces[1].begin() + 1, {17, 19});
             m.faces[9].insert(m.faces[9].begin() + 2, 18);
         }},
    };
    for (const auto& c : cases) {
        Mesh mesh = octagon();
        c.change(mesh);
        const ReadSolid read = parse_mesh(obj_of(mesh), MeshFormat::obj);
        EXPECT_THAT(find_faults(read.solid, {.planarity = 1e-6}), IsEmpty()) << c.what;
        EXPECT_EQ(read.solid.facets.size(), 17u) << c.what;
        EXPECT_NEAR(volume(read.solid), k_volume, 1e-6) << c.what;
        EXPECT_EQ(read.changed.empty() ? 0 : read.changed[0].before, c.inside_out) << c.what;
        if (*c.says == 0) {
            EXPECT_THAT(read.notes, IsEmpty()) << c.what;
            continue;
        }
        ASSERT_EQ(read.notes.size(), 1u) << c.what;
        EXPECT_THAT(read.notes[0], HasSubstr(c.says)) << c.what;
    }
    Mesh open = octagon();
    open.faces.erase(open.faces.begin() + 4);
    open.faces[7] = reversed(open.faces[7]);
    EXPECT_FALSE(find_faults(parse_mesh(obj_of(open), MeshFormat::obj).solid).empty());
}

// PLY (Turk 1994): readers skip unknown properties; a triangle strip in Stanford's files ends with
// -1.
TEST(ForeignPly, WhatNobodyNeedsDecidesNothing) {
    const std::string header =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
        "property float y\nproperty float z\nproperty float quality\n";
    const std::string vertices = "0 0 0 nan\n1 0 0 -nan(ind)\n0 1 0 inf\n0 0 1 1e999\n";
    const std::string cases[] = {
        header +
            "element face 4\nproperty list ushort uint vertex_indices\nproperty list char "
            "float texcoord\nend_header\n" +
            vertices + "3 0 2 1 1 nan\n3 0 1 3 0\n3 1 2 3 0\n3 2 0 3 0\n",
        // 1 0 2, (0 2 3 reversed:) 2 0 3, and after the end of the strip 0 1 3 2.
        header + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" +
            vertices + "9 1 0 2 3 -1 0 1 3 2\n",
    };
    for (const std::string& text : cases) {
        const ReadSolid read = parse_mesh(text, MeshFormat::ply);
        EXPECT_EQ(read.solid.facets.size(), 4u);
        EXPECT_NEAR(volume(read.solid), 1.0 / 6, 1e-12);
        EXPECT_THAT(find_faults(read.solid), IsEmpty());
    }
}

// glTF 2.0, 3.6.2 and 3.7.2.1. Bytes are little-endian.
class ForeignGltf : public FolderTest {
protected:
    template <class T>
    static std::string bytes(const std::vector<T>& values) {
        std::string text(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        text.resize((text.size() + 3) / 4 * 4);
        return text;
    }
    // The parts lie one after the other, each in its own buffer view. The stated buffer length
    // excludes the last `unstated` bytes.
    static std::string glb(const std::string& json, const std::vector<std::string>& parts,
                           std::size_t unstated = 0) {
        std::string views, data;
        for (const std::string& part : parts) {
            views += fmt::format("{}{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{}}}",
                                 views.empty() ? "" : ",", data.size(), part.size());
            data += part;
        }
        std::string text = fmt::format(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"buffers\":[{{\"byteLength\":{}}}],"
            "\"bufferViews\":[{}],{}}}",
            data.size() - unstated, views, json);
        text.resize((text.size() + 3) / 4 * 4, ' ');
        const auto word = [](std::size_t n) {
            return bytes(std::vector<std::uint32_t>{static_cast<std::uint32_t>(n)});
        };
        return "glTF" + word(2) + word(28 + text.size() + data.size()) + word(text.size()) +
               "JSON" + text + word(data.size()) + std::string("BIN\0", 4) + data;
    }
    static std::string scene(const std::string& node, int mode) {
        return fmt::format(
            "\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{{\"mesh\":0{}}}],\"meshes\":[{{"
            "\"primitives\":[{{\"attributes\":{{\"POSITION\":0}},\"indices\":1,\"mode\":{}}}]}}],",
            node, mode);
    }
    static std::string accessor(int view, int type, std::size_t count, const char* shape,
                                const std::string& more = "") {
        return fmt::format(
            "{{\"bufferView\":{},\"componentType\":{},\"count\":{},\"type\":\"{}\"{}}}", view, type,
            count, shape, more);
    }
    // A tetrahedron of 1 mm along the axes, y up: in metres.
    const std::vector<float> corners_{0, 0, 0, 1e-3F, 0, 0, 0, 1e-3F, 0, 0, 0, 1e-3F};
    const std::vector<std::uint16_t> triangles_{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
};

TEST_F(ForeignGltf, WhatContributesToTheSurfaceIsRead) {
    const std::string float3 = accessor(0, 5126, 4, "VEC3");
    const auto indices = [](std::size_t n) { return accessor(1, 5123, n, "SCALAR"); };
    // Only the sparse part gives the first corner.
    std::vector<float> moved = corners_;
    moved[0] = moved[1] = 7;
    std::vector<float> split;
    for (const std::uint16_t corner : triangles_) {
        for (std::size_t k = 0; k < 3; ++k) split.push_back(corners_[3u * corner + k]);
    }
    const struct {
        const char* what;
        std::string file;
    } cases[] = {
        {"triangles", glb(scene("", 4) + "\"accessors\":[" + float3 + "," + indices(12) + "]",
                          {bytes(corners_), bytes(triangles_)})},
        {"strip", glb(scene("", 5) + "\"accessors\":[" + float3 + "," + indices(6) + "]",
                      {bytes(corners_), bytes(std::vector<std::uint16_t>{1, 0, 2, 3, 1, 0})})},
        {"sparse", glb(scene("", 4) + "\"accessors\":[" +
                           accessor(0, 5126, 4, "VEC3",
                                    ",\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":2,"
                                    "\"componentType\":5121},\"values\":{\"bufferView\":3}}") +
                           "," + indices(12) + "]",
                       {bytes(moved), bytes(triangles_), bytes(std::vector<std::uint8_t>{0}),
                        bytes(std::vector<float>{0, 0, 0})})},
        // As Blender writes what was modelled in mm and z up.
        {"a node that turns and scales, indices of a byte",
         glb(scene(",\"rotation\":[-0.7071067811865476,0,0,0.7071067811865476],\"scale\":[0.001,"
                   "0.001,0.001]",
                   4) +
                 "\"accessors\":[" + float3 + "," + accessor(1, 5121, 12, "SCALAR") + "]",
             {bytes(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}),
              bytes(std::vector<std::uint8_t>(triangles_.begin(), triangles_.end()))})},
        // As flat shading has it.
        {"corners of each triangle by itself, without normals",
         glb(scene("", 4) + "\"accessors\":[" + accessor(0, 5126, 12, "VEC3") + "," +
                 accessor(1, 5125, 12, "SCALAR") + "]",
             {bytes(split),
              bytes(std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11})})},
        {"buffer stated shorter than it is",
         glb(scene("", 4) + "\"accessors\":[" + float3 + "," + indices(12) + "]",
             {bytes(corners_), bytes(triangles_)}, 16)},
        {"quantized",
         glb(scene(",\"scale\":[0.001,0.001,0.001]", 4) +
                 "\"extensionsRequired\":[\"KHR_mesh_quantization\"],\"accessors\":[" +
                 accessor(0, 5122, 4, "VEC3", ",\"normalized\":true") + "," + indices(12) + "]",
             {bytes(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 0, 32767, 0, 0, 0, 32767}),
              bytes(triangles_)})},
    };
    for (const auto& c : cases) {
        const SolidInput read = load_solid(write(std::string(c.what) + ".glb", c.file));
        EXPECT_EQ(read.solid.facets.size(), 4u) << c.what;
        EXPECT_NEAR(volume(read.solid), 1.0 / 6, 1e-6) << c.what << ", in mm3";
        EXPECT_THAT(find_faults(read.solid, {.planarity = 1e-6}), IsEmpty()) << c.what;
    }
    const std::string twice = glb(
        scene(",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":2}}}",
              4) +
            "\"accessors\":[" + float3 + "," + indices(12) + "," + accessor(2, 5126, 2, "VEC3") +
            "]",
        {bytes(corners_), bytes(triangles_), bytes(std::vector<float>{0, 0, 0, 0.01F, 0, 0})});
    EXPECT_EQ(load_solid(write("twice.glb", twice)).solid.facets.size(), 8u) << "two instances";
}

TEST_F(ForeignGltf, WhatIsRequiredAndNotKnownIsRefusedByName) {
    for (const char* name :
         {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "ACME_warped_space"}) {
        const std::string file =
            glb(scene("", 4) + "\"extensionsRequired\":[\"" + name + "\"],\"accessors\":[" +
                    accessor(0, 5126, 4, "VEC3") + "," + accessor(1, 5123, 12, "SCALAR") + "]",
                {bytes(corners_), bytes(triangles_)});
        try {
            load_solid(write("required.glb", file));
            ADD_FAILURE() << name;
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), says(name, "export it without"));
        }
    }
}

// With Open CASCADE or without, a line says what it is; tests/exports reads good files.
using ForeignStep = FolderTest;

TEST_F(ForeignStep, IsReadOrToldOf) {
    try {
        load_solid(write("a.step", "ISO-10303-21;\nHEADER;\n"));
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), says("a.step: ", "STEP"));
    }
}

}  // namespace
}  // namespace culet
