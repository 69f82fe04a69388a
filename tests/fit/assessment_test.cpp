// What a fit reports beside the stone: proportions, wrong readings, disagreements, open directions,
// what to measure next, rounding of instruments, robust losses, refits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "fit/findings/cut_quantities.h"
#include "fit/model/fit_model.h"
#include "fit/readings/rounding.h"
#include "fit/readings/slips.h"
#include "stone/text/errors.h"
#include "tests/fit/test_stones.h"

namespace culet {
namespace {

using namespace test;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

std::vector<Reading> full_readings(const Solid& truth) {
    std::vector<Reading> readings = all_angles(truth, radians(0.1), "T");
    for (const Reading& r : all_edges(truth, 0.01)) readings.push_back(r);
    readings.push_back(depth(truth, 0.01));
    return readings;
}

// Starts at the truth, which saves the search for a start: these statistics need many fits.
FitResult fit_from_truth(const Solid& truth, const std::vector<Reading>& readings) {
    FitOptions options;
    options.start = truth;
    return fit_stone(stone_of(truth), readings, options);
}

const FittedProportion* find(const FitResult& result, const std::string& name) {
    for (const FittedProportion& p : result.findings.proportions) {
        if (p.name == name) return &p;
    }
    return nullptr;
}

std::size_t index_of(const std::vector<Reading>& readings, ReadingKind kind, int facet) {
    for (std::size_t r = 0; r < readings.size(); ++r) {
        if (readings[r].kind == kind && readings[r].facets == std::vector<int>{facet}) return r;
    }
    throw std::runtime_error("no such reading");
}

// The brilliant is made from its proportions (test_stones.h): table 57 %, crown 34.5 degrees,
// pavilion 40.8 degrees, radius 3 mm. Its girdle is a regular 16-gon of circumradius 3, so its
// diameter is perimeter / pi.
TEST(Proportions, OfABrilliantAreThoseItWasMadeFrom) {
    const Solid truth = brilliant();
    const FitResult result = fit_stone(stone_of(truth), full_readings(truth));
    const double pi = std::numbers::pi;
    const double diameter = 16 * 2 * 3 * std::sin(pi / 16) / pi;
    ASSERT_NE(find(result, "diameter"), nullptr);
    EXPECT_NEAR(find(result, "diameter")->value, diameter, 1e-6);
    EXPECT_NEAR(find(result, "table")->value, 100 * 0.57 * 6 / diameter, 1e-4);
    EXPECT_NEAR(find(result, "crown angle")->value, 34.5, 1e-5);
    EXPECT_NEAR(find(result, "pavilion angle")->value, 40.8, 1e-5);
    EXPECT_NEAR(find(result, "crown height")->value + find(result, "girdle thickness")->value +
                    find(result, "pavilion depth")->value,
                find(result, "total depth")->value, 1e-9);
    EXPECT_NEAR(find(result, "volume")->value, volume(truth), 1e-5);
    EXPECT_NEAR(find(result, "weight")->value, volume(truth) * 3.5 / 200, 1e-6);
    EXPECT_NEAR(find(result, "length/width")->value, 1, 1e-6);
    for (const FittedProportion& p : result.findings.proportions) EXPECT_GT(p.sigma, 0) << p.name;
}

// Compares the derivatives of every proportion with central differences on a stone without
// symmetry.
TEST(Proportions, SlopesMatchDifferences) {
    const Solid box = enclosed({{"T", {glm::normalize(Vec3{0.02, 0.01, 1}), 1}},
                                {"X+", {glm::normalize(Vec3{1, 0.1, 0.05}), 1.4}},
                                {"Y+", {glm::normalize(Vec3{0.1, 1, -0.04}), 1}},
                                {"X-", {glm::normalize(Vec3{-1, 0.2, 0.02}), 1.5}},
                                {"Y-", {glm::normalize(Vec3{0, -1, 0.1}), 1}},
                                {"C", {glm::normalize(Vec3{1, 1, 2}), 1.3}},
                                {"P", {glm::normalize(Vec3{0.4, -0.1, -1}), 1}},
                                {"Q", {glm::normalize(Vec3{-0.3, 0.2, -1}), 1}}});
    for (const Solid& solid : {box, shaken(brilliant(), 0.01, 5)}) {
        const Stone stone = stone_of(solid);
        const FitModel model(stone, {}, {});
        const Shape& shape = model.mesh_shape();
        const auto outline = model.mesh_outline();
        const std::vector<CutQuantity> all = cut_quantities(model, shape, outline);
        EXPECT_GE(all.size(), 8u);
        for (std::size_t q = 0; q < all.size(); ++q) {
            std::vector<Vec3> slope(shape.points.size(), Vec3(0));
            for (const Quantity::Slope& s : all[q].quantity.slopes) {
                if (s.by == Quantity::By::point) slope[std::size_t(s.index)] += s.slope;
            }
            const double h = 1e-6;
            for (std::size_t p = 0; p < shape.points.size(); p += 5) {
                for (int k = 0; k < 3; ++k) {
                    Shape high = shape, low = shape;
                    high.points[p][k] += h;
                    low.points[p][k] -= h;
                    const double there = cut_quantities(model, high, outline)[q].quantity.value,
                                 here = cut_quantities(model, low, outline)[q].quantity.value;
                    EXPECT_NEAR(slope[p][k], (there - here) / (2 * h), 1e-6)
                        << all[q].name << " point " << p << " " << k;
                }
            }
        }
    }
}

TEST(Snooping, NamesTwoErrorsPlantedAtOnce) {
    const Solid truth = brilliant();
    const std::vector<Reading> clean = full_readings(truth);
    int named = 0, tried = 0;
    std::mt19937_64 random(17);
    for (unsigned seed = 1; seed <= 10; ++seed) {
        std::vector<Reading> readings = noisy(clean, seed);
        const std::size_t a = random() % 100, b = 100 + random() % 100;
        readings[a].value -= 10 * readings[a].sigma;
        readings[b].value += 10 * readings[b].sigma;
        const FitResult result = fit_from_truth(truth, readings);
        for (const std::size_t r : {a, b}) {
            if (!(result.readings[r].detectable <= 10 * readings[r].sigma)) continue;
            ++tried;
            named += result.readings[r].suspect;
        }
    }
    // The required success rate is 80 %. At a true rate of 95 %, 20 trials give fewer than 16
    // successes once in 3000.
    EXPECT_GE(tried, 12);
    EXPECT_GE(named, 0.8 * tried);
}

// Two tests at a level of 0.001 each, on 40 clean stones: more than two false alarms happen less
// than once in 10^4 runs.
TEST(Snooping, RarelyCriesWolf) {
    const Solid truth = brilliant();
    const std::vector<Reading> clean = full_readings(truth);
    int alarms = 0;
    for (unsigned seed = 100; seed < 140; ++seed) {
        alarms += !fit_from_truth(truth, noisy(clean, seed)).findings.suspects.empty();
    }
    EXPECT_LE(alarms, 2);
}

// Coverage of one and two sigma by inclinations. Facets of one fit are correlated. Ten independent
// combinations per fit give 250 in all; the bounds are 3.5 binomial standard deviations (0.103 and
// 0.048).
TEST(Honesty, TrueAnglesLieWithinTheirSigmas) {
    const Solid truth = brilliant();
    const std::vector<Reading> clean = full_readings(truth);
    int count = 0, one = 0, two = 0;
    double squares = 0;
    for (unsigned seed = 200; seed < 225; ++seed) {
        const FitResult result = fit_from_truth(truth, noisy(clean, seed));
        for (std::size_t f = 0; f < result.facets.size(); ++f) {
            const Vec3& n = truth.facets[f].plane.normal;
            if (truth.facets[f].name == "T" || std::abs(n.z) < 0.02) continue;
            const double z = (result.facets[f].inclination - inclination(n, {0, 0, 1})) /
                             result.facets[f].sigma_inclination;
            ++count;
            one += std::abs(z) < 1;
            two += std::abs(z) < 2;
            squares += z * z;
        }
    }
    EXPECT_NEAR(double(one) / count, 0.6827, 0.103);
    EXPECT_NEAR(double(two) / count, 0.9545, 0.048);
    // The error relative to the Cramer-Rao limit.
    EXPECT_NEAR(std::sqrt(squares / count), 1, 0.15);
}

TEST(Slips, AreRecognised) {
    struct Row {
        double written, meant;
        const char* what;
    };
    for (const Row& row : {Row{344, 34.4, "decimal point moved"}, Row{43.5, 34.5, "swapped"},
                           Row{55.5, 34.5, "other side"}}) {
        const auto slip = find_slip(row.written, {row.meant + 0.03, 0.1, 0.2}, Measured::angle);
        ASSERT_TRUE(slip) << row.written;
        EXPECT_NEAR(slip->corrected, row.meant, 1e-9);
        EXPECT_THAT(slip->what, HasSubstr(row.what));
    }
    const auto inch = find_slip(0.2559, {6.5, 0.01, 0.02}, Measured::length);
    ASSERT_TRUE(inch);
    EXPECT_EQ(inch->what, "inches for mm");
    EXPECT_NEAR(find_slip(1.24, {1.42, 0.005, 0.01}, Measured::length)->corrected, 1.42, 1e-12);
    // A stone of 1.2 ct whose weight was entered as 0.24 g.
    const auto grams = find_slip(0.24, {1.203, 0.005, 0.01}, Measured::weight);
    ASSERT_TRUE(grams);
    EXPECT_EQ(grams->what, "grams for carats");
    EXPECT_NEAR(grams->corrected, 1.2, 1e-12);
    EXPECT_FALSE(find_slip(34.5, {34.52, 0.05, 0.1}, Measured::angle));
    EXPECT_FALSE(find_slip(NAN, {1, 0.05, 0.1}, Measured::angle));
    EXPECT_FALSE(find_slip(77.77, {34.5, 0.005, 0.01}, Measured::length));
}

// The intended value is known in these cases: a width of an oval, and angles that agree with the
// rest of their tier.
TEST(Slips, OfSeveralTheOneNearestToWhatWasMeantIsNamed) {
    // 9.59 has two digits swapped and is two sigmas off; 9.45 has one wrong digit and is what the
    // others say.
    EXPECT_NEAR(find_slip(9.95, {9.45, 0.066, 0.132}, Measured::length)->corrected, 9.45, 1e-12);
    EXPECT_EQ(find_slip(43.5, {34.5, 0.3, 1}, Measured::angle)->what, "two digits swapped");
    // 30.3 was typed as 03.3, and a spreadsheet keeps 3.3.
    EXPECT_NEAR(find_slip(3.3, {30.2, 0.3, 1}, Measured::angle)->corrected, 30.3, 1e-12);
    // No correction is better than one that leads far away.
    EXPECT_FALSE(find_slip(40.8, {37.4, 0.15, 0.5}, Measured::angle));
}

TEST(Slips, OfAReadingAreNamedWithTheirCorrection) {
    const Solid truth = brilliant();
    std::vector<Reading> readings = noisy(full_readings(truth), 5);
    const std::size_t c3 = index_of(readings, ReadingKind::inclination, find_facet(truth, "C3"));
    readings[c3].value = radians(43.5);  // for 34.5
    const FitResult result = fit_stone(stone_of(truth), readings);
    EXPECT_EQ(result.status, FitStatus::contradictory);
    ASSERT_THAT(result.findings.suspects, ::testing::SizeIs(1)) << result.message;
    EXPECT_EQ(result.findings.suspects[0], readings[c3].id);
    ASSERT_EQ(result.findings.proposals.size(), 1u);
    EXPECT_THAT(result.findings.proposals[0].slip, HasSubstr("swapped"));
    EXPECT_NEAR(degrees(result.findings.proposals[0].corrected), 34.5, 1e-9);
    EXPECT_NEAR(degrees(result.findings.proposals[0].estimate), 34.5, 0.5);
    EXPECT_THAT(result.message, HasSubstr("34.5"));
}

TEST(Slips, OfAnImpossibleInclinationAreProposedAtOnce) {
    WrittenReading written;
    written.kind = "inclination";
    written.of = {"C1"};
    written.value = 344;
    written.sigma = 0.1;
    try {
        bind_readings({written}, stone_of(brilliant()));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("34.4"));
    }
}

// The box's four sides: three exact inclinations and an exact rotation contradict each other when
// one inclination differs. The other readings take no part.
TEST(Disagreement, OfExactReadingsNamesTheFewest) {
    const Solid box = cube();
    const auto exact = [&](const char* name, double deg) {
        Reading r = reading(ReadingKind::inclination, {find_facet(box, name)}, radians(deg), 0);
        r.exact = true;
        r.id = name;
        return r;
    };
    Reading turn = reading(ReadingKind::rotation, {}, 0, 0);
    turn.order = 4;
    turn.exact = true;
    turn.id = "turn";
    Reading deep = depth(box, 0);
    deep.exact = true;
    deep.id = "deep";
    const FitResult result =
        fit_stone(stone_of(box), {exact("X+", 88), exact("Y+", 87), deep, turn});
    EXPECT_EQ(result.status, FitStatus::contradictory) << result.message;
    EXPECT_THAT(result.findings.disagreeing, UnorderedElementsAre("X+", "Y+", "turn"))
        << result.message;
}

// Three equal depths and one that is 8 sigma off: the smallest disagreeing set is that one and one
// other.
TEST(Disagreement, OfReadingsOfOneQuantityIsBetweenTwo) {
    std::vector<Reading> readings;
    for (int i = 0; i < 4; ++i) {
        readings.push_back(depth(cube(), 0.01));
        readings.back().id = fmt::format("d{}", i);
    }
    readings[2].value += 0.08;
    const FitResult result = fit_stone(stone_of(cube()), readings);
    EXPECT_EQ(result.status, FitStatus::contradictory);
    EXPECT_THAT(result.findings.suspects, ::testing::ElementsAre("d2"));
    EXPECT_THAT(result.findings.disagreeing, Contains("d2"));
    EXPECT_EQ(result.findings.disagreeing.size(), 2u);
}

TEST(Disagreement, OfTwoNamesBoth) {
    std::vector<Reading> readings{depth(cube(), 0.01), depth(cube(), 0.01)};
    readings[0].id = "a";
    readings[1].id = "b";
    readings[1].value += 0.1;
    const FitResult result = fit_stone(stone_of(cube()), readings);
    EXPECT_EQ(result.status, FitStatus::contradictory);
    EXPECT_THAT(result.findings.disagreeing, UnorderedElementsAre("a", "b"));
    ASSERT_EQ(result.findings.proposals.size(), 1u);
    EXPECT_EQ(result.findings.proposals[0].alternatives.size(), 1u);
}

TEST(Undetermined, IsSaidInWords) {
    const Solid truth = brilliant();
    std::vector<Reading> readings;
    const int s3 = find_facet(truth, "S3");
    // All angles but one star's azimuth, and no edges: all offsets but the depth are open.
    for (const Reading& r : full_readings(truth)) {
        if (r.kind == ReadingKind::edge) continue;
        if (r.kind == ReadingKind::azimuth && r.facets[0] == s3) continue;
        readings.push_back(r);
    }
    const FitResult result = fit_stone(stone_of(truth), readings);
    EXPECT_EQ(result.status, FitStatus::undetermined);
    EXPECT_FALSE(result.findings.undetermined_words.empty());
    EXPECT_FALSE(result.findings.help.empty());
    EXPECT_THAT(result.message, Not(IsEmpty()));
}

// A box with two known widths lacks its depth. Adding the proposed reading must lower the rank
// defect by one.
TEST(Help, KeepsItsPromise) {
    const Solid box = cube();
    std::vector<Reading> readings = all_angles(box, radians(0.1), "T");
    readings.push_back(width(box, 0, 0.01));
    readings.push_back(width(box, 90, 0.01));
    for (std::size_t i = 0; i < readings.size(); ++i) readings[i].id = fmt::format("r{}", i);
    const FitResult before = fit_stone(stone_of(box), readings);
    ASSERT_FALSE(before.findings.help.empty());
    const NextReading& help = before.findings.help[0];
    EXPECT_TRUE(help.closes) << name_of(help.kind);
    Reading added = help.kind == ReadingKind::depth ? depth(box, help.sigma)
                                                    : reading(help.kind, {}, 2, help.sigma);
    if (help.kind == ReadingKind::edge || help.kind == ReadingKind::dihedral) {
        added.facets = {find_facet(box, help.of[0]), find_facet(box, help.of[1])};
    } else if (help.kind == ReadingKind::weight) {
        added.value = 8 * 3.5 / 200;
    } else if (help.kind == ReadingKind::distance) {
        added.places = {Place{Place::Kind::facet, find_facet(box, help.of[0]), -1, -1},
                        Place{Place::Kind::vertex, -1, -1, std::stoi(help.of[1].substr(1))}};
    }
    added.id = "added";
    readings.push_back(added);
    const FitResult after = fit_stone(stone_of(box), readings);
    EXPECT_EQ(after.statistics.rank_defect, before.statistics.rank_defect - 1);
}

// Without noise the whole of step^2/12 is common to all readings; from sigma = step/2 on almost
// none of it is (Widrow & Kollar). In between, the expectation is a computed mean square of
// E[rounded] - truth.
TEST(Rounding, CommonVarianceMatchesSimulation) {
    const double step = 0.1;
    EXPECT_NEAR(common_rounding_variance(0, step), step * step / 12, 1e-15);
    EXPECT_LT(common_rounding_variance(step / 2, step), 1e-5 * step * step);
    for (const double sigma : {0.005, 0.01, 0.02, 0.03}) {
        double squares = 0;
        const int positions = 400;
        for (int i = 0; i < positions; ++i) {
            const double truth = step * (i + 0.5) / positions;
            // E[rounded] is the sum over the steps of value times probability (normal tails).
            double mean = 0;
            for (int k = -20; k <= 20; ++k) {
                const auto below = [&](double x) {
                    return 0.5 * std::erfc((truth - x) / (sigma * std::sqrt(2.0)));
                };
                mean += k * step * (below((k + 0.5) * step) - below((k - 0.5) * step));
            }
            squares += (mean - truth) * (mean - truth) / positions;
        }
        EXPECT_NEAR(common_rounding_variance(sigma, step), squares, 1e-3 * squares + 1e-12)
            << sigma;
    }
}

// A box read to 0.1 mm, ten times per width. The depth's reported uncertainty is compared with its
// error over many positions between the steps. If the ten readings counted as independent, the
// claim would be step / sqrt(120), too small by a factor of three.
TEST(Rounding, RepeatedReadingsShareTheirRounding) {
    double squares = 0, sigma = 0;
    const int stones = 40;
    for (int i = 0; i < stones; ++i) {
        const double truth = 2 + 0.1 * (i + 0.5) / stones;
        std::vector<Reading> readings;
        for (int k = 0; k < 10; ++k) {
            Reading r = depth(cube(), 0.002);
            r.value = std::round(truth / 0.1) * 0.1;
            r.rounding = 0.1;
            r.id = fmt::format("d{}", k);
            readings.push_back(r);
        }
        const FitResult result = fit_stone(stone_of(cube()), readings);
        const double error = width_along(result.solid, {0, 0, 1}) - truth;
        squares += error * error / stones;
        sigma = find(result, "depth")->sigma;
    }
    EXPECT_NEAR(sigma, std::sqrt(squares), 0.1 * sigma);
    EXPECT_GT(sigma, 0.027);
}

TEST(Loss, AWrongReadingPullsLess) {
    const Solid truth = brilliant();
    std::vector<Reading> readings = noisy(full_readings(truth), 6);
    const std::size_t bad = index_of(readings, ReadingKind::inclination, find_facet(truth, "P2"));
    readings[bad].value += 40 * readings[bad].sigma;
    const auto error = [&](Loss loss) {
        FitOptions options;
        options.loss = loss;
        const FitResult result = fit_stone(stone_of(truth), readings, options);
        if (loss != Loss::none) {
            EXPECT_LT(result.readings[bad].weight, 0.1);
        }
        const std::size_t p2 = std::size_t(find_facet(truth, "P2"));
        return std::abs(result.facets[p2].inclination - radians(40.8));
    };
    const double plain = error(Loss::none);
    EXPECT_LT(error(Loss::huber), 0.5 * plain);
    EXPECT_LT(error(Loss::cauchy), 0.2 * plain);
}

TEST(Refit, EndsWhereAFreshFitEnds) {
    const Solid truth = brilliant();
    std::vector<Reading> readings = noisy(full_readings(truth), 8);
    const Stone mesh = stone_of(shaken(truth, 0.1, 4));
    const FitResult first = fit_stone(mesh, readings);
    readings[30].value += 2 * readings[30].sigma;
    FitOptions options;
    options.start = first.solid;
    const FitResult again = fit_stone(mesh, readings, options), fresh = fit_stone(mesh, readings);
    EXPECT_EQ(again.status, fresh.status) << again.message;
    EXPECT_NEAR(again.statistics.chi2, fresh.statistics.chi2, 1e-4);
    for (std::size_t f = 0; f < truth.facets.size(); ++f) {
        EXPECT_NEAR(again.facets[f].inclination, fresh.facets[f].inclination, 1e-6);
    }
    options.start = cube();
    EXPECT_NEAR(fit_stone(mesh, readings, options).statistics.chi2, fresh.statistics.chi2, 1e-4);
}

class HardNumbers : public ::testing::Test {
protected:
    std::vector<Reading> box_readings(double sigma) const {
        std::vector<Reading> readings = all_angles(box_, sigma, "T");
        readings.push_back(depth(box_, sigma));
        readings.push_back(width(box_, 0, sigma));
        readings.push_back(width(box_, 90, sigma));
        return readings;
    }
    Solid box_ = cube();
};

TEST_F(HardNumbers, TinyUncertaintiesOfAllReadings) {
    std::vector<Reading> readings = box_readings(1e-12);
    const FitResult result = fit_stone(stone_of(box_), readings);
    EXPECT_EQ(result.statistics.rank_defect, 0) << result.message;
    EXPECT_NEAR(volume(result.solid), 8, 1e-9);
    EXPECT_LT(find(result, "volume")->sigma, 1e-9);
}

TEST_F(HardNumbers, HugeUncertaintiesLeaveEverythingOpen) {
    const FitResult result = fit_stone(stone_of(box_), box_readings(1e12));
    EXPECT_EQ(result.status, FitStatus::undetermined) << result.message;
    EXPECT_EQ(result.statistics.rank_defect, 12);
}

TEST_F(HardNumbers, OneTinyAmongOrdinaryOnesDecides) {
    std::vector<Reading> readings = box_readings(0.01);
    Reading tight = depth(box_, 1e-12);
    tight.value = 2.02;
    tight.id = "tight";
    readings.push_back(tight);
    Reading loose = depth(box_, 1e12);
    loose.value = 17;
    loose.id = "loose";
    readings.push_back(loose);
    const FitResult result = fit_stone(stone_of(box_), readings);
    EXPECT_NEAR(width_along(result.solid, {0, 0, 1}), 2.02, 1e-9) << result.message;
    EXPECT_EQ(result.status, FitStatus::converged) << result.message;
    EXPECT_NEAR(result.readings.back().redundancy, 1, 1e-6);
    EXPECT_NEAR(result.readings[result.readings.size() - 2].redundancy, 0, 1e-6);
}

TEST_F(HardNumbers, HundredsOfDuplicates) {
    std::vector<Reading> readings = box_readings(0.01);
    for (int i = 0; i < 400; ++i) {
        readings.push_back(depth(box_, 0.01));
        readings.back().id = fmt::format("again{}", i);
    }
    const FitResult result = fit_stone(stone_of(box_), readings);
    EXPECT_EQ(result.status, FitStatus::converged) << result.message;
    EXPECT_NEAR(find(result, "depth")->sigma, 0.01 / std::sqrt(401), 1e-4);
}

TEST_F(HardNumbers, OneReadingAndNone) {
    for (const std::size_t count : {0u, 1u}) {
        std::vector<Reading> readings;
        if (count == 1) readings.push_back(depth(box_, 0.01));
        const FitResult result = fit_stone(stone_of(box_), readings);
        EXPECT_EQ(result.status, FitStatus::undetermined);
        EXPECT_EQ(result.statistics.rank_defect, 12 - int(count));
        EXPECT_FALSE(result.findings.undetermined_words.empty());
        EXPECT_FALSE(result.findings.help.empty());
        EXPECT_TRUE(result.findings.help[0].closes);
    }
}

TEST(Report, HasTheKeysOfTheAssessment) {
    const Solid truth = brilliant();
    std::vector<Reading> readings = noisy(full_readings(truth), 5);
    readings[20].value += 20 * readings[20].sigma;
    readings[21].rounding = radians(0.1);
    const auto report = nlohmann::json::parse(fit_report(fit_stone(stone_of(truth), readings)));
    for (const char* key :
         {"proportions", "disagreeing", "proposals", "undetermined_words", "help"}) {
        EXPECT_TRUE(report.contains(key)) << key;
    }
    EXPECT_EQ(report["options"]["loss"], "none");
    EXPECT_EQ(report["proposals"][0]["id"], readings[20].id);
    EXPECT_NEAR(report["readings"][21]["rounding"], 0.1, 1e-12);
    EXPECT_GE(report["help"].size(), 3u);
    EXPECT_TRUE(report["proportions"][0].contains("sigma"));
}

}  // namespace
}  // namespace culet
