#include "compare/refine/picture_equations.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/refine/picture_misfit.h"
#include "compare/scores/chance.h"

namespace culet {
namespace {

constexpr int k_side = 64;
constexpr double k_blur = 1.5;

cv::Mat blurred_noise(Chance& chance) {
    cv::Mat noise(k_side, k_side, CV_32F), blurred;
    for (float& v : cv::Mat_<float>(noise)) v = float(chance.normal());
    cv::GaussianBlur(noise, blurred, cv::Size(), k_blur);
    return blurred;
}

Eigen::VectorXd values(const cv::Mat& picture) {
    Eigen::VectorXd all(k_side * k_side);
    for (int i = 0; i < k_side * k_side; ++i) {
        all[i] = double(picture.at<float>(i / k_side, i % k_side));
    }
    return all;
}

// Eight moves and two nuisances with patterns as smooth as the noise.
PictureEquations equations(Chance& chance) {
    PictureEquations e;
    e.mask = cv::Mat(k_side, k_side, CV_8U, cv::Scalar(255));
    e.changes.resize(k_side * k_side, 8);
    for (int k = 0; k < 8; ++k) e.changes.col(k) = values(blurred_noise(chance));
    e.nuisances.resize(k_side * k_side, 2);
    e.nuisances.col(0).setOnes();
    e.nuisances.col(1) = values(blurred_noise(chance));
    e.noise = Eigen::VectorXd::Constant(k_side * k_side, 0.01);
    e.nonlinearity = Eigen::VectorXd::Zero(k_side * k_side);
    e.spread = Eigen::VectorXd::Constant(8, 1.0);
    e.blur = k_blur;
    return e;
}

Eigen::VectorXd solved(const DeterminedMoves& determined) {
    return determined.rows.colPivHouseholderQr().solve(determined.values);
}

// Normalised errors of 30 pictures must have unit deviation. Of 240 errors the root mean square is
// 1 +- 0.046; Bartlett's taper removes about a tenth of the variance, and the moves absorb eight of
// some 150 independent samples.
TEST(PictureEquations, SayHowSureTheyAre) {
    Chance chance(3);
    double squares = 0;
    int count = 0;
    for (int trial = 0; trial < 30; ++trial) {
        PictureEquations e = equations(chance);
        Eigen::VectorXd moves(8);
        for (double& m : moves) m = chance.normal();
        e.difference = e.changes * moves + 0.3 * e.nuisances.col(0) - 0.2 * e.nuisances.col(1) +
                       0.2 * values(blurred_noise(chance));
        const DeterminedMoves determined = solved_moves(e);
        const Eigen::VectorXd off = determined.rows * moves - determined.values;
        squares += off.squaredNorm();
        count += int(off.size());
    }
    EXPECT_EQ(count, 240);
    const double rms = std::sqrt(squares / count);
    EXPECT_GT(rms, 0.85);
    EXPECT_LT(rms, 1.2);
}

TEST(PictureEquations, AreBlindToNuisances) {
    Chance chance(5);
    PictureEquations e = equations(chance);
    e.difference = e.changes.col(2) + 0.1 * values(blurred_noise(chance));
    const Eigen::VectorXd without = solved(solved_moves(e));
    e.difference += 7 * e.nuisances.col(0) + 3 * e.nuisances.col(1);
    const DeterminedMoves determined = solved_moves(e);
    EXPECT_LT((solved(determined) - without).norm(), 1e-6);
    // The nuisances' amounts are estimated beside the moves.
    const Eigen::VectorXd amounts =
        nuisances_beside(e, determined, solved(determined), Eigen::VectorXd::Zero(2));
    EXPECT_NEAR(amounts[0], 7, 0.05);
    EXPECT_NEAR(amounts[1], 3, 0.3);
}

// For equal pictures sigma is that of the least noise, and the moves are zero.
TEST(PictureEquations, OfEqualPicturesAreFinite) {
    Chance chance(11);
    PictureEquations e = equations(chance);
    e.difference = Eigen::VectorXd::Zero(k_side * k_side);
    const DeterminedMoves determined = solved_moves(e);
    EXPECT_TRUE(determined.rows.allFinite());
    EXPECT_LT(solved(determined).norm(), 1e-12);
    EXPECT_TRUE(nuisances_beside(e, determined, Eigen::VectorXd::Zero(8), Eigen::VectorXd::Zero(2))
                    .allFinite());
}

// A move without effect on the picture is not determined.
TEST(PictureEquations, TellNothingOfWhatDoesNotShow) {
    Chance chance(7);
    PictureEquations e = equations(chance);
    e.changes.col(4).setZero();
    e.difference = 0.2 * values(blurred_noise(chance));
    const DeterminedMoves determined = solved_moves(e);
    EXPECT_EQ(determined.rows.rows(), 7);
    EXPECT_LT(determined.rows.col(4).norm(), 1e-6 * determined.rows.norm());
}

TEST(PictureMisfit, FindsAFlashAndNoneInNoise) {
    Chance chance(9);
    cv::Mat difference = 0.02 * blurred_noise(chance);
    const cv::Mat mask(k_side, k_side, CV_8U, cv::Scalar(255));
    EXPECT_TRUE(picture_misfit(difference, mask).contradictions.empty());
    cv::circle(difference, {40, 12}, 3, cv::Scalar(-0.5), cv::FILLED);
    const auto found = picture_misfit(difference, mask).contradictions;
    ASSERT_EQ(found.size(), 1u);
    EXPECT_FALSE(found[0].is_brighter);
    EXPECT_NEAR(found[0].x, 40, 0.5);
    EXPECT_NEAR(found[0].y, 12, 0.5);
}

}  // namespace
}  // namespace culet
