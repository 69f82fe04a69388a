#include "stone/design/tiers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "stone/cuts/cuts.h"
#include "stone/design/cutting_list.h"
#include "stone/gemcad/gemcad_io.h"
#include "stone/solid/caliper.h"
#include "stone/stone.h"
#include "stone/text/output_file.h"
#include "stone/text/written_number.h"
#include "tests/scratch_folder.h"

namespace culet {
namespace {

using Names = std::vector<std::string>;

const Vec3 k_up{0, 0, 1};
const std::string k_head = "GemCad 5.0\ng 96 0.0\ny 4 n\nI 1.54\n";
const std::string k_crown = "a 40 0.9 96 n A 24 48 72\n";
const std::string k_rest = "a -90 1.0 96 n G 24 48 72\na -41 0.9 96 n 1 24 48 72\na 0 0.5 96 n T\n";

Names names_of(const Solid& solid, std::size_t count) {
    Names names;
    for (std::size_t f = 0; f < count; ++f) names.push_back(solid.facets[f].name);
    return names;
}

// A tier's single name applies to all its facets, wherever it stands.
TEST(GemCadTiers, NameGoesToAllFacets) {
    EXPECT_EQ(names_of(parse_gemcad_asc(k_head + k_crown + k_rest).solid, 5),
              (Names{"A", "A.1", "A.2", "A.3", "G"}));
    const auto crown = [&](const std::string& line) {
        return names_of(parse_gemcad_asc(k_head + line + k_rest).solid, 4);
    };
    EXPECT_EQ(crown("a 40 0.9 96 24 48 n A 72\n"), (Names{"A.1", "A.2", "A", "A.3"}));
    EXPECT_EQ(crown("a 40 0.9 96 24 48 n A 72 n A\n"), (Names{"A.2", "A.3", "A", "A.1"}));
    EXPECT_EQ(crown("a 40 0.9 96 n A 24 48 n B 72\n"), (Names{"A", "f0", "B", "f1"}));
    EXPECT_EQ(crown("a 40 0.9 96 24 48 72\n"), (Names{"f0", "f1", "f2", "f3"}));
    // Two tiers with one name: the numbers continue.
    EXPECT_EQ(names_of(parse_gemcad_asc(k_head + "a 40 0.9 96 n G 24 48 72\n" + k_rest).solid, 8),
              (Names{"G", "G.2", "G.3", "G.4", "G.1", "G.5", "G.6", "G.7"}));
}

TEST(GemCadTiers, GoThereAndBack) {
    const test::ScratchFolder folder;
    for (const std::string& crown : {k_crown, std::string("a 40 0.9 96 24 48 n A 72\n"),
                                     std::string("a 40 0.9 96 n G 24 48 72\n"),
                                     std::string("a 40 0.9 96 n A 24 n A.5 48 72 n B\n"),
                                     std::string("a 40 0.9 96 24 48 72\n")}) {
        const Solid solid = parse_gemcad_asc(k_head + crown + k_rest).solid;
        const Names names = names_of(solid, solid.facets.size());
        Solid at = solid;
        for (const char* file : {"a.asc", "b.obj", "c.asc", "d.ply", "e.asc"}) {
            write_solid(at, folder / file);
            at = read_solid(folder / file).solid;
            EXPECT_EQ(names_of(at, at.facets.size()), names) << crown << file;
        }
    }
    // As GemCad writes it: one name per tier.
    write_solid(parse_gemcad_asc(k_head + k_crown + k_rest).solid, folder / "a.asc");
    const std::string text = read_text(folder / "a.asc");
    EXPECT_NE(text.find(" 96 n A 24 48 72\n"), std::string::npos) << text;
    write_solid(parse_gemcad_asc(k_head + "a 40 0.9 96 24 48 n A 72\n" + k_rest).solid,
                folder / "b.asc");
    EXPECT_NE(read_text(folder / "b.asc").find(" 96 24 48 n A 72\n"), std::string::npos);
    EXPECT_TRUE(read_solid(folder / "a.asc").facets_are_whole);
}

TEST(Patterns, MeanTiersOrAnything) {
    EXPECT_TRUE(name_matches("C*", "C1"));
    EXPECT_TRUE(name_matches("*", ""));
    EXPECT_FALSE(name_matches("C*", "U1"));
    EXPECT_TRUE(name_matches("1.*", "1"));
    EXPECT_TRUE(name_matches("1.*", "1.12"));
    EXPECT_FALSE(name_matches("1.*", "11"));
    EXPECT_FALSE(name_matches("1.*", "11.1"));
}

TEST(Tiers, OfStandardCutsAreTheTrades) {
    const Solid solid = make_cut("round-brilliant");
    std::map<std::string, std::size_t> sizes;
    for (const FacetTier& tier : tiers_of(solid, k_up)) sizes[tier.pattern] = tier.facets.size();
    EXPECT_EQ(sizes,
              (std::map<std::string, std::size_t>{
                  {"", 1}, {"S*", 8}, {"C*", 8}, {"U*", 16}, {"G*", 16}, {"L*", 16}, {"P*", 8}}));
    for (const bool crown : {true, false}) {
        const auto mains = main_facets(solid, k_up, crown);
        ASSERT_EQ(mains.size(), 8u);
        for (const int f : mains) {
            EXPECT_EQ(solid.facets[std::size_t(f)].name[0], crown ? 'C' : 'P');
        }
    }
    // A culet facet ends the mains as the point does.
    EXPECT_EQ(main_facets(make_cut("round-brilliant", {{"culet", 3}}), k_up, false).size(), 8u);
    // A step cut has no facet that reaches from girdle to table: the largest tier stands for them.
    const Solid step = make_cut("step");
    std::size_t first_steps = 0, girdles = 0;
    for (const FacetTier& tier : tiers_of(step, k_up)) first_steps += tier.pattern == "C1*" ? 1 : 0;
    for (const FacetTier& tier : tiers_of(step, k_up)) girdles += tier.pattern == "G*" ? 1 : 0;
    EXPECT_EQ(first_steps, 1u);
    EXPECT_EQ(girdles, 1u);
    EXPECT_EQ(main_facets(step, k_up, true).size(), 8u);
}

std::set<std::vector<int>> facets_of(const std::vector<FacetTier>& tiers) {
    std::set<std::vector<int>> all;
    for (const FacetTier& tier : tiers) all.insert(tier.facets);
    return all;
}

void number_the_facets(Solid& solid) {
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        solid.facets[f].name = "F" + std::to_string(f);
    }
}

// As drawn by hand: each coordinate of each corner is randomly off by `off`.
Solid drawn_by_hand(Solid solid, double off, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, off);
    for (Vec3& v : solid.vertices) v += Vec3{normal(random), normal(random), normal(random)};
    for (Facet& facet : solid.facets) {
        std::vector<Vec3> loop;
        for (const int c : facet.corners) loop.push_back(solid.vertices[std::size_t(c)]);
        facet.plane = plane_through(loop);
    }
    return solid;
}

// An oval's stars have two angles: two tiers of four with a common name.
TEST(Tiers, OfOneNameAreToldApartByTheDrawing) {
    for (const double off : {0.0, 0.01}) {
        const Solid solid = drawn_by_hand(make_cut("oval"), off, 1);
        std::vector<std::size_t> sizes;
        for (const FacetTier& tier : tiers_of(solid, k_up)) {
            if (tier.name == "S") sizes.push_back(tier.facets.size());
        }
        EXPECT_EQ(sizes, (std::vector<std::size_t>{4, 4})) << off;
    }
}

// The same sets of facets whatever an exporter calls them, and drawn by hand: 2 % of 6.5 mm.
TEST(Tiers, AreTheFormsWhateverTheFacetsAreCalled) {
    const Solid cut = make_cut("round-brilliant");
    const auto tiers = facets_of(tiers_of(cut, k_up));
    for (const double off : {0.0, 0.13}) {
        Solid solid = drawn_by_hand(cut, off, 2);
        EXPECT_EQ(facets_of(tiers_of(solid, k_up)), tiers) << off;
        number_the_facets(solid);
        EXPECT_EQ(facets_of(tiers_of(solid, k_up)), tiers) << off;
        for (const FacetTier& tier : tiers_of(solid, k_up)) EXPECT_EQ(tier.name, "");
    }
}

// One name for facets of no symmetry and no common angle makes no tier; two names split one.
TEST(Tiers, AreNotMadeOfNamesButPartedByThem) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> even(0, 1);
    std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, 0.3}}};
    for (int i = 0; i < 12; ++i) {
        const double tilt = radians(20 + 60 * even(random)), turn = radians(30.0 * i);
        const double side = i % 2 == 0 ? 1 : -1;
        planes.push_back({"C" + std::to_string(i),
                          {{std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn),
                            side * std::cos(tilt)},
                           1}});
    }
    for (const FacetTier& tier : tiers_of(intersect_half_spaces(planes).solid, k_up)) {
        EXPECT_EQ(tier.facets.size(), 1u) << tier.name;
    }
    Solid cut = make_cut("round-brilliant");
    int upper = 0;
    for (Facet& facet : cut.facets) {
        if (facet.name[0] != 'U') continue;
        facet.name = (upper % 2 == 0 ? "A" : "B") + std::to_string(upper / 2);
        ++upper;
    }
    std::map<std::string, std::size_t> sizes;
    for (const FacetTier& tier : tiers_of(cut, k_up)) sizes[tier.pattern] = tier.facets.size();
    EXPECT_EQ(sizes["A*"], 8u);
    EXPECT_EQ(sizes["B*"], 8u);
}

// A regular 16-gon: 6.5 from corner to corner, 6.5 cos(180 / 16) from flat to flat, perimeter / pi
// on average.
TEST(Caliper, OfARoundGirdleOfFlats) {
    const CaliperWidths w = caliper_widths(make_cut("round-brilliant"));
    const double step = std::numbers::pi / 16;
    EXPECT_NEAR(w.largest, 6.5, 1e-12);
    EXPECT_NEAR(w.least, 6.5 * std::cos(step), 1e-12);
    EXPECT_NEAR(w.mean, 6.5 * std::sin(step) / step, 1e-12);
    EXPECT_NEAR(std::remainder(w.largest_azimuth, 2 * step), 0, 1e-9);
    EXPECT_NEAR(std::abs(std::remainder(w.least_azimuth, 2 * step)), step, 1e-9);
    EXPECT_EQ(w.outline.size(), 16u);
    EXPECT_TRUE(w.round());
}

TEST(Caliper, OfALongStoneTurned) {
    const CaliperWidths w =
        caliper_widths(make_cut("step", {{"width", 5}, {"ratio", 1.4}, {"azimuth", 30}}));
    EXPECT_NEAR(w.least, 5, 1e-12);
    EXPECT_NEAR(w.length, 7, 1e-12);
    EXPECT_NEAR(w.least_azimuth, 120 * std::numbers::pi / 180, 1e-12);
    EXPECT_FALSE(w.round());
    EXPECT_EQ(caliper_widths({}).largest, 0);
}

// Reads back what the design was made of: angles and teeth, on another wheel too.
TEST(CuttingList, IsTheDesigns) {
    const ReadCut cut = parse_gemcad_asc(k_head + k_crown + k_rest);
    const auto list = cutting_list(cut.solid);
    ASSERT_EQ(list.size(), 4u);
    const char* const tiers[] = {"A", "G", "1", "T"};  // in the file's order
    const double angles[] = {40, 90, 41, 0};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(list[i].tier, tiers[i]);
        EXPECT_NEAR(list[i].angle_deg, angles[i], 1e-12);
        EXPECT_NEAR(list[i].most_angle_deg, angles[i], 1e-12);
    }
    ASSERT_EQ(list[0].indices.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(list[0].indices[i], 24.0 * double(i + 1), 1e-12);
    EXPECT_NEAR(cutting_list(cut.solid, {.gear = 64})[0].indices[1], 32, 1e-12);
}

TEST(WrittenNumbers, AreReadAsPeopleWriteThem) {
    const auto value = [](const char* text, bool commas = false) {
        const WrittenNumber number = written_number(text, commas);
        return number.problem.empty() ? number.value * number.unit.factor : NAN;
    };
    EXPECT_EQ(value(" 6.5 mm"), 6.5);
    EXPECT_EQ(value("6,5mm"), 6.5);
    EXPECT_EQ(value("0.25 in"), 6.35);
    EXPECT_EQ(value("1,234"), 1.234);
    EXPECT_EQ(value("-3e-2"), -0.03);
    EXPECT_EQ(value("57%"), 57);
    for (const char* text :
         {"", "x", "1,2,3", "1.2,3", "5 parsecs", "nan", "inf", "1e999", "12 of", "12 of 0",
          "3\xC2\xB0"
          "99'",
          "3.5\xC2\xB0"
          "20'",
          "1,234"}) {
        EXPECT_TRUE(std::isnan(value(text, true))) << text;
    }
}

}  // namespace
}  // namespace culet
