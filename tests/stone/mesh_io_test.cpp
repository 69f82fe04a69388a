#include "stone/mesh/mesh_io.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/geometric.hpp>

#include "stone/mesh/face_soup.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using namespace culet::test;

// A tetrahedron in several spellings.
void expect_tetrahedron(const ReadSolid& read) {
    EXPECT_EQ(read.solid.vertices.size(), 4u);
    EXPECT_EQ(read.solid.facets.size(), 4u);
    EXPECT_NEAR(volume(read.solid), 1.0 / 6.0, 1e-7);
    EXPECT_TRUE(find_faults(read.solid, {.planarity = 1e-6, .must_be_convex = true}).empty());
}

TEST(Obj, AllFormsOfCornersAndLines) {
    expect_tetrahedron(
        parse_mesh("# a comment\r\n"
                   "mtllib x.mtl\r\n"
                   "o stone\r\n"
                   "v 0 0 0\r\n"
                   "v 1 0 0 1.0\r\n"
                   "  v   0\t1 0   # behind\r\n"
                   "v 0 0 \\\r\n  1\r\n"
                   "vt 0 0\r\nvn 0 0 1\r\ns off\r\nusemtl m\r\n"
                   "f 1/1 3/1 2/1\r\n"
                   "f 1//1 2//1 4//1\r\n"
                   "f 2/1/1 3/1/1 4/1/1\r\n"
                   "l 1 2\r\np 1\r\n"
                   "f -2 -4 \\\r\n-1",
                   MeshFormat::obj));
}

TEST(Obj, NamesByGroupsAlone) {
    const ReadSolid read = parse_mesh(
        "o Gem\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
        "g table\nf 1 3 2\ng star 1  \nf 1 2 4\ng table\nf 2 3 4\ng\nf 3 1 4\n",
        MeshFormat::obj);
    ASSERT_EQ(read.solid.facets.size(), 4u);
    EXPECT_EQ(read.solid.facets[0].name, "table");
    EXPECT_EQ(read.solid.facets[1].name, "star 1");
    EXPECT_EQ(read.solid.facets[2].name, "table.1");
    EXPECT_EQ(read.solid.facets[3].name, "f0");
}

TEST(Names, RepeatedAndMissingOnes) {
    EXPECT_EQ(unique_names({"a", "a", "", "a", "f0", "a.1", ""}),
              (std::vector<std::string>{"a", "a.2", "f1", "a.3", "f0", "a.1", "f2"}));
}

TEST(Obj, ErrorsNameTheLine) {
    const auto message = [](const char* text) {
        try {
            parse_mesh(text, MeshFormat::obj, "x.obj");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    EXPECT_NE(message("v 0 0\n").find("x.obj:1:"), std::string::npos);
    EXPECT_NE(message("v 0 0 0\nv 0 nan 0\n").find("x.obj:2:"), std::string::npos);
    EXPECT_NE(message("v 0 0 0\n\nf 1 2 0\n").find("x.obj:3:"), std::string::npos);
    EXPECT_NE(message("v 0 0 0\nf 1 2 3\n").find("x.obj:2:"), std::string::npos);
    EXPECT_NE(message("v 0 0 0\nf 1 1 99999999999999999999\n").find("x.obj:2:"), std::string::npos);
    EXPECT_NE(message("v 0 0 0\nf -1 -1 -2\n").find("x.obj:2:"), std::string::npos);
    EXPECT_NE(message("hello\n").find("holds no mesh"), std::string::npos);
}

TEST(Off, VariantsAndComments) {
    const char* faces = "3 0 2 1\n3 0 1 3 255 0 0\n3 1 2 3\n3 2 0 3 0.5 0.5 0.5\n";
    for (const char* start :
         {"OFF\n4 4 6\n", "OFF 4 4 6\n", "OFF # x\n\n# a comment\n4 4 0 # n\n"}) {
        expect_tetrahedron(
            parse_mesh(std::string(start) + "0 0 0\n1 0 0\n# in between\n0 1 0\n0 0 1\n" + faces,
                       MeshFormat::off));
    }
    expect_tetrahedron(
        parse_mesh("COFF\n4 4 6\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n"
                   "0 1 0 255 0 0 255\n0 0 1 255 0 0 255\n" +
                       std::string(faces),
                   MeshFormat::off));
    expect_tetrahedron(parse_mesh(
        "NOFF\n4 4 6\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n0 0 1 0 0 1\n" + std::string(faces),
        MeshFormat::off));
    EXPECT_THROW(parse_mesh("4OFF\n1 1 1\n0 0 0 0\n", MeshFormat::off), InputError);
    EXPECT_THROW(parse_mesh("OFF BINARY\n4 4 6\n", MeshFormat::off), InputError);
}

const char* const k_ply_header =
    "element vertex 4\nproperty float x\nproperty float y\nproperty uchar red\nproperty double z\n"
    "element camera 1\nproperty list uchar short view\nproperty int id\n"
    "element face 4\nproperty uchar flags\nproperty list uchar uint vertex_index\n"
    "end_header\n";

TEST(Ply, TextWithOtherElements) {
    expect_tetrahedron(parse_mesh("ply\r\nformat ascii 1.0\r\ncomment made by hand\r\n" +
                                      std::string(k_ply_header) +
                                      "0 0 9 0\n1 0 9 0\n0 1 9 0\n0 0 9 1\n"
                                      "2 5 6 7\n"
                                      "1 3 0 2 1\n1 3 0 1 3\n1 3 1 2 3\n1 3 2 0 3\n",
                                  MeshFormat::ply));
}

template <class T>
void add_number(std::string& bytes, T value, bool big) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big) std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
}

std::string binary_ply(bool big) {
    std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                        "_endian 1.0\n" + k_ply_header;
    const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const auto& c : corners) {
        add_number(bytes, static_cast<float>(c[0]), big);
        add_number(bytes, static_cast<float>(c[1]), big);
        add_number(bytes, std::uint8_t{9}, big);
        add_number(bytes, c[2], big);
    }
    add_number(bytes, std::uint8_t{2}, big);
    add_number(bytes, std::int16_t{-5}, big);
    add_number(bytes, std::int16_t{6}, big);
    add_number(bytes, std::int32_t{7}, big);
    const std::uint32_t faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    for (const auto& f : faces) {
        add_number(bytes, std::uint8_t{1}, big);
        add_number(bytes, std::uint8_t{3}, big);
        for (const std::uint32_t corner : f) add_number(bytes, corner, big);
    }
    return bytes;
}

TEST(Ply, BinaryOfBothByteOrders) {
    expect_tetrahedron(parse_mesh(binary_ply(false), MeshFormat::ply));
    expect_tetrahedron(parse_mesh(binary_ply(true), MeshFormat::ply));
}

TEST(Ply, CountsBeyondTheFileAreRefusedAtOnce) {
    EXPECT_THROW(parse_mesh("ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
                            "property float x\nproperty float y\nproperty float z\n"
                            "element face 1\nproperty list uint int vertex_indices\nend_header\n",
                            MeshFormat::ply),
                 InputError);
    std::string bytes = binary_ply(false);
    bytes[bytes.size() - 13] = '\xff';  // the last face's count of corners
    EXPECT_THROW(parse_mesh(bytes, MeshFormat::ply), InputError);
}

TEST(Stl, TextInAnySpelling) {
    const std::string triangle =
        "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\nendloop\n"
        "endfacet\n";
    const std::string rest =
        "FACET NORMAL nan nan nan\n OUTER LOOP\n VERTEX 0 0 0\n VERTEX 1 0 0\n VERTEX 0 0 1\n"
        " ENDLOOP\nENDFACET\n"
        "facet normal 1 1 1 outer loop vertex 1 0 0 vertex 0 1 0 vertex 0 0 1 endloop endfacet\n"
        "facet normal -1 0 0\nouter loop\nvertex 0 1 0\nvertex 0 0 0\nvertex 0 0 1\nendloop\n"
        "endfacet\n";
    expect_tetrahedron(
        parse_mesh("solid a b c\n" + triangle + rest + "endsolid a b c\n", MeshFormat::stl));
    expect_tetrahedron(parse_mesh(
        "solid\n" + triangle + "endsolid\nsolid two\n" + rest + "endsolid two", MeshFormat::stl));
}

std::string binary_tetrahedron(const char* start) {
    std::string bytes(80, '\0');
    bytes.replace(0, std::strlen(start), start);
    add_number(bytes, std::uint32_t{4}, false);
    const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    for (const auto& f : faces) {
        for (int k = 0; k < 3; ++k) add_number(bytes, 0.0f, false);
        for (const int corner : f) {
            for (const float c : corners[corner]) add_number(bytes, c, false);
        }
        bytes.append(2, '\0');
    }
    return bytes;
}

TEST(Stl, BinaryEvenWhenItBeginsWithSolid) {
    expect_tetrahedron(parse_mesh(binary_tetrahedron("exported by x"), MeshFormat::stl));
    expect_tetrahedron(parse_mesh(binary_tetrahedron("solid facet normal"), MeshFormat::stl));
    const ReadSolid longer = parse_mesh(binary_tetrahedron("solid") + "trailing", MeshFormat::stl);
    expect_tetrahedron(longer);
    EXPECT_FALSE(longer.notes.empty());
    std::string cut = binary_tetrahedron("x");
    cut.resize(cut.size() - 20);
    EXPECT_THROW(parse_mesh(cut, MeshFormat::stl), InputError);
}

TEST(Stl, CornersThatRoundingMovedApartAreWelded) {
    std::string bytes = binary_tetrahedron("x");
    // One corner of one triangle, off by one unit in the last place of single precision.
    const std::size_t at = 84 + 50 + 12 + 12;  // triangle 1, second corner, x = 1
    const float moved = 1.0f - 6e-8f;
    std::memcpy(bytes.data() + at, &moved, 4);
    const ReadSolid read = parse_mesh(bytes, MeshFormat::stl);
    expect_tetrahedron(read);
    EXPECT_FALSE(read.notes.empty());
}

TEST(Mesh, OpenOneTriangleIsReadForTheChecksToName) {
    const ReadSolid read = parse_mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", MeshFormat::obj);
    ASSERT_EQ(read.solid.facets.size(), 1u);
    EXPECT_EQ(find_faults(read.solid).front().kind, FaultKind::open);
}

TEST(Mesh, UnknownExtensionIsRefused) {
    EXPECT_THROW(read_mesh("stone.3mf"), InputError);
    EXPECT_THROW(write_mesh(cube(), "stone.3mf"), InputError);
}

}  // namespace
}  // namespace culet
