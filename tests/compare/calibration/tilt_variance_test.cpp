// Differences from causes of known size: the estimate has closed forms, or an expectation.

#include "compare/calibration/tilt_variance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "stone/text/errors.h"

namespace culet {
namespace {

using Column = std::vector<double>;

// The estimate's rows are kept as floats.
constexpr double k_rounding = 1e-5;

struct RandomModel {
    explicit RandomModel(unsigned seed) : random(seed) {}

    Column column(std::size_t samples, double size = 1) {
        Column values(samples);
        for (double& v : values) v = size * normal(random);
        return values;
    }
    std::vector<Column> columns(std::size_t count, std::size_t samples) {
        std::vector<Column> result;
        // Strengths from one to a thirtieth: facets differ by as much.
        for (std::size_t k = 0; k < count; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(count);
            result.push_back(column(samples, std::pow(30.0, -share)));
        }
        return result;
    }

    std::mt19937_64 random;
    std::normal_distribution<double> normal;
};

void add(Column& to, const Column& column, double times) {
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += times * column[i];
}

TEST(TiltVariance, OfOneCauseIsItsSize) {
    const TiltVariance variance({{{1, 2, -2}}, {}, {1, 1, 1}});
    EXPECT_NEAR(*variance.rms({0.3, 0.6, -0.6}), 0.3, k_rounding);
    EXPECT_NEAR(*variance.rms({-0.3, -0.6, 0.6}), 0.3, k_rounding);
    EXPECT_NEAR(*variance.rms({2, -1, 0}), 0, k_rounding);  // orthogonal to it
    EXPECT_EQ(*variance.rms({0, 0, 0}), 0);
}

TEST(TiltVariance, OfCausesThatDoNotOverlapIsTheirRootMeanSquare) {
    const TiltVariance variance({{{2, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 2, 0}}, {}, {1, 1, 1, 1}});
    EXPECT_NEAR(*variance.rms({2 * 0.1, -2 * 0.2, 2 * 0.2, 7}), std::sqrt(0.09 / 3), k_rounding);
}

// In every direction the mean square of y / s is the causes' variance, for any weights. The mean of
// 2000 squares of a normal number is known to sqrt(2 / 2000) = 3.2 %, of several to less; four of
// these are allowed.
TEST(TiltVariance, IsRightInTheMeanForCausesOfAnyStrength) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        RandomModel random(seed);
        const std::size_t samples = 60 + 10 * seed, causes = 5 + 5 * seed;
        TiltModel model{random.columns(causes, samples), random.columns(3, samples),
                        Column(samples, 1.0)};
        for (double& n : model.noise) n = std::exp(random.normal(random.random));
        const TiltVariance variance(model);
        ASSERT_TRUE(variance.usable());
        const double truth = 0.2;
        double squares = 0;
        for (int draw = 0; draw < 2000; ++draw) {
            Column difference(samples, 0);
            for (const Column& change : model.changes) {
                add(difference, change, truth * random.normal(random.random));
            }
            squares += std::pow(*variance.rms(difference), 2) / 2000;
        }
        EXPECT_NEAR(squares / (truth * truth), 1, 0.13);
    }
}

// The best possible from so many causes of equal strength: the root mean square of 40 normal
// numbers scatters by 1 / sqrt(80) = 11 %, known to 3 % from 500 draws. A plain sum of squares over
// the picture, with strengths of 1 to 1/30, would depend on a fourth of the causes.
TEST(TiltVariance, ScattersLittleMoreThanSoManyCausesMust) {
    RandomModel random(11);
    const std::size_t samples = 400;
    const TiltModel model{random.columns(40, samples), {}, Column(samples, 1.0)};
    const TiltVariance variance(model);
    double sum = 0, squares = 0;
    for (int draw = 0; draw < 500; ++draw) {
        Column difference = random.column(samples, 1e-3);
        for (const Column& change : model.changes) {
            add(difference, change, 0.1 * random.normal(random.random));
        }
        const double log = std::log(*variance.rms(difference));
        sum += log / 500;
        squares += log * log / 500;
    }
    EXPECT_LT(std::sqrt(squares - sum * sum), 1.5 / std::sqrt(80.0));
}

TEST(TiltVariance, DoesNotSeeNuisances) {
    for (unsigned seed = 21; seed <= 25; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        RandomModel random(seed);
        TiltModel model{random.columns(8, 50), random.columns(4, 50), Column(50, 1.0)};
        // A nuisance equal to another one, and one of zero.
        model.nuisances.push_back(model.nuisances.front());
        model.nuisances.push_back(Column(50, 0.0));
        const TiltVariance variance(model);
        Column difference = random.column(50);
        const double before = *variance.rms(difference);
        for (const Column& nuisance : model.nuisances) {
            add(difference, nuisance, random.normal(random.random));
        }
        EXPECT_NEAR(*variance.rms(difference), before, 10 * k_rounding * before);
    }
}

TEST(TiltVariance, HardlyLooksWhereTheNoiseIs) {
    RandomModel random(31);
    TiltModel model{random.columns(8, 50), {}, Column(50, 1.0)};
    model.noise[7] = 1e6;
    const TiltVariance variance(model);
    Column difference = random.column(50);
    const double before = *variance.rms(difference);
    difference[7] += 100;
    EXPECT_NEAR(*variance.rms(difference), before, 10 * k_rounding * before);
    // Only ratios count.
    for (double& n : model.noise) n *= 1000;
    EXPECT_NEAR(*TiltVariance(model).rms(difference), before, 10 * k_rounding * before);
}

TEST(TiltVariance, OfNoiseAloneIsSmall) {
    RandomModel random(41);
    const TiltVariance variance({random.columns(20, 300), {}, Column(300, 1.0)});
    // Strengths of 1 to 1/30 over 300 samples: noise of 0.001 looks like 0.001 / sqrt(300) to 30
    // times that.
    EXPECT_LT(*variance.rms(random.column(300, 1e-3)), 30 * 1e-3 / std::sqrt(300.0));
}

TEST(TiltVariance, OfCausesThatChangeNothingOfTheirOwnIsNotUsable) {
    EXPECT_FALSE(TiltVariance({{}, {}, {1, 1}}).usable());
    EXPECT_FALSE(TiltVariance({{}, {}, {}}).usable());
    const TiltVariance nothing({{{0, 0}, {0, 0}}, {}, {1, 1}});
    EXPECT_FALSE(nothing.usable());
    EXPECT_FALSE(nothing.rms({1, 1}));
    EXPECT_FALSE(TiltVariance({{{1, 2, 3}}, {{2, 4, 6}}, {1, 1, 1}}).usable());
    // One cause that shows and one that does not: the former counts.
    const TiltVariance one({{{0, 0}, {3, 0}}, {}, {1, 1}});
    EXPECT_NEAR(*one.rms({1, 5}), 1.0 / 3, k_rounding);
}

TEST(TiltVariance, OfColumnsOfOtherSizesIsOurMistake) {
    EXPECT_THROW(TiltVariance({{{1, 2}}, {}, {1, 1, 1}}), InternalError);
    EXPECT_THROW(TiltVariance({{{1, 2}}, {{1}}, {1, 1}}), InternalError);
    EXPECT_THROW(TiltVariance({{{1, 2}}, {}, {1, 1}}).rms({1}), InternalError);
}

}  // namespace
}  // namespace culet
