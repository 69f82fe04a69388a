#pragma once
// How far a ray table's picture may be from the reference's along the same rays.
//
// Rounding (docs/ray-tables.md): weights to 2^-24 of themselves; directions to 1e-9, or 4e-7 where
// they are read in single precision; lengths to half a step; points to half a 65535th of their
// facet's extent. A sum of exits in single precision is off by some 2^-24 for each of its few
// operations: k_rounding allows for 16.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/render/raytable/table_scenes.h"

namespace culet::test {

inline constexpr double k_rounding = 16 * 0x1p-24, k_direction = 4e-7;

inline Scene lit(Scene scene, const Lights& lights) {
    scene.lights = lights;
    return scene;
}

// The slope of edgeless_lights' radiance with direction. The lobe L cos^e has a slope of at most L
// sqrt(e) exp(-1/2), and an exponent multiplies the rounding error of a cosine by e.
inline double slope_of_lobes() {
    return std::exp(-0.5) * (4.7 * std::sqrt(16) + 2 * std::sqrt(8) + std::sqrt(4));
}
inline double bound_of_lobes() {
    return k_direction * slope_of_lobes() + k_rounding * (0.1 + 4.7 * 16 + 2 * 8 + 4) / 4;
}

// Where every exit sees the same side of each edge of a light, only rounding errors remain. At an
// edge single precision may decide otherwise. This bounds how many of some thousand pixels may
// differ in lights with so many edges: pixels x edges x 4e-7 radians over the least angle between
// neighbours' directions is far below one.
inline void expect_equal_but_for_rounding(const Scene& scene, const RayTable& table,
                                          double largest) {
    const Picture truth = by_reference(scene).picture;
    for (const ExitPrecision precision :
         {ExitPrecision::fastest, ExitPrecision::double_precision}) {
        const Picture picture = relit_by(table, scene, precision).picture;
        EXPECT_EQ(picture.coverage, truth.coverage);
        const Apart off = apart(picture, truth);
        EXPECT_GT(off.brightest, 0.1);
        EXPECT_LT(off.worst, k_rounding * largest)
            << (precision == ExitPrecision::fastest ? "fast" : "plain");
    }
}

}  // namespace culet::test
