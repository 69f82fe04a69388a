// Designs, meshes and polyhedra by others.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/outside/outside_folder.h"
#include "stone/design/proportions.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/solid/checks.h"
#include "stone/text/output_file.h"
#include "tests/scratch_folder.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using namespace culet::test;

// Counts and ratios computed independently from the same files (metrics.json; half-spaces by Qhull,
// meets contracted at 3e-4 of the width).
TEST(OutsideDesigns, HaveThePublishedCountsAndRatios) {
    const auto designs = designs_in(outside::folder() / "designs");
    ASSERT_FALSE(designs.empty());
    const auto metrics =
        nlohmann::json::parse(read_text(outside::folder() / "designs/metrics.json"));
    EXPECT_EQ(designs.size(), metrics.size());
    for (const auto& design : designs) {
        SCOPED_TRACE(design.filename());
        const auto& known = metrics.at(design.filename().string());
        const ReadCut cut = read_cut(design);
        const Solid& solid = cut.solid;
        EXPECT_EQ(solid.facets.size(), known["facets"].get<std::size_t>());
        EXPECT_EQ(solid.vertices.size(), known["vertices"].get<std::size_t>());
        EXPECT_EQ(edge_count(solid), known["edges"].get<int>());
        EXPECT_EQ(cut.unused_planes.size(), known["unused_planes"].get<std::size_t>());
        EXPECT_EQ(cut.repeated_planes.size(), known["repeated_planes"].get<std::size_t>());
        // Corners differ by as much as meets miss, so lengths agree only to 3e-4.
        const Proportions p = proportions(solid);
        const double near = 3e-4;
        EXPECT_NEAR(p.width / known["W"].get<double>(), 1, near);
        EXPECT_NEAR(p.length / known["L"].get<double>(), 1, near);
        EXPECT_NEAR(p.height / p.width, known["HW"].get<double>(), near);
        EXPECT_NEAR(p.pavilion / p.width, known["PW"].get<double>(), near);
        EXPECT_NEAR(p.crown / p.width, known["CW"].get<double>(), near);
        EXPECT_EQ(p.table_length.has_value(), known.contains("TW"));
        if (known.contains("TW") && p.table_length) {
            EXPECT_NEAR(*p.table_length / p.width, known["TW"].get<double>(), near);
            EXPECT_NEAR(*p.table_width / p.width, known["UW"].get<double>(), near);
        }
        EXPECT_NEAR(volume(solid) / known["volume"].get<double>(), 1, near);
        EXPECT_EQ(cut.solid.design->gear, known["gear"].get<double>());
        EXPECT_TRUE(
            find_faults(solid, {.planarity = k_largest_miss, .must_be_convex = true}).empty());
    }
}

// The same design in both file formats: planes agree to 5e-9.
TEST(OutsideDesigns, GemAndAscAgree) {
    const std::filesystem::path folder = outside::folder() / "designs";
    for (const char* name : {"SRB", "Turkey", "Compear125", "CubeIllusionTri"}) {
        SCOPED_TRACE(name);
        const ReadCut asc = read_cut(folder / (std::string(name) + ".asc"));
        const ReadCut gem = read_cut(folder / (std::string(name) + ".gem"));
        EXPECT_EQ(asc.solid.facets.size(), gem.solid.facets.size());
        EXPECT_EQ(asc.solid.vertices.size(), gem.solid.vertices.size());
        EXPECT_EQ(edge_count(asc.solid), edge_count(gem.solid));
        EXPECT_EQ(asc.solid.design->gear, gem.solid.design->gear);
        EXPECT_EQ(asc.solid.design->refractive_index, gem.solid.design->refractive_index);
        for (const Facet& facet : asc.solid.facets) {
            double best = 1;
            for (const Facet& other : gem.solid.facets) {
                best = std::min(best, glm::length(facet.plane.normal - other.plane.normal) +
                                          std::abs(facet.plane.offset - other.plane.offset));
            }
            EXPECT_LT(best, 5e-8) << facet.name;
        }
    }
}

TEST(OutsideDesigns, RoundTripAsMeshesAndDesigns) {
    const ScratchFolder scratch;
    const auto designs = designs_in(outside::folder() / "designs");
    ASSERT_FALSE(designs.empty());
    for (const auto& design : designs) {
        SCOPED_TRACE(design.filename());
        const Solid solid = read_cut(design).solid;
        for (const MeshFormat format : {MeshFormat::obj, MeshFormat::off, MeshFormat::ply})
            EXPECT_LT(plane_difference(solid, parse_mesh(mesh_text(solid, format), format).solid),
                      1e-12);
        write_cut(solid, {}, scratch / "a.asc");
        EXPECT_LT(plane_difference(solid, read_cut(scratch / "a.asc").solid), 1e-12);
    }
}

// Two files by others, planar to 5e-6 of the size as their notes say, with these counts.
TEST(OutsideMeshes, HaveTheirFacets) {
    const std::filesystem::path folder = outside::folder() / "meshes";
    struct Case {
        const char* name;
        std::size_t planes, vertices;
    };
    for (const Case& c : {Case{"pc01346.stl", 91, 73}, Case{"simple_example.stl", 18, 32}}) {
        const ReadSolid read = read_mesh(folder / c.name);
        EXPECT_EQ(read.solid.facets.size(), c.planes) << c.name;
        EXPECT_EQ(read.solid.vertices.size(), c.vertices) << c.name;
        EXPECT_TRUE(is_closed(read.solid)) << c.name;
    }
}

// Two polished diamonds with the polyhedra that a scanner's own program found. Its planes must give
// the same counts of vertices, edges and facets, and the stated vertices to 1e-12.
TEST(OutsideScans, HaveTheScannersPolyhedra) {
    const std::filesystem::path folder = outside::folder() / "scans";
    for (const char* name : {"1_GIA", "Pear63"}) {
        SCOPED_TRACE(name);
        std::ifstream file(folder / name / "polyhedron.dat");
        std::stringstream text;
        for (std::string line; std::getline(file, line);) {
            if (line.empty() || line[0] != '#') text << line << '\n';
        }
        std::size_t vertex_count = 0, facet_count = 0, sides = 0;
        text >> vertex_count >> facet_count >> sides;
        std::vector<Vec3> vertices(vertex_count);
        for (Vec3& v : vertices) {
            int index = 0;
            text >> index >> v.x >> v.y >> v.z;
        }
        std::vector<NamedPlane> planes;
        for (std::size_t f = 0; f < facet_count; ++f) {
            int index = 0, corners = 0;
            double d = 0;
            NamedPlane plane;
            Vec3& n = plane.plane.normal;
            text >> index >> corners >> n.x >> n.y >> n.z >> d;
            plane.name = numbered("s", index);
            plane.plane.offset = -d;
            planes.push_back(plane);
            // The corners, and the first one again in brackets.
            std::string word;
            for (int k = 0; k <= corners; ++k) text >> word;
        }
        ASSERT_TRUE(text);
        const HalfSpaceSolid result = intersect_half_spaces(planes);
        EXPECT_EQ(result.solid.vertices.size(), vertex_count);
        EXPECT_EQ(result.solid.facets.size(), facet_count);
        EXPECT_EQ(edge_count(result.solid), static_cast<int>(sides / 2));
        EXPECT_TRUE(is_convex(result.solid));
        for (const Vec3& v : result.solid.vertices) {
            double nearest = 1;
            for (const Vec3& stated : vertices) {
                nearest = std::min(nearest, glm::length(v - stated));
            }
            // Nearly parallel planes amplify the rounding of their coefficients (1e-12).
            EXPECT_LT(nearest, 1e-7);
        }
    }
}

}  // namespace
}  // namespace culet
