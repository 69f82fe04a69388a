// Expectations: the trade's facet counts, Euler's formula, exact convexity, and the closed forms
// between angles and heights (crown height = (1 - table)/2 tan(crown angle), pavilion depth =
// tan(angle)/2).

#include "stone/cuts/cuts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "stone/mesh/mesh_io.h"
#include "stone/numbers/units.h"
#include "stone/solid/checks.h"
#include "stone/text/errors.h"
#include "tests/scratch_folder.h"

namespace {

using namespace culet;

std::string faults_of(const Solid& solid, bool convex) {
    CheckLimits limits;
    limits.planarity = 1e-12;
    limits.must_be_convex = convex;
    std::string text;
    for (const Fault& fault : find_faults(solid, limits)) text += fault.what + "\n";
    return text;
}

int count_of(const Solid& solid, char letter) {
    int count = 0;
    for (const Facet& facet : solid.facets) count += facet.name[0] == letter;
    return count;
}

TEST(Cuts, EveryCutIsClosedPlanarAndRightSideOutAtItsDefaults) {
    for (const CutKind& kind : cut_kinds()) {
        const Solid solid = make_cut(kind.name);
        EXPECT_EQ(faults_of(solid, kind.convex), "") << kind.name;
        const int euler = static_cast<int>(solid.vertices.size()) - edge_count(solid) +
                          static_cast<int>(solid.facets.size());
        EXPECT_EQ(euler, 2) << kind.name;
        EXPECT_GT(volume(solid), 0) << kind.name;
        EXPECT_GE(find_facet(solid, "T"), 0) << kind.name;
        EXPECT_EQ(is_convex(solid), kind.convex) << kind.name;
    }
}

TEST(Cuts, FacetCountsAreTheTrades) {
    const auto facets = [](const char* name) { return make_cut(name).facets.size(); };
    // 33 crown and 24 pavilion facets, and those of the girdle (Tolkowsky's brilliant without a
    // culet facet).
    const Solid round = make_cut("round-brilliant");
    EXPECT_EQ(round.facets.size(), 57u + 16u);
    EXPECT_EQ(round.vertices.size(), 57u) << "8 table, 8 star, 16 + 16 girdle, 8 lower, 1 culet";
    EXPECT_EQ(count_of(round, 'S'), 8);
    EXPECT_EQ(count_of(round, 'C'), 8);
    EXPECT_EQ(count_of(round, 'U'), 16);
    EXPECT_EQ(count_of(round, 'L'), 16);
    EXPECT_EQ(count_of(round, 'P'), 8);
    EXPECT_EQ(facets("oval"), 73u);
    EXPECT_EQ(facets("marquise"), 73u);
    EXPECT_EQ(facets("pear"), 73u);
    EXPECT_EQ(facets("cushion"), 73u);
    EXPECT_EQ(facets("trillion"), 1u + 6 + 6 + 12 + 12 + 12 + 6);
    EXPECT_EQ(facets("heart"), 1u + 6 + 7 + 14 + 14 + 14 + 7)
        << "seven mains, no star over the notch";
    EXPECT_EQ(facets("step"), 1u + 24 + 8 + 24);
    EXPECT_EQ(facets("emerald"), 57u);
    EXPECT_EQ(facets("princess"), 1u + 8 + 4 + 4 + 2 * 8);
}

TEST(Cuts, RoundBrilliantHasThePublishedProportions) {
    const Solid solid = make_cut("round-brilliant", {{"diameter", 10},
                                                     {"table", 57},
                                                     {"crown-angle", 34.5},
                                                     {"pavilion-angle", 40.75},
                                                     {"girdle", 3.5}});
    const auto facet = [&](const char* name) { return solid.facets[find_facet(solid, name)]; };
    EXPECT_NEAR(degrees(std::acos(facet("C3").plane.normal.z)), 34.5, 1e-10);
    EXPECT_NEAR(degrees(std::acos(-facet("P3").plane.normal.z)), 40.75, 1e-10);
    // Crown height 14.78 %, pavilion depth 43.08 %, girdle 3.5 %: total depth 61.4 %.
    const double depth = 100 * width_along(solid, {0, 0, 1}) / 10;
    EXPECT_NEAR(depth, 50 * 0.43 * std::tan(radians(34.5)) + 50 * std::tan(radians(40.75)) + 3.5,
                1e-10);
    EXPECT_NEAR(depth, 61.4, 0.05);
    // Handbooks give halves of about 41 and 42 degrees. In closed form a half falls from its meet
    // on the ray at 22.5 degrees to the chord whose middle is at 11.25 degrees. The star meet is
    // half-way from the table's edge to the girdle, the lower meet at 1 - 77 %.
    const double a = radians(22.5), h = radians(11.25);
    const auto half_deg = [&](double meet, double main_deg) {
        const double climb = (1 - meet * std::cos(a)) * std::tan(radians(main_deg));
        return degrees(std::atan(climb / (std::cos(h) - meet * std::cos(h))));
    };
    const double edge = 0.57 * std::cos(a);
    const double upper = degrees(std::acos(facet("U1").plane.normal.z));
    const double lower = degrees(std::acos(-facet("L1").plane.normal.z));
    EXPECT_NEAR(upper, half_deg(edge + 0.5 * (1 - edge), 34.5), 1e-9);
    EXPECT_NEAR(lower, half_deg(0.23, 40.75), 1e-9);
    EXPECT_NEAR(upper, 41.1, 0.1);
    EXPECT_NEAR(lower, 41.9, 0.1);
}

TEST(Cuts, ARoundGirdleHasScallopsAndTouchesTheMainsAtItsHills) {
    for (const int segments : {2, 4, 7}) {
        const Solid solid = make_cut(
            "round-brilliant",
            {{"diameter", 10}, {"girdle", 4}, {"girdle-segments", segments}, {"culet", 1}});
        EXPECT_EQ(faults_of(solid, true), "") << segments;
        EXPECT_EQ(count_of(solid, 'G'), 16 * segments);
        EXPECT_EQ(solid.facets.size(), 58u + 16u * segments);
        EXPECT_LT(planarity(solid), 1e-12 * diameter(solid));
        // Every girdle corner lies on the circle; the thickness is at most 4 %, and less between.
        double thickest = 0, thinnest = 10;
        for (const Facet& facet : solid.facets) {
            if (facet.name[0] != 'G') continue;
            for (int corner : facet.corners) {
                const Vec3& v = solid.vertices[corner];
                EXPECT_NEAR(std::hypot(v.x, v.y), 5, 1e-12);
                thickest = std::max(thickest, std::abs(v.z));
                thinnest = std::min(thinnest, std::abs(v.z));
            }
        }
        EXPECT_NEAR(thickest, 0.2, 1e-12);
        EXPECT_LT(thinnest, 0.2 - 0.05);
    }
}

TEST(Cuts, ARoundGirdleThatClosesInItsValleysIsRefused) {
    EXPECT_THROW(make_cut("round-brilliant", {{"girdle", 0.5}, {"girdle-segments", 4}}),
                 InputError);
    EXPECT_NO_THROW(make_cut("round-brilliant", {{"girdle", 0.5}}));
}

TEST(Cuts, AnOvalWithScallopsIsTheStretchedRoundBrilliant) {
    const std::map<std::string, double> shape{{"table", 56},          {"crown-angle", 33},
                                              {"pavilion-angle", 41}, {"star", 52},
                                              {"lower-half", 75},     {"girdle-segments", 4}};
    auto round = shape, oval = shape;
    round["diameter"] = oval["width"] = 5;
    oval["ratio"] = 1.4;
    const Solid a = make_cut("round-brilliant", round), b = make_cut("oval", oval);
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    for (std::size_t i = 0; i < a.vertices.size(); ++i) {
        EXPECT_LT(glm::length(Vec3{1.4 * a.vertices[i].x, a.vertices[i].y, a.vertices[i].z} -
                              b.vertices[i]),
                  1e-13);
    }
}

TEST(Cuts, APublishedDesignFollowsFromItsProportions) {
    // "Choosing the Best Angles for Your SRB" (usfacetersguild.org): mains 28 and 41 degrees,
    // halves 32 and 43, stars 13, table at 0.13317 over the girdle's middle, girdle facets 0.5 from
    // the axis. Table, star and lower half lengths follow from the mains, the halves and the
    // table's level; the star angle and the halves must then come out as printed.
    const double a = radians(22.5), h = radians(11.25), radius = 0.5 / std::cos(h);
    const double t28 = std::tan(radians(28)), t41 = std::tan(radians(41));
    const double girdle_up = (0.248164 - std::sin(radians(28)) * radius) / std::cos(radians(28));
    const double girdle_low = (std::sin(radians(41)) * radius - 0.34200309) / std::cos(radians(41));
    const double table = 1 - (0.13317327 - girdle_up) / t28 / radius;
    const auto meet = [&](double main_slope, double half_deg) {
        const double half_slope = std::tan(radians(half_deg)) * std::cos(h);
        return (half_slope - main_slope) / (half_slope - main_slope * std::cos(a));
    };
    const double edge = table * std::cos(a);
    const Solid solid =
        make_cut("round-brilliant", {{"diameter", 2 * radius},
                                     {"table", 100 * table},
                                     {"crown-angle", 28},
                                     {"pavilion-angle", 41},
                                     {"star", 100 * (meet(t28, 32) - edge) / (1 - edge)},
                                     {"lower-half", 100 * (1 - meet(t41, 43))},
                                     {"girdle", 100 * (girdle_up - girdle_low) / (2 * radius)}});
    EXPECT_EQ(faults_of(solid, true), "");
    const auto angle = [&](const char* name) {
        return degrees(std::acos(std::abs(solid.facets[find_facet(solid, name)].plane.normal.z)));
    };
    EXPECT_NEAR(angle("S1"), 13, 0.01);
    EXPECT_NEAR(angle("U1"), 32, 1e-9);
    EXPECT_NEAR(angle("L1"), 43, 1e-9);
    EXPECT_NEAR(solid.facets[find_facet(solid, "U1")].plane.offset, 0.27344011, 1e-5);
    EXPECT_NEAR(solid.facets[find_facet(solid, "L1")].plane.offset, 0.34831272, 1e-5);
    EXPECT_NEAR(solid.facets[find_facet(solid, "S1")].plane.offset, 0.18756531, 1e-4);
}

TEST(Cuts, TurningARoundBrilliantByAnEighthMapsFacetsToFacets) {
    const Solid solid = make_cut("round-brilliant");
    const double c = std::sqrt(0.5);
    for (const Facet& facet : solid.facets) {
        const Vec3& n = facet.plane.normal;
        const Vec3 turned{c * (n.x - n.y), c * (n.x + n.y), n.z};
        double nearest = 1;
        for (const Facet& other : solid.facets) {
            nearest = std::min(nearest, glm::length(other.plane.normal - turned) +
                                            std::abs(other.plane.offset - facet.plane.offset));
        }
        EXPECT_LT(nearest, 1e-13) << facet.name;
    }
}

TEST(Cuts, ACuletFacetIsAsWideAsAsked) {
    const Solid solid = make_cut("round-brilliant", {{"culet", 2}, {"diameter", 10}});
    EXPECT_EQ(faults_of(solid, true), "");
    EXPECT_EQ(solid.facets.size(), 74u);
    Solid culet;
    for (int corner : solid.facets[find_facet(solid, "CU")].corners)
        culet.vertices.push_back(solid.vertices[corner]);
    // Mains are at 0 and 180 degrees, so the culet's width along x is across flats.
    EXPECT_NEAR(width_along(culet, {1, 0, 0}), 0.2, 1e-12);
}

TEST(Cuts, RandomProportionsGiveASoundStoneOrAClearError) {
    const unsigned seed = 1919;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const CutKind& kind : cut_kinds()) {
        int made = 0;
        for (int draw = 0; draw < 60; ++draw) {
            std::map<std::string, double> values;
            for (const CutParameter& p : kind.parameters) {
                // Within 30 % of the way from the default to either limit.
                const double t = 0.6 * uniform(random) - 0.3;
                double value = p.value + t * (t > 0 ? p.most - p.value : p.value - p.least);
                if (p.name == "mains" || p.name == "chevrons" || p.name == "girdle-segments")
                    value = std::round(value);
                if (p.name == "culet") value = 0;
                values[p.name] = value;
            }
            try {
                const Solid solid = make_cut(kind.name, values);
                ++made;
                EXPECT_EQ(faults_of(solid, kind.convex), "")
                    << kind.name << " seed " << seed << " draw " << draw;
            } catch (const InputError& error) {
                EXPECT_GT(std::string(error.what()).size(), 20u);
            }
        }
        EXPECT_GT(made, 10) << kind.name;
    }
}

TEST(Cuts, ExtremeProportionsGiveASoundStoneOrAClearError) {
    const unsigned seed = 2718;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const CutKind& kind : cut_kinds()) {
        int made = 0;
        for (int draw = 0; draw < 40; ++draw) {
            std::map<std::string, double> values;
            for (const CutParameter& p : kind.parameters) {
                double value = p.least + uniform(random) * (p.most - p.least);
                const bool whole =
                    p.name == "mains" || p.name == "chevrons" || p.name == "girdle-segments";
                if (whole) value = std::round(value);
                if (uniform(random) < 0.5 && !(p.name == "culet" && kind.name == "heart"))
                    values[p.name] = value;
            }
            try {
                const Solid solid = make_cut(kind.name, values);
                ++made;
                EXPECT_EQ(faults_of(solid, kind.convex), "")
                    << kind.name << " seed " << seed << " draw " << draw;
            } catch (const InputError& error) {
                EXPECT_GT(std::string(error.what()).size(), 20u);
            }
        }
        EXPECT_GT(made, 5) << kind.name;
    }
}

TEST(Cuts, StepsThatCannotBeCutAreAnsweredWithTheRange) {
    const auto message = [](const std::map<std::string, double>& values) {
        try {
            make_cut("step", values);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    // The last pavilion step starts 0.3 widths inside the girdle, where a corner has lost 0.3 * 2
    // tan(22.5 deg) of its length: 0.3 (2 - sqrt 2) = 17.57 % of the width.
    EXPECT_NE(message({{"corner", 17.5}}).find("17.57 %"), std::string::npos);
    EXPECT_EQ(message({{"corner", 17.65}}), "no error");
    EXPECT_EQ(message({{"corner", 37.5}}), "no error");
    EXPECT_NE(message({{"corner", 37.6}}).find("37.57 %"), std::string::npos);
    EXPECT_NE(message({{"crown-angle", 15}, {"crown-spread", 15}}).find("at most 14 deg"),
              std::string::npos);
    EXPECT_NE(message({{"pavilion-angle", 15}, {"pavilion-spread", 15}}).find("at most 14 deg"),
              std::string::npos);
}

TEST(Cuts, EveryCutComesBackFromAMeshFile) {
    const test::ScratchFolder folder;
    for (const CutKind& kind : cut_kinds()) {
        const Solid solid = make_cut(kind.name);
        const auto file = folder / (kind.name + ".obj");
        write_mesh(solid, file);
        const Solid back = read_mesh(file).solid;
        EXPECT_EQ(faults_of(back, kind.convex), "") << kind.name;
        ASSERT_EQ(back.facets.size(), solid.facets.size()) << kind.name;
        EXPECT_EQ(back.vertices.size(), solid.vertices.size()) << kind.name;
        for (std::size_t i = 0; i < solid.facets.size(); ++i) {
            EXPECT_EQ(back.facets[i].name, solid.facets[i].name);
            EXPECT_LT(glm::length(back.facets[i].plane.normal - solid.facets[i].plane.normal),
                      1e-12);
        }
    }
}

TEST(Cuts, WrongNamesAndValuesAreAnsweredWithWhatToDo) {
    const auto message = [](const auto& call) {
        try {
            call();
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    EXPECT_NE(message([] { make_cut("round-briliant"); }).find("round-brilliant"),
              std::string::npos);
    EXPECT_NE(message([] {
                  make_cut("oval", {{"tabel", 50}});
              }).find("\"table\""),
              std::string::npos);
    EXPECT_NE(message([] {
                  make_cut("oval", {{"table", 100}});
              }).find("20 to 90"),
              std::string::npos);
    EXPECT_NE(message([] {
                  make_cut("oval", {{"table", std::nan("")}});
              }).find("20 to 90"),
              std::string::npos);
    EXPECT_NE(message([] {
                  make_cut("round-brilliant", {{"mains", 8.5}});
              }).find("whole"),
              std::string::npos);
    EXPECT_NE(message([] {
                  make_cut("round-brilliant", {{"culet", 15}, {"lower-half", 94}});
              }).find("culet"),
              std::string::npos);
}

}  // namespace
