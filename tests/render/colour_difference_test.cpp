#include "render/colour/colour_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>

namespace culet {
namespace {

struct Pair {
    Lab first, second;
    double difference;
};

// Sharma, Wu and Dalal (2005), table 1: L*, a*, b* of both samples and their CIEDE2000 difference.
const Pair k_sharma[] = {
    {{50.0000, 2.6772, -79.7751}, {50.0000, 0.0000, -82.7485}, 2.0425},
    {{50.0000, 3.1571, -77.2803}, {50.0000, 0.0000, -82.7485}, 2.8615},
    {{50.0000, 2.8361, -74.0200}, {50.0000, 0.0000, -82.7485}, 3.4412},
    {{50.0000, -1.3802, -84.2814}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, -1.1848, -84.8006}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, -0.9009, -85.5211}, {50.0000, 0.0000, -82.7485}, 1.0000},
    {{50.0000, 0.0000, 0.0000}, {50.0000, -1.0000, 2.0000}, 2.3669},
    {{50.0000, -1.0000, 2.0000}, {50.0000, 0.0000, 0.0000}, 2.3669},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0009}, 7.1792},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0010}, 7.1792},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0011}, 7.2195},
    {{50.0000, 2.4900, -0.0010}, {50.0000, -2.4900, 0.0012}, 7.2195},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0009, -2.4900}, 4.8045},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0010, -2.4900}, 4.8045},
    {{50.0000, -0.0010, 2.4900}, {50.0000, 0.0011, -2.4900}, 4.7461},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 0.0000, -2.5000}, 4.3065},
    {{50.0000, 2.5000, 0.0000}, {73.0000, 25.0000, -18.0000}, 27.1492},
    {{50.0000, 2.5000, 0.0000}, {61.0000, -5.0000, 29.0000}, 22.8977},
    {{50.0000, 2.5000, 0.0000}, {56.0000, -27.0000, -3.0000}, 31.9030},
    {{50.0000, 2.5000, 0.0000}, {58.0000, 24.0000, 15.0000}, 19.4535},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.1736, 0.5854}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2972, 0.0000}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 1.8634, 0.5757}, 1.0000},
    {{50.0000, 2.5000, 0.0000}, {50.0000, 3.2592, 0.3350}, 1.0000},
    {{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
    {{63.0109, -31.0961, -5.8663}, {62.8187, -29.7946, -4.0864}, 1.2630},
    {{61.2901, 3.7196, -5.3901}, {61.4292, 2.2480, -4.9620}, 1.8731},
    {{35.0831, -44.1164, 3.7933}, {35.0232, -40.0716, 1.5901}, 1.8645},
    {{22.7233, 20.0904, -46.6940}, {23.0331, 14.9730, -42.5619}, 2.0373},
    {{36.4612, 47.8580, 18.3852}, {36.2715, 50.5065, 21.2231}, 1.4146},
    {{90.8027, -2.0831, 1.4410}, {91.1528, -1.6435, 0.0447}, 1.4441},
    {{90.9257, -0.5406, -0.9208}, {88.6381, -0.8985, -0.7239}, 1.5381},
    {{6.7747, -0.2908, -2.4247}, {5.8714, -0.0985, -2.2286}, 0.6377},
    {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082},
};

TEST(ColourDifference, The34PublishedPairsComeOut) {
    double sum = 0;
    for (const Pair& pair : k_sharma) {
        // Printed to four places.
        EXPECT_NEAR(ciede2000(pair.first, pair.second), pair.difference, 0.5e-4 + 1e-9);
        EXPECT_NEAR(ciede2000(pair.second, pair.first), pair.difference, 0.5e-4 + 1e-9);
        sum += pair.difference;
    }
    // Also checks the table above: a changed digit on either side shows here.
    EXPECT_EQ(std::size(k_sharma), 34u);
    EXPECT_NEAR(sum, 183.1864, 1e-4);
}

TEST(ColourDifference, EqualColoursDoNotDiffer) {
    EXPECT_EQ(ciede2000({31, 12, -40}, {31, 12, -40}), 0);
}

// CIE 15: white is L* = 100 and without chroma; 18 % grey is L* = 49.5; every grey is neutral.
TEST(ColourDifference, WhiteAndGreyHaveTheirLightness) {
    const Lab white = lab_from_linear_srgb(1, 1, 1);
    EXPECT_NEAR(white.L, 100, 1e-9);
    const Lab grey = lab_from_linear_srgb(0.18, 0.18, 0.18);
    EXPECT_NEAR(grey.L, 116 * std::cbrt(0.18) - 16, 1e-9);
    for (const double v : {0.0, 1e-4, 0.003, 0.2, 1.0}) {
        const Lab lab = lab_from_linear_srgb(v, v, v);
        EXPECT_NEAR(lab.a, 0, 1e-9);
        EXPECT_NEAR(lab.b, 0, 1e-9);
    }
}

// sRGB red in CIELAB (D65), widely published: 53.24, 80.09, 67.20. Those figures come from a matrix
// of seven digits; the four digits of IEC 61966-2-1 move them by up to 0.03.
TEST(ColourDifference, SrgbRedHasItsPublishedLab) {
    const Lab red = lab_from_linear_srgb(1, 0, 0);
    EXPECT_NEAR(red.L, 53.24, 0.01);
    EXPECT_NEAR(red.a, 80.09, 0.02);
    EXPECT_NEAR(red.b, 67.20, 0.03);
}

}  // namespace
}  // namespace culet
