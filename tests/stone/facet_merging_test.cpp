// Which faces merge into one facet, and which must not.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "stone/cuts/cuts.h"
#include "stone/mesh/mesh_io.h"
#include "stone/numbers/units.h"
#include "stone/solid/checks.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using namespace culet::test;

/// OBJ of unnamed triangles, with coordinates in the given format.
std::string triangles_obj(const Solid& solid, const char* form) {
    std::string text;
    for (const Vec3& v : solid.vertices) {
        text += "v";
        for (int axis = 0; axis < 3; ++axis) {
            text.append(" ").append(fmt::format(fmt::runtime(form), v[axis]));
        }
        text += "\n";
    }
    for (const Facet& facet : triangulated(solid).facets) {
        text += fmt::format("f {} {} {}\n", facet.corners[0] + 1, facet.corners[1] + 1,
                            facet.corners[2] + 1);
    }
    return text;
}

std::string binary_stl(const Solid& solid) {
    const Solid mesh = triangulated(solid);
    std::string bytes(80, 'x');
    const auto add = [&](const void* data, std::size_t size) {
        bytes.append(static_cast<const char*>(data), size);
    };
    const auto count = static_cast<std::uint32_t>(mesh.facets.size());
    add(&count, 4);
    for (const Facet& facet : mesh.facets) {
        std::vector<Vec3> rows;
        for (const int corner : facet.corners) rows.push_back(mesh.vertices[corner]);
        rows.insert(rows.begin(), plane_through(rows).normal);
        for (const Vec3& row : rows) {
            for (int axis = 0; axis < 3; ++axis) {
                const auto value = static_cast<float>(row[axis]);
                add(&value, 4);
            }
        }
        bytes.append(2, '\0');
    }
    return bytes;
}

TEST(FacetMerging, TrianglesOfEveryWrittenPrecisionFindTheirFacets) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const Solid solid = random_solid(12 + 6 * static_cast<int>(seed), seed);
        for (const char* form : {"{}", "{:.9f}", "{:.7f}", "{:.6e}", "{:.8g}"}) {
            SCOPED_TRACE(fmt::format("seed {} form {}", seed, form));
            const ReadSolid read = parse_mesh(triangles_obj(solid, form), MeshFormat::obj);
            EXPECT_EQ(read.solid.facets.size(), solid.facets.size());
            EXPECT_EQ(read.solid.vertices.size(), solid.vertices.size());
            EXPECT_TRUE(is_closed(read.solid));
        }
        const ReadSolid read = parse_mesh(binary_stl(solid), MeshFormat::stl);
        EXPECT_EQ(read.solid.facets.size(), solid.facets.size()) << seed;
        EXPECT_EQ(read.solid.vertices.size(), solid.vertices.size()) << seed;
    }
}

// A roof of two rectangles that differ by `tilt_deg`, in full precision.
TEST(FacetMerging, FacetsThatDifferByAHundredthOfADegreeStayApart) {
    for (const double tilt_deg : {1.0, 0.05, 0.01, 1e-4}) {
        const double rise = std::tan(radians(tilt_deg) / 2);
        const double length = std::hypot(rise, 1);
        auto planes = cube_planes();
        planes.erase(planes.begin() + 4);
        planes.push_back({"left", {Vec3(-rise, 0, 1) / length, 1 / length}});
        planes.push_back({"right", {Vec3(rise, 0, 1) / length, 1 / length}});
        const Solid solid = intersect_half_spaces(planes).solid;
        ASSERT_EQ(solid.facets.size(), 7u);
        const ReadSolid read = parse_mesh(triangles_obj(solid, "{}"), MeshFormat::obj);
        EXPECT_EQ(read.solid.facets.size(), 7u) << tilt_deg;
        // Relative to the stone, too.
        Solid small = moved(solid, 1e-3, {0, 0, 0});
        small.vertices.push_back({1, 1, 1});
        small.vertices.push_back({1, 1, 2});
        small.vertices.push_back({1, 2, 1});
        small.facets.push_back({"far", {}, {8, 9, 10}});
        const ReadSolid far = parse_mesh(triangles_obj(small, "{}"), MeshFormat::obj);
        EXPECT_GE(far.solid.facets.size(), 8u) << tilt_deg;
    }
}

TEST(FacetMerging, DifferentNamesKeepFacesApart) {
    const char* text =
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
        "g a\nf 1 2 3\ng b\nf 1 3 4\n";
    const ReadSolid read = parse_mesh(text, MeshFormat::obj);
    ASSERT_EQ(read.solid.facets.size(), 2u);
    EXPECT_EQ(read.solid.facets[0].name, "a");
    EXPECT_EQ(read.solid.facets[1].name, "b");
}

TEST(FacetMerging, OneNameForManyPlanesIsNumbered) {
    const Solid solid = cube();
    std::string text;
    for (const Vec3& v : solid.vertices) text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    text += "g crown\n";
    for (const Facet& facet : triangulated(solid).facets) {
        text += fmt::format("f {} {} {}\n", facet.corners[0] + 1, facet.corners[1] + 1,
                            facet.corners[2] + 1);
    }
    const ReadSolid read = parse_mesh(text, MeshFormat::obj);
    ASSERT_EQ(read.solid.facets.size(), 6u);
    EXPECT_EQ(read.solid.facets[0].name, "crown");
    EXPECT_EQ(read.solid.facets[5].name, "crown.5");
}

TEST(FacetMerging, CornersWithinStraightEdgesGo) {
    // The cube with a vertex in the middle of one edge, in both facets that meet there.
    Solid solid = cube();
    const int a = solid.facets[0].corners[0], b = solid.facets[0].corners[1];
    solid.vertices.push_back(0.5 * (solid.vertices[a] + solid.vertices[b]));
    for (Facet& facet : solid.facets) {
        for (std::size_t i = 0; i < facet.corners.size(); ++i) {
            const int p = facet.corners[i], q = facet.corners[(i + 1) % facet.corners.size()];
            if ((p == a && q == b) || (p == b && q == a)) {
                facet.corners.insert(facet.corners.begin() + static_cast<long>(i) + 1, 8);
                break;
            }
        }
    }
    std::string text;
    for (const Vec3& v : solid.vertices) text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
    for (const Facet& facet : solid.facets) {
        text += "f";
        for (const int corner : facet.corners) text += fmt::format(" {}", corner + 1);
        text += "\n";
    }
    const ReadSolid read = parse_mesh(text, MeshFormat::obj);
    EXPECT_EQ(read.solid.vertices.size(), 8u);
    EXPECT_EQ(edge_count(read.solid), 12);
}

TEST(FacetMerging, SliversJoinWhateverTheySeemToFace) {
    // A square of two large triangles and a sliver between them that rounding flipped over.
    const char* text =
        "v 0.0000000 0.0000000 0.0000000\nv 1.0000000 0.0000000 0.0000000\n"
        "v 1.0000000 1.0000000 0.0000000\nv 0.0000000 1.0000000 0.0000000\n"
        "v 0.5000000 0.5000000 0.0000001\nv 0.3333333 0.1234567 -1.0000000\n"
        "f 1 2 3\nf 1 3 5\nf 1 5 3 4\n";
    const ReadSolid read = parse_mesh(text, MeshFormat::obj);
    ASSERT_EQ(read.solid.facets.size(), 1u);
    EXPECT_EQ(read.solid.facets[0].corners.size(), 4u);
}

TEST(FacetMerging, AFacetWithAHoleIsNoFacet) {
    // A square ring of eight triangles about a pit.
    std::string text =
        "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 1 1 0\nv 2 1 0\nv 2 2 0\nv 1 2 0\nv 1.5 1.5 -1\n";
    for (int i = 0; i < 4; ++i) {
        const int j = (i + 1) % 4;
        text += fmt::format("f {} {} {}\nf {} {} {}\nf {} {} 9\n", i + 1, j + 1, j + 5, i + 1,
                            j + 5, i + 5, i + 5, j + 5);
    }
    const ReadSolid read = parse_mesh(text, MeshFormat::obj);
    EXPECT_EQ(read.solid.facets.size(), 12u);
    bool told = false;
    for (const std::string& note : read.notes) told |= note.find("hole") != std::string::npos;
    EXPECT_TRUE(told);
    bool repeated = false;
    for (const Fault& fault : find_faults(read.solid)) {
        repeated |= fault.kind == FaultKind::repeated_plane;
    }
    EXPECT_TRUE(repeated);
}

TEST(FacetMerging, SingleFacesOfAFlatSheetMergeToOneOutline) {
    std::string text;
    const int n = 60;
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) text += fmt::format("v {} {} {:.6f}\n", x, y, 0.25 * x);
    }
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const int a = y * (n + 1) + x + 1;
            text += fmt::format("f {} {} {}\nf {} {} {}\n", a, a + 1, a + n + 2, a, a + n + 2,
                                a + n + 1);
        }
    }
    const ReadSolid read = parse_mesh(text, MeshFormat::obj);
    ASSERT_EQ(read.solid.facets.size(), 1u);
    EXPECT_NEAR(area(read.solid, read.solid.facets[0]), n * n * std::hypot(1, 0.25), 1e-6);
}

// As other programs write a cut design: ASCII STL, six digits, separate triangles.
TEST(FacetMerging, CutsInSixDigitsOfAsciiStl) {
    for (const char* name : {"round-brilliant", "oval", "step", "princess"}) {
        SCOPED_TRACE(name);
        const Solid cut = make_cut(name);
        std::string text = "solid design\n";
        for (const Facet& facet : triangulated(cut).facets) {
            text += "facet normal 0 0 0\nouter loop\n";
            for (const int corner : facet.corners) {
                const Vec3& v = cut.vertices[static_cast<std::size_t>(corner)];
                text += fmt::format("vertex {:.5e} {:.5e} {:.5e}\n", v.x, v.y, v.z);
            }
            text += "endloop\nendfacet\n";
        }
        const ReadSolid read = parse_mesh(text + "endsolid design\n", MeshFormat::stl);
        EXPECT_EQ(read.solid.facets.size(), cut.facets.size());
        EXPECT_EQ(read.solid.vertices.size(), cut.vertices.size());
        EXPECT_TRUE(is_closed(read.solid));
    }
}

}  // namespace
}  // namespace culet
