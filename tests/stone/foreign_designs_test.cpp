// Meshes and cut designs of other programs. Expectations: the formats' specifications (Wavefront's
// appendix B1, Geomview's manual, Turk's PLY) and GemCad's own files.

#include <gtest/gtest.h>

#include <cmath>

#include "stone/gemcad/gemcad_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/text/errors.h"
#include "tests/says.h"

namespace culet::test {
namespace {

using testing::HasSubstr;

struct ForeignMesh {
    MeshFormat format;
    std::string text;
    const char* error = "";  ///< a part of the message; empty: the tetrahedron is read
};

const std::string k_obj_faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
const std::string k_last_faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

std::string ply_with(const std::string& more, const std::string& corners) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
           "float z\n" +
           more + "element face 4\nproperty list uchar int vertex_indices\nend_header\n" + corners +
           k_last_faces;
}

std::string stl_of(const std::string& loop_end, const std::string& normal = "0 0 0") {
    std::string text;
    for (const char* const corners : {"vertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\n",
                                      "vertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\n",
                                      "vertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\n",
                                      "vertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\n"})
        text += "facet normal " + normal + "\nouter loop\n" + corners + loop_end + "\nendfacet\n";
    return text;
}

TEST(ForeignDesigns, MeshesOfOtherPrograms) {
    const std::string corners = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    const std::string coloured =
        "0 0 0 1 0 0 1 1 1 1\n1 0 0 1 0 0 1 1 1 1\n"
        "0 1 0 1 0 0 1 1 1 1\n0 0 1 1 0 0 1 1 1 1\n";
    const ForeignMesh cases[] = {
        // B1: a backslash continues a line, except in comments and file names.
        {MeshFormat::obj, "v 0 \\\n0 0\nv 1 0 0\nv 0 1 \\ \n0\nv 0 0 1\n" + k_obj_faces},
        {MeshFormat::obj, "# C:\\gems\\\nv 0 0 0\nv 1 0 0 # \\\nv 0 1 0\nv 0 0 1\n" + k_obj_faces},
        {MeshFormat::obj, "mtllib C:\\gems\\\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" + k_obj_faces},
        {MeshFormat::obj, "v\u00a00 0 0\nv 1 0 0\nv 0 1 0\nv \u22120 0 1\n" + k_obj_faces},
        {MeshFormat::obj, "v 0,5 1,5 0,0\n", "decimal comma"},
        {MeshFormat::obj, "v 0.5,1.5,0.0\n", "blanks"},
        {MeshFormat::stl, "solid a\n" + stl_of("endloop") + "endsolid a\n"},
        {MeshFormat::stl, "; by hand\n\n  solid a\n" + stl_of("end loop") + "end solid a\n"},
        {MeshFormat::stl, "solid\n" + stl_of("ENDLOOP", "nan -nan(ind) nan") + "endsolid\n"},
        {MeshFormat::stl, "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0,5 0,5 0\n",
         ":4: '0,5' is not a finite number: it has a decimal comma"},
        // Geomview: [ST][C][N][4][n]OFF; the keyword and the count of edges are optional.
        {MeshFormat::off, "COFF\n4 4 6\n" + coloured + k_last_faces},
        {MeshFormat::off, "NCOFF\n4 4 6\n" + coloured + k_last_faces},
        {MeshFormat::off, "STCNOFF 4 4\n" + corners + k_last_faces},
        {MeshFormat::off, "4 4 0\n" + corners + k_last_faces},
        {MeshFormat::off, "OFF\n4 4 0\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\n", "a line of its own"},
        {MeshFormat::off, "4OFF\n4 4 0\n", "more than three dimensions"},
        // An unused value may be anything; a coordinate may not.
        {MeshFormat::ply,
         ply_with("property float quality\n", "0 0 0 nan\n1 0 0 -nan(ind)\n0 1 0 0\n0 0 1 inf\n")},
        {MeshFormat::ply, ply_with("", "0 0 0\n1 nan 0\n0 1 0\n0 0 1\n"), ":11: 'nan'"},
    };
    for (const ForeignMesh& one : cases) {
        SCOPED_TRACE(one.text);
        try {
            const Solid solid = parse_mesh(one.text, one.format).solid;
            EXPECT_STREQ(one.error, "");
            EXPECT_EQ(solid.facets.size(), 4u);
            EXPECT_NEAR(volume(solid), 1.0 / 6, 1e-15);
        } catch (const InputError& error) {
            ASSERT_STRNE(one.error, "") << error.what();
            EXPECT_THAT(error.what(), HasSubstr(one.error));
        }
    }
}

/// A cube with edges of 2 on a gear of 96; `table` gives the upper face.
std::string cube_with(const std::string& table,
                      const std::string& head = "GemCad 5.0\ng 96 0.0\n") {
    return head + "a 90 1 96 n G 24 48 72\n" + table + "\na -0 1 96 n C\n";
}

TEST(ForeignDesigns, CutDesignsKeepTheirFacetsOrAreRefused) {
    const struct {
        std::string text;
        const char* error = "";  ///< a part of the message; empty: the cube is read
        const char* table = "T";
    } cases[] = {
        {cube_with("a 0 1 96 n T")},
        // A horizontal facet is the same at every index.
        {cube_with("a 0 1"), "", "f0"},
        {cube_with("a 0 1 n T")},
        {cube_with("a 0 1 n T G set the size")},
        {cube_with("a 0 1 G set the size"), "", "f0"},
        {cube_with("a 0 1 n T 96")},
        // An instruction continues in lines that begin with any word.
        {cube_with("a 0 1 96 n T G cut to\na level table\ng and polish\n12 more strokes")},
        {cube_with("; by hand\na 0 1 96 n\nT\n# end of the crown")},
        {cube_with("a 0 1 96 n T", "gemcad 5.0 by some program\n;\ng 96 0.0\n")},
        {cube_with("a 0 1 96 n T\na 30 9"), ":5: the tier at 30 degrees has no index"},
        {cube_with("a 0 1 96 n T\na -30 9 n P"), ":5: "},
        {cube_with("a 0 1 96 n T G polish\n12 24 36"), ":5: "},
        {cube_with("a 0 1 96 n T\na 42 -0.6 96"), ":5: a distance cannot be -0.6"},
        {cube_with("a 0 1 96, n T"), ":4: "},
        {cube_with("a 0 1 96 n T", "GemCad 5.0\np CAM 1\n"), ":2: a preform"},
        {cube_with("a 0 1 96 n T", "GemCad 5.0\ng 96.5 0.0\n"), ":2: a gear cannot have 96.5"},
        {"# GEMCAD design\ngear 96\np 35.26 00\n", ":2: "},
    };
    for (const auto& one : cases) {
        SCOPED_TRACE(one.text);
        try {
            const ReadCut cut = parse_gemcad_asc(one.text);
            EXPECT_STREQ(one.error, "");
            EXPECT_EQ(cut.solid.facets.size(), 6u);
            EXPECT_NEAR(volume(cut.solid), 8, 1e-12);
            EXPECT_GE(find_facet(cut.solid, one.table), 0);
            EXPECT_TRUE(cut.notes.empty());
        } catch (const InputError& error) {
            ASSERT_STRNE(one.error, "") << error.what();
            EXPECT_THAT(error.what(), HasSubstr(one.error));
        }
    }
}

// Eight sides at 1 and two faces at 1: 2 * 8 tan(22.5 degrees), on any gear.
TEST(ForeignDesigns, AGearThatIsNotStatedIsSupposedAndSaid) {
    const struct {
        std::string symmetry, sides;
        double gear;
    } cases[] = {
        {"y 8 y\n", "96 12 24 36 48 60 72 84", 96}, {"", "96 12 24 36 48 60 72 84", 96},
        {"y 8 y\n", "64 8 16 24 32 40 48 56", 64},  {"", "64 8 16 24 32 40 48 56", 64},
        {"y 8 y\n", "80 10 20 30 40 50 60 70", 80},
    };
    for (const auto& one : cases) {
        SCOPED_TRACE(one.symmetry + one.sides);
        const ReadCut cut = parse_gemcad_asc("GemCad 5.0\n" + one.symmetry + "a 90 1 " + one.sides +
                                             "\na 0 1\na -0 1\n");
        EXPECT_TRUE(cut.solid.design->gear_supposed);
        EXPECT_EQ(cut.solid.design->gear, one.gear);
        EXPECT_NEAR(volume(cut.solid), 16 * (std::sqrt(2.0) - 1), 1e-12);
        ASSERT_EQ(cut.notes.size(), 1u);
        EXPECT_THAT(cut.notes[0], says("gear is not stated", std::to_string(int(one.gear))));
    }
    // Sides that repeat on no gear: 96 is assumed, and reported.
    const ReadCut uneven =
        parse_gemcad_asc("GemCad 5.0\na 90 1 96 11 24 35 48 60 72 84\na 0 1\na -0 1\n");
    EXPECT_EQ(uneven.solid.design->gear, 96);
    EXPECT_EQ(uneven.notes.size(), 1u);
    EXPECT_FALSE(parse_gemcad_asc(cube_with("a 0 1")).solid.design->gear_supposed);
}

}  // namespace
}  // namespace culet::test
