// Cut designs through GemCad's and Gem Cut Studio's files: what comes back, and what is said to be
// lost. The designs are made here, each feature at least once; what must come back is what went in.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "stone/design/design_difference.h"
#include "stone/design/proportions.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/mesh/mesh_io.h"
#include "stone/text/errors.h"
#include "stone/text/output_file.h"
#include "tests/scratch_folder.h"
#include "tests/stone/made_designs.h"

namespace culet {
namespace {

using namespace culet::test;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<Made> all_made() {
    return {
        {},
        {.gear = 64},
        {.gear = 77, .folds = 7},
        {.gear = 80, .folds = 5},
        {.gear = 72, .folds = 6},
        {.gear = 120, .folds = 10},
        {.gear = 32, .folds = 4},
        {.gear = 96, .folds = 9},  // indices of thirds of a tooth
        {.gear = 64, .folds = 12},
        {.cheat = 0.25},
        {.gear = 80, .folds = 10, .cheat = 0.4},
        {.twist = 2},
        {.gear = 64, .folds = 4, .twist = 1.5},
        {.culet = true},
        {.crown_first = true},
        {.preform = true},
        {.unnamed = true},
        {.own_names = true, .lost_in_gcs = {"names of"}},
        {.instruction = "Meet P-G, \xe2\x80\x9clevel\xe2\x80\x9d"},
        {.word = "C2_main"},
        {.headings = 4, .footnotes = 4},
        {.headings = 0},
        {.headings = 7, .footnotes = 6, .lost_in_gem = {"headings", "footnotes"}},
        {.gear = -96, .offset = 48, .lost_in_gcs = {"gear"}},
    };
}

double middle(const Solid& solid) {
    double low = INFINITY, high = -INFINITY;
    for (const Vec3& v : solid.vertices) {
        low = std::min(low, v.z);
        high = std::max(high, v.z);
    }
    return (low + high) / 2;
}

// Planes after the scale and height of a .gcs are undone; names only if `by_name`.
void expect_same_planes(const Solid& a, const Solid& b, bool by_name) {
    ASSERT_EQ(a.facets.size(), b.facets.size());
    const double width = proportions(b).width, scale = width / proportions(a).width;
    const double shift = middle(b) - scale * middle(a);
    for (std::size_t f = 0; f < a.facets.size(); ++f) {
        const Plane& own = a.facets[f].plane;
        const double offset = scale * own.offset + shift * own.normal.z;
        double least = INFINITY;
        for (const Facet& other : b.facets) {
            if (by_name && other.name != a.facets[f].name) continue;
            least = std::min(least, std::max(glm::length(other.plane.normal - own.normal),
                                             std::abs(other.plane.offset - offset) / width));
        }
        EXPECT_LT(least, 1e-9) << a.facets[f].name;
    }
}

void expect_same_design(const Design& a, const Design& b) {
    EXPECT_EQ(a.refractive_index, b.refractive_index);
    EXPECT_EQ(a.symmetry, b.symmetry);
    EXPECT_EQ(a.mirror, b.mirror);
    EXPECT_EQ(tier_titles(a), tier_titles(b));
    ASSERT_EQ(a.tiers.size(), b.tiers.size());
    for (std::size_t t = 0; t < a.tiers.size(); ++t) {
        SCOPED_TRACE(tier_titles(a)[t]);
        EXPECT_EQ(a.tiers[t].instruction, b.tiers[t].instruction);
        EXPECT_NEAR(a.tiers[t].setting.angle_deg, b.tiers[t].setting.angle_deg, 1e-6);
        ASSERT_EQ(a.tiers[t].facets.size(), b.tiers[t].facets.size());
        if (a.tiers[t].setting.angle_deg == 0) continue;
        for (std::size_t i = 0; i < a.tiers[t].facets.size(); ++i) {
            const double turned = (a.tiers[t].facets[i].index - a.gear_offset) / a.gear -
                                  (b.tiers[t].facets[i].index - b.gear_offset) / b.gear;
            EXPECT_NEAR(std::remainder(turned, 1.0), 0, 1e-12);
        }
    }
}

std::vector<std::string> written(const Solid& solid, const std::filesystem::path& file) {
    return write_cut(solid, *solid.design, file);
}

TEST(TradeFiles, DesignsComeBackThroughEveryPairOfFormats) {
    const ScratchFolder folder;
    const std::vector<Made> designs = all_made();
    ASSERT_EQ(designs.size(), 24u);
    for (std::size_t d = 0; d < designs.size(); ++d) {
        const Made& made = designs[d];
        const ReadCut cut = parse_gemcad_asc(text_of(made));
        const auto expected = [&](const std::string& format) {
            return format == "gcs"   ? made.lost_in_gcs
                   : format == "gem" ? made.lost_in_gem
                                     : std::vector<const char*>();
        };
        for (const std::string first : {"asc", "gem", "gcs"}) {
            for (const std::string second : {"asc", "gem", "gcs"}) {
                SCOPED_TRACE(fmt::format("design {} by .{} and .{}", d, first, second));
                std::vector<std::string> notes = written(cut.solid, folder / ("a." + first));
                EXPECT_EQ(notes.size(), expected(first).size()) << testing::PrintToString(notes);
                for (const char* piece : expected(first))
                    EXPECT_THAT(notes, Contains(HasSubstr(piece)));
                const Solid once = read_cut(folder / ("a." + first)).solid;
                notes = written(once, folder / ("b." + second));
                // What is lost at the first file is not lost again.
                const std::size_t more = first == second ? 0 : expected(second).size();
                EXPECT_LE(notes.size(), more) << testing::PrintToString(notes);
                written(read_cut(folder / ("b." + second)).solid, folder / "c.asc");
                const Solid back = read_cut(folder / "c.asc").solid;
                const bool by_gcs = first == "gcs" || second == "gcs";
                const bool by_gem = first == "gem" || second == "gem";
                expect_same_planes(cut.solid, back, !by_gcs || !made.own_names);
                expect_same_design(*cut.solid.design, *back.design);
                if (!by_gcs || made.gear > 0) {
                    EXPECT_EQ(back.design->gear, cut.solid.design->gear);
                    EXPECT_EQ(back.design->gear_offset, cut.solid.design->gear_offset);
                }
                if (by_gem && !made.lost_in_gem.empty()) continue;
                EXPECT_EQ(back.design->headings, cut.solid.design->headings);
                EXPECT_EQ(back.design->footnotes, cut.solid.design->footnotes);
            }
        }
    }
}

// Two directions as Gem Cut Studio 1.1 saves them, crown and pavilion, and its description: polar
// angles, normals, distances from the origin. Index 12 of 96 is 45 degrees; the pavilion counts the
// other way.
const char* const k_gcs =
    "<GemCutStudio version=\"1000\">\r\n"
    "<!-- by hand --><index gear=\"96\" base=\"3\" symmetry=\"1\" mirror=\"2\"/>\r\n"
    "<tier angle=\"127\" depth=\"0.9\" name=\"P\" instructions=\"Meet &lt;TCP&gt; &#233;\">\r\n"
    "<facet nx=\"-0.564720584850818\" ny=\"-0.564720584850818\" nz=\"-0.601815023152048\" "
    "index_angle=\"45\"/>\r\n"
    "<facet index_angle=\"135\"/><facet index_angle=\"225\"/><facet "
    "index_angle=\"315\"/></tier>\r\n"
    "<tier angle=\"28\" depth=\"1.1\" name=\"Star1\" frosting=\"0.5\">\r\n"
    "<facet nx=\"0.331966525620149\" ny=\"-0.331966525620149\" nz=\"0.882947592858927\" "
    "index_angle=\"45\"/>\r\n"
    "<facet index_angle=\"135\"/><facet index_angle=\"225\"/><facet "
    "index_angle=\"315\"/></tier>\r\n"
    "<tier angle=\"0\" name=\"T\"><facet nx=\"0\" ny=\"0\" nz=\"1\">\r\n"
    "<vertex x=\"0\" y=\"0\" z=\"0.9\"/></facet></tier>\r\n"
    "<tier angle=\"20\" depth=\"0.2\" name=\"H\" visible=\"false\" guide=\"true\">\r\n"
    "<facet index_angle=\"90\"/></tier>\r\n"
    "<render material=\"176 Corundum\" refractive_index=\"1.76\" clarity=\"100\">\r\n"
    "<color r=\"0.5\" g=\"0.5\" b=\"1\"/></render>\r\n"
    "<info title=\"By hand\" date=\"today\r\n\r\n\" footer1=\"A &amp; B\" shape=\"Square\"/>\r\n"
    "</GemCutStudio>\r\n";

TEST(TradeFiles, GcsIsReadByItsDescription) {
    const ReadCut cut = parse_gcs(k_gcs);
    const Design& design = *cut.solid.design;
    EXPECT_EQ(design.gear, 96);
    EXPECT_EQ(design.refractive_index, 1.76);
    EXPECT_THAT(design.headings, ElementsAre("By hand", "", "today"));
    EXPECT_THAT(design.footnotes, ElementsAre("A & B"));
    ASSERT_EQ(design.tiers.size(), 4u);
    EXPECT_EQ(cut.solid.facets.size(), 9u);
    const auto indices = [&](std::size_t t) {
        std::vector<double> all;
        for (const DesignFacet& facet : design.tiers[t].facets) all.push_back(facet.index);
        return all;
    };
    EXPECT_THAT(indices(0), ElementsAre(84, 60, 36, 12));
    EXPECT_THAT(indices(1), ElementsAre(12, 36, 60, 84));
    EXPECT_EQ(design.tiers[0].setting.angle_deg, 53);
    EXPECT_TRUE(design.tiers[0].setting.pavilion);
    EXPECT_EQ(design.tiers[0].instruction, "Meet <TCP> \xc3\xa9");
    EXPECT_EQ(design.tiers[1].frosting, 0.5);
    EXPECT_EQ(design.tiers[2].setting.distance, 0.9);
    EXPECT_TRUE(design.tiers[3].hidden && design.tiers[3].guide);
    // A drawn square stone has the four-fold axis and its mirrors.
    EXPECT_EQ(design.symmetry, 4);
    EXPECT_TRUE(design.mirror);
    EXPECT_THAT(cut.notes,
                ElementsAre(HasSubstr("frosted: Star1"), HasSubstr("the file hides them: H")));
}

// Its own file keeps all; a mesh too, which a fitted stone is; GemCad's files lack places for it.
TEST(TradeFiles, WhatOnlyGcsHoldsIsKeptOrNamed) {
    const ScratchFolder folder;
    const Solid solid = parse_gcs(k_gcs).solid;
    EXPECT_THAT(written(solid, folder / "a.gcs"), IsEmpty());
    write_mesh(solid, folder / "a.obj");
    written(read_mesh(folder / "a.obj").solid, folder / "b.gcs");
    for (const char* file : {"a.gcs", "b.gcs"}) {
        const Solid back = read_cut(folder / file).solid;
        expect_same_planes(solid, back, true);
        EXPECT_THAT(design_differences(solid, back), IsEmpty());
        EXPECT_EQ(back.design->studio, solid.design->studio);
        EXPECT_EQ(back.design->tiers[1].frosting, 0.5);
        EXPECT_TRUE(back.design->tiers[3].hidden && back.design->tiers[3].guide);
    }
    for (const char* file : {"a.asc", "a.gem"}) {
        SCOPED_TRACE(file);
        const std::vector<std::string> notes = written(solid, folder / file);
        for (const char* piece :
             {"frosted 0.5, then polished", "H: tier: ", "material: 176 Corundum, then none",
              "render.clarity 100", "info.shape Square", "color.b 1"})
            EXPECT_THAT(notes, Contains(HasSubstr(piece)));
        expect_same_planes(solid, read_cut(folder / file).solid, false);
    }
    std::string text = k_gcs;
    text.replace(text.find("Star1"), 5, "Star 1");
    EXPECT_THAT(written(parse_gcs(text).solid, folder / "b.asc"),
                Contains(HasSubstr("Star 1 is Star_1")));
    EXPECT_THAT(written(parse_gcs(text).solid, folder / "b.gcs"), IsEmpty());
}

// Corners are facts for other readers: on their planes, and of the size that Gem Cut Studio gives
// every stone.
TEST(TradeFiles, WrittenGcsFillsItsSquare) {
    const ScratchFolder folder;
    const Solid solid = parse_gemcad_asc(text_of({.gear = 77, .folds = 7})).solid;
    written(solid, folder / "a.gcs");
    const std::string text = read_text(folder / "a.gcs");
    EXPECT_TRUE(std::all_of(text.begin(), text.end(), [](char c) { return c > 0; }));
    double reach = 0, low = 0, high = 0;
    const auto value = [&](std::size_t from, const char* key) {
        return std::stod(text.substr(text.find(key, from) + std::string(key).size()));
    };
    std::size_t corners = 0;
    for (std::size_t at = text.find("<vertex"); at != std::string::npos;
         at = text.find("<vertex", at + 1), ++corners) {
        reach = std::max({reach, std::abs(value(at, "x=\"")), std::abs(value(at, "y=\""))});
        low = std::min(low, value(at, "z=\""));
        high = std::max(high, value(at, "z=\""));
    }
    std::size_t all = 0;
    for (const Facet& facet : solid.facets) all += facet.corners.size();
    EXPECT_EQ(corners, all);
    EXPECT_NEAR(reach, 1, 1e-12);
    EXPECT_NEAR(low + high, 0, 1e-12);
    EXPECT_THAT(parse_gcs(text).notes, IsEmpty());
}

TEST(TradeFiles, BrokenGcsIsOneClearLine) {
    const auto message = [](const std::string& text) -> std::string {
        try {
            parse_gcs(text, {}, "a.gcs");
        } catch (const InputError& error) {
            return error.what();
        }
        return "was read";
    };
    const auto with = [](const std::string& old, const std::string& now) {
        std::string text = k_gcs;
        text.replace(text.find(old), old.size(), now);
        return text;
    };
    EXPECT_THAT(message(""), HasSubstr("is empty"));
    EXPECT_THAT(message("<a/>"), HasSubstr("found <a"));
    EXPECT_THAT(message(std::string(k_gcs).substr(0, 300)), HasSubstr("a.gcs:"));
    EXPECT_THAT(message("<!DOCTYPE a [<!ENTITY b \"c\">]>" + std::string(k_gcs)),
                HasSubstr("document type"));
    EXPECT_THAT(message(with("gear=\"96\"", "gear=\"9.5\"")), HasSubstr("a.gcs:2: gives no gear"));
    EXPECT_THAT(message(with("angle=\"127\"", "angle=\"227\"")), HasSubstr("a.gcs:3: "));
    EXPECT_THAT(message(with("nx=\"-0.564720584850818\"", "nx=\"nan\"")), HasSubstr("a.gcs:4: nx"));
    EXPECT_THAT(message(with("depth=\"0.9\"", "")), HasSubstr("neither the tier's depth"));
    // Its published files hold flat tiers alone: any word for a curved one is refused.
    const std::string curved = with("name=\"Star1\"", "name=\"Star1\" cylinder_radius=\"0.4\"");
    EXPECT_THAT(message(curved),
                HasSubstr("a.gcs:6: tier 'Star1' is not flat "
                          "(cylinder_radius=\"0.4\"), and culet cuts flat facets"));
    EXPECT_THAT(
        message(with("<facet index_angle=\"90\"/>", "<concave/><facet index_angle=\"90\"/>")),
        HasSubstr("was read"));  // that tier is hidden
    EXPECT_THAT(parse_gcs(with("name=\"Star1\"", "name=\"Star1\" radius=\"0\" lap=\"8k\"")).notes,
                Contains("not read, because unknown: radius of <tier>, lap of <tier>"));
    std::string deep = "<GemCutStudio><index gear=\"96\"/>";
    for (int i = 0; i < 1000000; ++i) deep += "<a>";
    EXPECT_THAT(message(deep), HasSubstr("is not well-formed XML"));
    std::string many = "<GemCutStudio><index gear=\"96\"/><tier angle=\"50\" depth=\"1\">";
    for (int i = 0; i < 6000; ++i) many += fmt::format("<facet index_angle=\"{}\"/>", i * 0.06);
    EXPECT_THAT(message(many + "</tier></GemCutStudio>"), HasSubstr("6000"));
}

}  // namespace
}  // namespace culet
