// Guy & Soler, Graphics Gems Revisited (2004): the numbers of the study.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "bench/studies/merged_face.h"
#include "bench/studies/rgb_absorption.h"
#include "bench/studies/wave_angles.h"
#include "stone/numbers/units.h"

namespace culet {
namespace {

// Their table of section 4.2: 2.328 and 0.324 degrees. Handbooks give birefringences to three
// decimals; the one that each angle corresponds to must round to the handbook's.
TEST(GuySoler, AnglesOfZirconAndEmeraldStandForTheBirefringencesOfHandbooks) {
    const auto stands_for = [](double n_o, double n_e, double reported_deg) {
        return std::abs(n_e - n_o) * radians(reported_deg) / largest_wave_angle(n_o, n_e).angle;
    };
    EXPECT_NEAR(stands_for(1.925, 1.984, 2.328), 0.059, 0.0005);
    EXPECT_NEAR(stands_for(1.582, 1.576, 0.324), 0.006, 0.0005);
}

// The closed form is exact to first order in the birefringence, so its error is quadratic: a
// quarter where the birefringence is halved. The next order makes the ratio 4 (1 + O(0.01)).
TEST(GuySoler, TheClosedFormIsOffBySecondOrder) {
    const auto off = [](double difference) {
        const double n_o = 1.6 - difference / 2, n_e = 1.6 + difference / 2;
        return largest_wave_angle(n_o, n_e).angle - first_order_wave_angle(n_o, n_e);
    };
    EXPECT_NEAR(off(0.02) / off(0.01), 4, 0.2);
}

TEST(GuySoler, TheLargestAngleIsAtGrazingIncidenceWithTheAxisInItsPlane) {
    const WaveAngle found = largest_wave_angle(1.642, 1.619);
    EXPECT_NEAR(degrees(found.incidence), 90, 0.01);
    EXPECT_NEAR(found.axis.y, 0, 1e-4);
}

// Energy balance: for s and for p, what enters plus what is reflected equals what arrives.
TEST(GuySoler, BothFacesKeepAllLight) {
    const Vec3 axis = glm::normalize(Vec3{0.5, 0.4, 0.7});
    for (const double incidence : {0.0, 0.4, 0.9, 1.4}) {
        for (const FacePowers& face : {exact_face(1.925, 1.984, axis, incidence),
                                       merged_face(1.925, 1.984, axis, incidence)}) {
            EXPECT_NEAR(face.power[0] + face.power[1] + face.power[4] + face.power[5], 1, 1e-12);
            EXPECT_NEAR(face.power[2] + face.power[3] + face.power[6] + face.power[7], 1, 1e-12);
        }
    }
}

// Fresnel's coefficients are smooth in the indices: half the birefringence gives half the
// difference, up to second order (some hundredths here).
TEST(GuySoler, MergedCoefficientsAreOffInProportionToTheBirefringence) {
    const Vec3 axis = glm::normalize(Vec3{0.5, 0.4, 0.7});
    const double whole = largest_face_difference(1.925, 1.984, axis, 900),
                 half = largest_face_difference(1.93975, 1.96925, axis, 900);
    EXPECT_NEAR(whole / half, 2, 0.1);
}

// exp(-0.4) = 0.670320 against 0.6.
TEST(GuySoler, LinearAbsorptionIsOffByTenPerCentWhereTheyStateAThousandth) {
    EXPECT_NEAR(linear_absorption_error(0.4), 1 - 0.6 / 0.670320, 1e-6);
    const double x = thickness_of_linear_error(1.25e-5);
    EXPECT_NEAR(std::exp(-x) - (1 - x), 1.25e-5, 1e-15);
    // x^2 / 2 - x^3 / 6 = 1.25e-5.
    EXPECT_NEAR(x, 0.005, 1e-5);
}

// Grey absorption has no colour to lose: both ways give the same grey.
TEST(GuySoler, ThreeNumbersServeWhereAbsorptionIsGrey) {
    Material grey;
    grey.absorption_per_mm[0] = Spectrum(0.3);
    EXPECT_NEAR(transmitted_colour(grey, 0, 4).delta_e, 0, 1e-6);
}

}  // namespace
}  // namespace culet
