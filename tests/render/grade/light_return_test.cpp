// Light return against other programs' published figures, closed forms and conservation of energy.

#include "render/grade/light_return.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "render/grade/grade.h"
#include "render/optics/fresnel.h"
#include "stone/cuts/cuts.h"
#include "stone/design/tiers.h"
#include "stone/text/errors.h"
#include "tests/render/grade/round_brilliants.h"

namespace culet {
namespace {

using test::round_brilliant;
using test::RoundProportions;

constexpr double k_diamond = 2.417;

GradeOptions tilted_by(std::vector<double> tilts_deg) {
    GradeOptions options;
    options.tilts.clear();
    for (const double tilt : tilts_deg) options.tilts.push_back(radians(tilt));
    return options;
}

double sum_of(const LightBalance& b) {
    return b.useful + b.head + b.other + b.leak + b.entry_reflection + b.residual;
}

Solid block() {
    std::vector<NamedPlane> planes;
    int name = 0;
    for (const double side : {1.0, -1.0}) {
        for (const Vec3 normal : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
            planes.push_back({"f" + std::to_string(name++), {side * normal, 1}});
    }
    return intersect_half_spaces(planes).solid;
}

// Straight down into a block, R at every face: the bottom emits T (1 + R^2 + ...) T, the top T R T
// (1 + R^2 + ...) and the first reflection.
TEST(LightReturn, OfABlockIsTheGeometricSeries) {
    const EyeLight light =
        EyeLightTracer(block()).trace({0, 0, 1}, 1.5, {.faces = 20, .cut_weight = 0});
    const LightBalance balance =
        light_balance(light, crown_facets(block()), {radians(10), radians(64)});
    const double r = mean_reflection(1, 1.5, 1).mean, t = 1 - r;
    EXPECT_NEAR(light.area, 4, 1e-12);
    EXPECT_NEAR(balance.entry_reflection, r, 1e-14);
    EXPECT_NEAR(balance.leak, t * t / (1 - r * r), 1e-14);
    EXPECT_NEAR(balance.head, t * t * r / (1 - r * r), 1e-14);
    EXPECT_NEAR(balance.useful, 0, 1e-15);
    EXPECT_NEAR(sum_of(balance), 1, 1e-14);
}

// The standard round brilliant SRB.asc that comes with GemRay (Strickland): its angles and
// distances.
Solid gemrays_round_brilliant() {
    struct Tier {
        const char* name;
        double slope_deg, offset;
        int facets;
        double first;  ///< in steps of the tier
    };
    std::vector<NamedPlane> planes;
    for (const Tier& tier :
         {Tier{"G", 90, 1.02653281, 16, 0.5}, Tier{"L", 137.5, 0.61819401, 16, 0.5},
          Tier{"P", 138.5, 0.61701256, 8, 0}, Tier{"U", 34, 0.68444470, 16, 0.5},
          Tier{"C", 28, 0.60896430, 8, 0}, Tier{"S", 16, 0.50613241, 8, 0.5},
          Tier{"T", 0, 0.36450932, 1, 0}}) {
        for (int i = 0; i < tier.facets; ++i) {
            const double slope = radians(tier.slope_deg);
            const double azimuth = 2 * std::numbers::pi * (i + tier.first) / tier.facets;
            planes.push_back({tier.name + std::to_string(i),
                              {{std::sin(slope) * std::cos(azimuth),
                                std::sin(slope) * std::sin(azimuth), std::cos(slope)},
                               tier.offset}});
        }
    }
    return contract_near_meets(intersect_half_spaces(planes).solid, 3e-4 * 2).solid;
}

// GemRay 1.2.0's own output for its sample SRB.asc (Strickland), head 10 degrees, whole stone and
// (table). It samples pixels: its figures at 100 and 400 pixels differ by 0.1 to 0.9.
TEST(LightReturn, IsGemrays) {
    const Solid solid = gemrays_round_brilliant();
    struct Published {
        double n, tilt_deg, iso, cos, sc2;
    };
    const int table = table_facet(solid, {0, 0, 1});
    const EyeLightTracer tracer(solid);
    for (const double sign : {1.0, -1.0}) {
        for (const Published& p :
             {Published{1.54, 0, 62.31, 54.28, 38.99}, Published{1.54, 10, 74.37, 57.83, 44.56},
              Published{1.54, 20, 56.73, 44.74, 36.71}, Published{1.54, 30, 46.82, 35.19, 35.85},
              Published{2.417, 0, 69.75, 56.95, 53.69}}) {
            const ViewReturn view =
                light_return(tracer.trace(eye_over_tilted(sign * radians(p.tilt_deg), 0), p.n),
                             table, radians(10), RandomSky(1, p.n));
            EXPECT_NEAR(100 * view.whole[0], p.iso, 0.7) << p.n << " at " << sign * p.tilt_deg;
            EXPECT_NEAR(100 * view.whole[1], p.cos, 0.7) << p.n << " at " << sign * p.tilt_deg;
            EXPECT_NEAR(100 * view.whole[2], p.sc2, 0.7) << p.n << " at " << sign * p.tilt_deg;
        }
    }
    const auto through_table = [&](double n) {
        return light_return(tracer.trace({0, 0, 1}, n), table, radians(10), RandomSky(1, n)).table;
    };
    const LightReturn quartz = through_table(1.54), diamond = through_table(k_diamond);
    EXPECT_NEAR(100 * quartz[0], 43.30, 0.7);
    EXPECT_NEAR(100 * quartz[1], 40.35, 0.7);
    EXPECT_NEAR(100 * quartz[2], 27.53, 0.7);
    EXPECT_NEAR(100 * diamond[0], 54.02, 0.7);
    EXPECT_NEAR(100 * diamond[1], 45.80, 0.7);
    EXPECT_NEAR(100 * diamond[2], 41.84, 0.7);
}

// GemRay's sign convention (docs/grade.md): a positive tilt about x lifts the edge at -y towards
// the eye, one about y the edge at +x. A stone that shows a single sloping facet facing that edge
// is seen perpendicularly at a tilt equal to the slope, and at twice that angle at the opposite
// tilt: the outside reflection is Fresnel's for 0 and for twice the slope.
TEST(LightReturn, PositiveTiltsLiftTheEdgeThatGemraysDo) {
    const double slope = radians(20), n = 1.54;
    const auto reflected = [&](double angle) {
        return mean_reflection(1.0, n, std::cos(angle)).mean;
    };
    const std::pair<double, Vec3> axes[] = {{0, {0, -1, 0}}, {radians(90), {1, 0, 0}}};
    for (const auto& [axis, lifted] : axes) {
        std::vector<NamedPlane> planes{
            {"slope", {Vec3{0, 0, std::cos(slope)} + std::sin(slope) * lifted, 1}},
            {"culet", {{0, 0, -1}, 1}}};
        int side = 0;
        for (const Vec3 out : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}})
            planes.push_back(
                {"side" + std::to_string(side++), {std::sqrt(0.5) * (out - Vec3{0, 0, 1}), 1}});
        const Solid solid = intersect_half_spaces(planes).solid;
        const EyeLightTracer tracer(solid);
        const auto at_tilt = [&](double tilt) {
            return light_balance(tracer.trace(eye_over_tilted(tilt, axis), n), crown_facets(solid),
                                 {radians(10), radians(64)})
                .entry_reflection;
        };
        EXPECT_NEAR(at_tilt(slope), reflected(0), 1e-9) << axis;
        EXPECT_NEAR(at_tilt(-slope), reflected(2 * slope), 1e-9) << axis;
    }
}

// Conservation of energy for any cut, index and tilt.
TEST(LightReturn, BalancesSumToOne) {
    for (const CutKind& kind : cut_kinds()) {
        if (!kind.convex) continue;
        const Solid solid = make_cut(kind.name);
        const EyeLightTracer tracer(solid);
        const std::vector<bool> crown = crown_facets(solid);
        for (const double n : {1.4, 1.77, 2.65}) {
            for (const double tilt : {0.0, 0.3, 1.2}) {
                const EyeLight light = tracer.trace(eye_over_tilted(tilt, 0.4), n);
                EXPECT_NEAR(sum_of(light_balance(light, crown, {0.2, 1.1})), 1, 1e-9)
                    << kind.name << " " << n << " " << tilt;
            }
        }
    }
}

// gemstone-optimizer's published sweep of the pavilion (docs/VALIDATION.md), Tolkowsky's crown,
// 3200 rays: useful return in per cent, including the head, as that program counts.
TEST(LightReturn, FollowsThePublishedSweepOfThePavilion) {
    struct Published {
        double pavilion, useful;
    };
    const std::vector<Published> sweep{{20, 28.0428},    {30, 41.1231}, {38, 69.6665},
                                       {40.75, 70.2900}, {44, 54.5375}, {50, 35.2317}};
    std::vector<double> found;
    for (const Published& p : sweep) {
        const Grade grade =
            grade_stone(round_brilliant({.pavilion = p.pavilion}), {k_diamond, {}}, tilted_by({}));
        found.push_back(100 * (grade.balance.useful + grade.balance.head));
        EXPECT_NEAR(found.back(), p.useful, 3) << p.pavilion;
        EXPECT_NEAR(sum_of(grade.balance), 1, 1e-9);
    }
    for (std::size_t i = 1; i < found.size(); ++i) {
        EXPECT_EQ(found[i] > found[i - 1], sweep[i].useful > sweep[i - 1].useful) << i;
    }
}

// Its fire of the same stone: 65.08 with 12800 rays for faces and 3200 spectral ones; a diamond of
// 2.417 with a dispersion of 0.044 between 430.8 and 686.7 nm, by Cauchy's formula.
TEST(LightReturn, HasThePublishedFire) {
    const double b = 0.044 / (1 / (430.8 * 430.8) - 1 / (686.7 * 686.7));
    std::array<double, 3> colours{};
    for (std::size_t i = 0; i < 3; ++i)
        colours[i] = k_diamond + b * (1 / (k_fire_nm[i] * k_fire_nm[i]) - 1 / (589.3 * 589.3));
    const Grade grade = grade_stone(round_brilliant(), {k_diamond, colours}, tilted_by({}));
    ASSERT_TRUE(grade.fire);
    EXPECT_NEAR(100 * grade.fire->separated, 65.08, 1.5);
    EXPECT_GT(grade.fire->matched, grade.fire->separated);
    EXPECT_GT(grade.fire->spectral, 0);
    EXPECT_LT(grade.fire->spectral, grade.fire->matched);
    EXPECT_FALSE(grade_stone(round_brilliant(), {k_diamond, {}}, tilted_by({})).fire)
        << "without dispersion nothing is known of fire";
}

TEST(LightReturn, OfSymmetricDesignsIsSymmetric) {
    const Grade grade =
        grade_stone(round_brilliant(), {k_diamond, {}}, tilted_by({-30, -17, -3, 0, 3, 17, 30}));
    ASSERT_EQ(grade.curves.size(), 2u);
    for (const TiltCurve& curve : grade.curves) {
        for (std::size_t i = 0; i < 3; ++i) {
            for (const LightModel model :
                 {LightModel::iso, LightModel::cos, LightModel::sc2, LightModel::wlr}) {
                const auto m = static_cast<std::size_t>(model);
                EXPECT_NEAR(curve.returns[i].whole[m], curve.returns[6 - i].whole[m], 1e-9);
                EXPECT_NEAR(curve.returns[i].table[m], curve.returns[6 - i].table[m], 1e-9);
                // By the eightfold symmetry the tilt about x equals that about y.
                EXPECT_NEAR(curve.returns[i].whole[m], grade.curves[0].returns[i].whole[m], 1e-9);
            }
        }
    }
    EXPECT_EQ(grade.curves[0].returns[3].whole[0], grade.face_up.whole[0]);
}

// GIA's trends (Hemphill et al. 1998): of crowns above 10 degrees 23 is the best, those above 34.5
// are never high; tables under 57 %; pavilions from 38 to 42 or 43 degrees.
TEST(LightReturn, WeightedAsGiasFollowsItsTrends) {
    const auto weighted = [](const RoundProportions& p) {
        const EyeLightTracer tracer(round_brilliant(p));
        WeightedReturn sum;
        for (const Vec3& direction : hemisphere_directions(4, 8)) {
            const WeightedReturn part = weighted_return(tracer.trace(direction, k_diamond));
            sum.returned += part.returned;
            sum.weight += part.weight;
        }
        return sum.returned / sum.weight;
    };
    const double best = weighted({.table = 56, .crown = 23, .lower = 77});
    for (const double crown : {12.0, 15.0, 29.0, 34.5, 38.0})
        EXPECT_GT(best, weighted({.table = 56, .crown = crown, .lower = 77})) << crown;
    EXPECT_GT(weighted({.table = 56, .lower = 77}), weighted({.table = 64, .lower = 77}));
    EXPECT_GT(weighted({.table = 64, .lower = 77}), weighted({.table = 68, .lower = 77}));
    EXPECT_GT(weighted({.table = 56, .pavilion = 41, .lower = 77}),
              weighted({.table = 56, .pavilion = 36, .lower = 77}));
    EXPECT_GT(weighted({.table = 56, .pavilion = 42, .lower = 77}),
              weighted({.table = 56, .pavilion = 45, .lower = 77}));
}

// A figure from exact areas is as smooth as the areas: half a small step has half its effect.
TEST(LightReturn, IsContinuousInTheAngles) {
    const auto iso = [](double pavilion) {
        const EyeLight light =
            EyeLightTracer(round_brilliant({.pavilion = pavilion})).trace({0, 0, 1}, k_diamond);
        return 100 * light_return(light, -1, radians(10), RandomSky(1, k_diamond)).whole[1];
    };
    const double at = 40.6, step = 1e-4;
    const double slope = (iso(at + step) - iso(at - step)) / (2 * step);
    const double half = (iso(at + step / 2) - iso(at - step / 2)) / step;
    EXPECT_GT(std::abs(slope), 0.01);
    EXPECT_NEAR(half / slope, 1, 0.01);
}

TEST(LightReturn, DoesNotDependOnThreads) {
    GradeOptions one = tilted_by({-20, 0, 20}), four = one;
    one.threads = 1;
    four.threads = 4;
    const Solid solid = make_cut("oval");
    const Grade a = grade_stone(solid, {1.77, {}}, one), b = grade_stone(solid, {1.77, {}}, four);
    EXPECT_EQ(a.balance.useful, b.balance.useful);
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_EQ(a.curves[1].returns[i].whole, b.curves[1].returns[i].whole);
    EXPECT_EQ(a.hearts.evenness, b.hearts.evenness);
}

TEST(LightReturn, RefusesWhatCannotBeGraded) {
    const Solid solid = round_brilliant();
    EXPECT_THROW(grade_stone(solid, {1.0, {}}, tilted_by({})), InputError);
    EXPECT_THROW(grade_stone(solid, {std::nan(""), {}}, tilted_by({})), InputError);
    Solid open = solid;
    open.facets.pop_back();
    EXPECT_THROW(grade_stone(open, {k_diamond, {}}, tilted_by({})), InputError);
    EXPECT_THROW(grade_stone({}, {k_diamond, {}}, tilted_by({})), InputError);
    for (const CutKind& kind : cut_kinds()) {
        if (kind.convex) continue;
        EXPECT_THROW(grade_stone(make_cut(kind.name), {k_diamond, {}}, tilted_by({})), InputError)
            << kind.name;
    }
}

}  // namespace
}  // namespace culet
