// What is written reads back: planes, counts, names.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "stone/cuts/cuts.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/solid/checks.h"
#include "stone/stone.h"
#include "tests/scratch_folder.h"
#include "tests/stone/synthetic_solids.h"

namespace culet {
namespace {

using namespace culet::test;

double nearest_plane_difference(const Solid& a, const Solid& b) {
    const double size = diameter(a);
    double worst = 0;
    for (const Facet& facet : a.facets) {
        double best = INFINITY;
        for (const Facet& other : b.facets) {
            best =
                std::min(best, std::max(glm::length(facet.plane.normal - other.plane.normal),
                                        std::abs(facet.plane.offset - other.plane.offset) / size));
        }
        worst = std::max(worst, best);
    }
    return worst;
}

void expect_round_trips(const Solid& solid) {
    const ScratchFolder folder;
    for (const char* extension : {".obj", ".off", ".ply", ".stl", ".asc", ".gem"}) {
        SCOPED_TRACE(extension);
        const auto file = folder / (std::string("solid").append(extension));
        write_solid(solid, file);
        const SolidFile read = read_solid(file);
        EXPECT_EQ(read.solid.facets.size(), solid.facets.size());
        EXPECT_EQ(read.solid.vertices.size(), solid.vertices.size());
        EXPECT_EQ(edge_count(read.solid), edge_count(solid));
        EXPECT_TRUE(is_closed(read.solid));
        EXPECT_TRUE(is_convex(read.solid));
        const bool is_stl = std::string(extension) == ".stl";
        if (is_stl) {
            // Without offsets: as precise as corners at near-miss meets allow.
            const double limit = 1e-6 + planarity(solid) / diameter(solid);
            EXPECT_LT(nearest_plane_difference(solid, read.solid), limit);
        } else {
            EXPECT_LT(plane_difference(solid, read.solid), 1e-12);
        }
        const auto again = folder / (std::string("again").append(extension));
        write_solid(read.solid, again);
        EXPECT_EQ(plane_difference(read.solid, read_solid(again).solid) > 1e-12, false);
    }
}

TEST(RoundTrip, CommittedDesigns) {
    const auto designs = committed_designs();
    ASSERT_FALSE(designs.empty());
    for (const auto& design : designs) {
        SCOPED_TRACE(design.filename());
        expect_round_trips(read_solid(design).solid);
    }
}

TEST(RoundTrip, CutsOfTheCatalogue) {
    for (const CutKind& kind : cut_kinds()) {
        SCOPED_TRACE(kind.name);
        const Solid cut = make_cut(kind.name);
        if (is_convex(cut)) expect_round_trips(cut);  // no design can hold a heart
    }
}

TEST(RoundTrip, RandomSolids) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        // Joined, as the corners of a design are when it is read from .asc.
        Solid solid = random_solid(10 + 9 * static_cast<int>(seed), seed);
        const double width = std::min(width_along(solid, {1, 0, 0}), width_along(solid, {0, 1, 0}));
        solid = contract_near_meets(solid, 3e-4 * width).solid;
        expect_round_trips(solid);
    }
}

TEST(RoundTrip, MeshFormatsKeepTurnedTinyHugeAndDistantSolids) {
    const Solid solid = random_solid(50, 21);
    for (const double scale : {1e-9, 1.0, 1e9}) {
        for (const double distance : {0.0, 100.0, 1e5}) {
            SCOPED_TRACE(testing::Message() << "scale " << scale << " distance " << distance);
            const Solid other = moved(solid, scale, scale * distance * Vec3(1, -2, 0.5));
            for (const MeshFormat format :
                 {MeshFormat::obj, MeshFormat::off, MeshFormat::ply, MeshFormat::stl}) {
                const Solid read = parse_mesh(mesh_text(other, format), format).solid;
                EXPECT_EQ(read.facets.size(), other.facets.size());
                EXPECT_EQ(read.vertices.size(), other.vertices.size());
                EXPECT_LT(nearest_plane_difference(other, read), 1e-6);
                EXPECT_TRUE(is_convex(read));
                if (format != MeshFormat::stl) {
                    EXPECT_EQ(plane_difference(other, read), 0);
                }
            }
        }
    }
}

TEST(RoundTrip, InsideOutIsTurnedRound) {
    const Solid outside_out = random_solid(30, 2);
    const Solid solid = turned_inside_out(outside_out);
    for (const MeshFormat format :
         {MeshFormat::obj, MeshFormat::off, MeshFormat::ply, MeshFormat::stl}) {
        const ReadSolid read = parse_mesh(mesh_text(solid, format), format);
        EXPECT_NEAR(volume(read.solid), volume(outside_out), 1e-12 * volume(outside_out));
        EXPECT_TRUE(find_faults(read.solid, {.planarity = 1e-9, .must_be_convex = true}).empty());
        EXPECT_FALSE(read.notes.empty()) << "it is said";
    }
}

TEST(RoundTrip, NamesWithBlanksAndSigns) {
    Solid solid = cube();
    const char* names[6] = {"Star 1", "C#1", "a  b", "50%", "main/break", "f3"};
    for (int i = 0; i < 6; ++i) solid.facets[i].name = names[i];
    for (const MeshFormat format : {MeshFormat::obj, MeshFormat::off, MeshFormat::ply}) {
        const Solid read = parse_mesh(mesh_text(solid, format), format).solid;
        for (int i = 0; i < 6; ++i) EXPECT_EQ(read.facets[i].name, names[i]);
    }
    const ScratchFolder folder;
    write_solid(solid, folder / "a.asc");
    const Solid read = read_solid(folder / "a.asc").solid;
    EXPECT_GE(find_facet(read, "Star_1"), 0);
    EXPECT_GE(find_facet(read, "a__b"), 0);
    EXPECT_GE(find_facet(read, "main/break"), 0);
}

TEST(RoundTrip, NamesThatWouldBreakAFileAreMangled) {
    Solid solid = cube();
    const char* names[6] = {"a\nf 1 2 3", "#x", "ends\\", " padded ", "", "tab\there"};
    for (int i = 0; i < 6; ++i) solid.facets[i].name = names[i];
    for (const MeshFormat format : {MeshFormat::obj, MeshFormat::off, MeshFormat::ply}) {
        const Solid read = parse_mesh(mesh_text(solid, format), format).solid;
        ASSERT_EQ(read.facets.size(), 6u);
        EXPECT_EQ(read.facets[0].name, "a_f 1 2 3");
        EXPECT_EQ(read.facets[1].name, "_x");
        EXPECT_EQ(read.facets[2].name, "ends_");
        EXPECT_EQ(read.facets[3].name, "padded");
        EXPECT_EQ(read.facets[4].name, "f0");
        EXPECT_EQ(read.facets[5].name, "tab_here");
    }
}

// After a user moves a vertex, the planes noted in the file must not apply.
TEST(RoundTrip, EditedMeshForgetsItsNotedPlanes) {
    const Solid solid = cube();
    for (const MeshFormat format : {MeshFormat::obj, MeshFormat::off, MeshFormat::ply}) {
        std::string text = mesh_text(solid, format);
        // Stretches slightly in z: every `1` that ends a vertex line.
        Solid stretched = solid;
        for (Vec3& v : stretched.vertices) v.z *= 1.0001;
        const std::string other = mesh_text(stretched, format);
        // The comments of one file with the body of the other.
        const std::size_t last = text.rfind("culet plane");
        const std::size_t cut = text.find('\n', last) + 1;
        const std::size_t body = other.find('\n', other.rfind("culet plane")) + 1;
        const ReadSolid read = parse_mesh(text.substr(0, cut) + other.substr(body), format);
        EXPECT_NEAR(read.solid.facets[4].plane.offset, 1.0001, 1e-12);
        EXPECT_EQ(read.solid.facets[4].name, "pz");
        EXPECT_FALSE(read.notes.empty());
    }
}

// Noted planes without a hash count when they agree with the corners to 1e-3.
TEST(RoundTrip, NotedPlanesWithoutAHash) {
    Solid solid = cube();
    for (const double off : {1e-4, 1e-2}) {
        solid.facets[4].plane.offset = 1 + off;
        std::string text = mesh_text(solid, MeshFormat::obj);
        text.erase(0, text.find('\n') + 1);
        const ReadSolid read = parse_mesh(text, MeshFormat::obj);
        EXPECT_EQ(read.solid.facets[4].plane.offset, off < 1e-3 ? 1 + off : 1.0);
    }
}

TEST(RoundTrip, AscOfAStoneAwayFromTheOriginIsMovedAndSaysSo) {
    const Solid solid = moved(random_solid(30, 3), 1, {10, 0, 0}, false);
    const ScratchFolder folder;
    EXPECT_EQ(write_cut(solid, {}, folder / "a.asc").size(), 1u);
    const ReadCut read = read_cut(folder / "a.asc");
    EXPECT_NEAR(volume(read.solid), volume(solid), 1e-9);
    ASSERT_EQ(read.solid.design->footnotes.size(), 1u);
    EXPECT_EQ(read.solid.design->footnotes[0].substr(0, 8), "moved by");
}

}  // namespace
}  // namespace culet
