// Proportions as laboratories define them. Expectations: the parameters from which a cut was made,
// and what one moved facet changes.

#include "stone/design/cut_measures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "stone/cuts/cuts.h"
#include "stone/numbers/units.h"

namespace culet {
namespace {

struct Measures : std::map<std::string, double> {
    double at(const std::string& name) const {
        EXPECT_TRUE(contains(name)) << name;
        return contains(name) ? map::at(name) : NAN;
    }
};

Measures measures_of(const Solid& solid) {
    Measures all;
    for (const CutMeasure& measure : cut_measures(solid)) all[measure.name] = measure.value;
    return all;
}

Solid moved(const Solid& solid, const std::string& facet, double tilt_deg, double out) {
    std::vector<NamedPlane> planes;
    for (const Facet& own : solid.facets) planes.push_back({own.name, own.plane});
    for (NamedPlane& named : planes) {
        if (named.name != facet) continue;
        const Vec3 n = named.plane.normal;
        const double level = std::hypot(n.x, n.y), to = std::atan2(level, n.z) + radians(tilt_deg);
        const Vec3 side = level > 0 ? Vec3{n.x, n.y, 0} / level : Vec3{1, 0, 0};
        named.plane.normal = std::sin(to) * side + Vec3{0, 0, std::cos(to)};
        named.plane.offset += out;
    }
    // Without the edges that rounding opens at meets.
    return contract_near_meets(intersect_half_spaces(planes).solid, 1e-9).solid;
}

TEST(CutMeasures, OfABrilliantAreThoseItWasMadeFrom) {
    for (const double segments : {1.0, 6.0}) {
        const auto of = measures_of(make_cut("round-brilliant", {{"diameter", 6.5},
                                                                 {"table", 57},
                                                                 {"crown-angle", 34.5},
                                                                 {"pavilion-angle", 40.8},
                                                                 {"star", 52},
                                                                 {"lower-half", 76},
                                                                 {"girdle-segments", segments}}));
        // Percentages are of the mean width of a polygon in the circle that the cut is made in.
        const double n = 16 * segments, pi = std::numbers::pi;
        const double circle = n / pi * std::sin(pi / n);
        EXPECT_NEAR(of.at("diameter"), 6.5 * circle, 1e-9);
        EXPECT_NEAR(of.at("table"), 57 / circle, 1e-7);
        EXPECT_NEAR(of.at("table max"), 57 / circle, 1e-7);
        EXPECT_NEAR(of.at("star length"), 52, 1e-7);
        EXPECT_NEAR(of.at("lower half length"), 76, 1e-7);
        EXPECT_NEAR(of.at("crown angle"), 34.5, 1e-9);
        EXPECT_NEAR(of.at("crown angle max"), 34.5, 1e-9);
        EXPECT_NEAR(of.at("pavilion angle min"), 40.8, 1e-9);
        EXPECT_NEAR(of.at("crown height") + of.at("girdle thickness") + of.at("pavilion depth"),
                    of.at("total depth"), 1e-9);
        // (1 - table) / 2 tan(angle), of the circle.
        EXPECT_NEAR(of.at("crown height at mains"), 43 / 2.0 * std::tan(radians(34.5)) / circle,
                    1e-7);
        EXPECT_NEAR(of.at("crown height at mains") + of.at("girdle at mains") +
                        of.at("pavilion depth at mains"),
                    of.at("total depth"), 1e-9);
        EXPECT_NEAR(of.at("girdle at mains"), of.at("girdle max"), 1e-7);
        EXPECT_LE(of.at("girdle min"), of.at("girdle mean") + 1e-9);
        EXPECT_LE(of.at("girdle mean"), of.at("girdle max") + 1e-9);
        for (const char* name : {"table off-centre", "culet off-centre", "table/culet",
                                 "crown height variation", "pavilion depth variation",
                                 "girdle variation", "table variation", "crown angle variation"})
            EXPECT_NEAR(of.at(name), 0, 1e-7) << name;
        EXPECT_FALSE(of.contains("culet"));
    }
}

// An even girdle of 16 flats is as thick everywhere. Scalloped between 96, it is thickest where
// mains and halves meet.
TEST(CutMeasures, GirdleIsMeasuredAllRound) {
    const auto even = measures_of(make_cut("round-brilliant", {{"girdle-segments", 1}}));
    EXPECT_NEAR(even.at("girdle min"), even.at("girdle max"), 1e-7);
    EXPECT_NEAR(even.at("girdle mean"), even.at("girdle thickness"), 1e-7);
    const auto wavy = measures_of(make_cut("round-brilliant", {{"girdle-segments", 6}}));
    EXPECT_LT(wavy.at("girdle min"), wavy.at("girdle max") - 0.1);
    EXPECT_NEAR(wavy.at("girdle variation"), 0, 1e-7);  // where the mains meet it
}

TEST(CutMeasures, OneFacetAstrayShowsAsSymmetry) {
    const Solid cut = make_cut("round-brilliant", {{"girdle-segments", 1}, {"culet", 3}});
    const auto before = measures_of(cut);
    // The cut's culet is 3 % from side to side of an octagon.
    EXPECT_NEAR(before.at("culet") * std::cos(std::numbers::pi / 8), 3 * before.at("table") / 57,
                1e-7);
    const auto steep = measures_of(moved(cut, "C1", 0.7, 0));
    EXPECT_NEAR(steep.at("crown angle variation"), 0.7, 1e-9);
    EXPECT_NEAR(steep.at("crown angle max") - steep.at("crown angle min"), 0.7, 1e-9);
    EXPECT_NEAR(steep.at("crown angle"), before.at("crown angle") + 0.7 / 8, 1e-9);
    EXPECT_NEAR(steep.at("pavilion angle variation"), 0, 1e-9);
    const auto leaning = measures_of(moved(cut, "T", 0.5, 0));
    EXPECT_GT(leaning.at("table off-centre"), 0.05);
    EXPECT_NEAR(leaning.at("culet off-centre"), 0, 1e-7);
    EXPECT_NEAR(leaning.at("table/culet"), leaning.at("table off-centre"), 1e-7);
    EXPECT_GT(leaning.at("table variation"), 0.05);
    EXPECT_GT(leaning.at("crown height variation"), -1e-12);
    const auto deep = measures_of(moved(cut, "G1", 0, -0.05));
    EXPECT_GT(deep.at("out of round"), before.at("out of round") - 1e-9);
    EXPECT_GT(deep.at("culet off-centre"), 0.02);
}

TEST(CutMeasures, OtherCutsHaveWhatTheyHave) {
    const auto step = measures_of(make_cut("step"));
    EXPECT_FALSE(step.contains("diameter"));
    EXPECT_FALSE(step.contains("star length"));
    EXPECT_FALSE(step.contains("out of round"));
    EXPECT_GT(step.at("girdle mean"), 0);
    EXPECT_GT(step.at("table"), 0);
    Solid flat;
    EXPECT_TRUE(cut_measures(flat).empty());
}

// GIA: table to 1 %, crown angle to 0.5, pavilion angle to 0.2 degrees, star and lower half to 5 %,
// depth to 0.1 %. AGS: to 0.1.
TEST(CutMeasures, AreRoundedAsLaboratoriesDo) {
    const auto gia = [](const char* name, const char* unit, double value) {
        return rounded_to(value, rounding_step(ReportStyle::gia, name, unit));
    };
    EXPECT_EQ(gia("table", "%", 56.51), 57);
    EXPECT_EQ(gia("crown angle", "deg", 34.74), 34.5);
    EXPECT_EQ(gia("pavilion angle", "deg", 40.71), 40.8);
    EXPECT_EQ(gia("star length", "%", 52.4), 50);
    EXPECT_EQ(gia("lower half length", "%", 77.6), 80);
    EXPECT_EQ(gia("total depth", "%", 61.449), 61.4);
    EXPECT_EQ(gia("crown angle max", "deg", 34.74), 34.74);
    EXPECT_EQ(rounded_to(34.74, rounding_step(ReportStyle::ags, "crown angle", "deg")), 34.7);
    EXPECT_EQ(rounding_step(ReportStyle::plain, "table", "%"), 0);
    EXPECT_EQ(rounding_step(ReportStyle::ags, "depth", "mm"), 0);
}

}  // namespace
}  // namespace culet
