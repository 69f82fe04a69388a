#include "stone/design/design.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "stone/cuts/cuts.h"
#include "stone/design/cutting_list.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/text/output_file.h"
#include "tests/scratch_folder.h"

namespace culet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A meetpoint sequence that alternates between pavilion and girdle, with the author's words, a tier
// that is cut away again (0), and names and lines as GemCad writes them. Distances of 2 give the
// square stone's meets: the mains' lowest edge is level with the girdle's, half as high as it is
// far out.
const char* const k_design =
    "GemCad 5.0\n"
    "g 96 0.0\n"
    "y 4 y\n"
    "I 1.76\n"
    "H A square\n"
    "H by nobody\n"
    "a -60 9 96 n 0 24 48 72 G Preform, cut away\n"
    "a -45 1.4142135623730951 96 n P1 24 n P1 48 72 G TCP\n"
    "a -90 1 96 n G1 24 48 72 G Level girdle\n"
    "a -90 1.3 12 n G2 36 60 84 G Size the corners\n"
    "a 30 0.9 96 n A 24 48 72 G Leave #4 frosted  (optional)\n"
    "a 0 0.5 96 n T\n"
    "F polish with oxide\n";

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::size_t at = 0;
    for (std::size_t end = text.find('\n'); end != std::string::npos;
         at = end + 1, end = text.find('\n', at))
        lines.push_back(text.substr(at, end - at));
    return lines;
}

TEST(Design, KeepsEveryLineThroughItsFile) {
    const ScratchFolder folder;
    const ReadCut cut = parse_gemcad_asc(k_design);
    write_cut(cut.solid, *cut.solid.design, folder / "a.asc");
    const std::string text = read_text(folder / "a.asc");
    // Numbers have only the digits that they need; all words stay as they were.
    for (const char* part :
         {"I 1.76\n", "H by nobody\n", "F polish with oxide\n",
          "96 n 0 24 48 72 G Preform, cut away\n", "96 n P1 24 n P1 48 72 G TCP\n",
          "96 n G1 24 48 72 G Level girdle\n", "12 n G2 36 60 84 G Size the corners\n",
          "G Leave #4 frosted  (optional)\n"}) {
        EXPECT_THAT(text, HasSubstr(part));
    }
    EXPECT_EQ(lines_of(text).size(), lines_of(k_design).size());
    const ReadCut again = read_cut(folder / "a.asc");
    write_cut(again.solid, *again.solid.design, folder / "b.asc");
    EXPECT_EQ(read_text(folder / "b.asc"), text);
}

TEST(Design, IsKeptByAMeshAndFoundByTheNamesOfFacets) {
    const ScratchFolder folder;
    const ReadCut cut = parse_gemcad_asc(k_design);
    for (const char* file : {"a.obj", "a.ply", "a.off"}) {
        SCOPED_TRACE(file);
        write_mesh(cut.solid, folder / file);
        const Solid solid = read_mesh(folder / file).solid;
        ASSERT_TRUE(solid.design);
        EXPECT_EQ(solid.design->tiers.size(), cut.solid.design->tiers.size());
        EXPECT_EQ(solid.design->refractive_index, cut.solid.design->refractive_index);
        const std::vector<DesignPlace> places = places_of(solid), were = places_of(cut.solid);
        for (std::size_t f = 0; f < places.size(); ++f) {
            const int same = find_facet(cut.solid, solid.facets[f].name);
            ASSERT_GE(same, 0);
            EXPECT_EQ(places[f].tier, were[std::size_t(same)].tier);
        }
    }
}

// Only one facet of a tier is labelled, and some tiers are not: culet's own facet names do not
// become labels on the way through a mesh.
TEST(Design, HasNoOtherLabelsAfterAMesh) {
    const ScratchFolder folder;
    std::string text = k_design;
    text.replace(text.find(" n G2"), 5, "");
    text.replace(text.find(" n T"), 4, "");
    const ReadCut cut = parse_gemcad_asc(text);
    const auto labels = [](const Design& design) {
        std::vector<std::string> all;
        for (const DesignTier& tier : design.tiers) {
            for (const DesignFacet& facet : tier.facets) {
                if (!facet.facet.empty()) all.push_back(facet.label + " " + facet.facet);
            }
        }
        return all;
    };
    ASSERT_THAT(labels(*cut.solid.design), testing::Contains(testing::StartsWith(" ")));
    write_mesh(cut.solid, folder / "a.obj");
    const Solid solid = read_mesh(folder / "a.obj").solid;
    EXPECT_EQ(labels(*solid.design), labels(*cut.solid.design));
    write_cut(cut.solid, *cut.solid.design, folder / "a.asc");
    write_cut(solid, *solid.design, folder / "b.asc");
    EXPECT_EQ(labels(*read_cut(folder / "b.asc").solid.design),
              labels(*read_cut(folder / "a.asc").solid.design));
}

TEST(Design, IsCutInItsAuthorsOrderAndWords) {
    const ReadCut cut = parse_gemcad_asc(k_design);
    std::vector<std::string> tiers, words;
    for (const CuttingStep& step : cutting_list(cut.solid)) {
        tiers.push_back(step.tier);
        words.push_back(depth_words(step, "mm", 1));
    }
    EXPECT_THAT(tiers, ElementsAre("0", "P1", "G1", "G2", "A", "T"));
    EXPECT_EQ(words[0], "Preform, cut away; cut away later");
    // Planes at 45 degrees and sqrt 2 from the middle meet the axis 2 below it; the girdle's
    // planes, 1 away, meet them 1 below it, so 1 over the point. Opposite faces are 2 and 2.6
    // apart.
    EXPECT_EQ(words[1], "TCP; centre point 1.00 mm from the girdle");
    EXPECT_EQ(words[2], "Level girdle; width 2.00 mm");
    EXPECT_EQ(words[3], "Size the corners; width 2.60 mm");
    EXPECT_THAT(words[4], HasSubstr("Leave #4 frosted  (optional); leave "));
}

// A tier splits where its facets were cut at different angles: each angle is shown beside its
// tooth.
TEST(Design, OfAFittedStoneHasWholeTeethAndOwnAngles) {
    const ScratchFolder folder;
    Solid solid = parse_gemcad_asc(k_design).solid;
    const Design& design = *solid.design;
    std::vector<NamedPlane> planes;
    for (const Facet& facet : solid.facets) {
        CutSetting cut = setting_of(facet.plane, design);
        // The whole stone is turned by a tenth of a tooth, which is not a fault.
        cut.index += 0.1;
        if (facet.name == "A.1") cut.angle_deg += 0.4;
        if (facet.name == "A.2") cut.index += 0.4;
        planes.push_back({facet.name, plane_of(cut, design)});
    }
    Solid fitted = intersect_half_spaces(planes).solid;
    fitted.design = solid.design;
    const auto a_words = [](const Solid& of) {
        for (const CuttingStep& step : cutting_list(of)) {
            if (step.tier == "A") return index_words(step) + "; " + printed_indices(step, 96);
        }
        return std::string();
    };
    EXPECT_EQ(a_words(fitted),
              "24 at 30.4, 72 96, 48 (cheater +0.40); 96, 24 at 30.4, 72, 48 (cheater +0.40)");
    // Written as a design it needs a line per facet; read back it is one tier again.
    write_cut(fitted, design, folder / "fitted.asc");
    const Solid again = read_cut(folder / "fitted.asc").solid;
    EXPECT_EQ(tier_titles(*again.design), tier_titles(design));
}

TEST(Design, OfAStandardCutHasItsTiers) {
    // Tiers of a brilliant in the trade: lower halves, mains, girdle, upper halves, mains, stars,
    // table. On a wheel of 96 every setting is an integer.
    const Solid solid = make_cut("round-brilliant");
    const Design design = drawn_design(solid);
    EXPECT_THAT(tier_titles(design), ElementsAre("L", "P", "G", "U", "C", "S", "T"));
    EXPECT_EQ(design.symmetry, 8);
    EXPECT_TRUE(design.mirror);
    for (const DesignTier& tier : design.tiers) {
        for (const DesignFacet& facet : tier.facets)
            EXPECT_EQ(facet.index, std::round(facet.index)) << facet.label;
    }
    EXPECT_EQ(facet_count_words(solid), "57 + 16");
    // An oval's halves have four angles: four tiers, each named after its first facet.
    const std::vector<std::string> oval = tier_titles(drawn_design(make_cut("oval")));
    EXPECT_EQ(std::set<std::string>(oval.begin(), oval.end()).size(), oval.size());
}

}  // namespace
}  // namespace culet
