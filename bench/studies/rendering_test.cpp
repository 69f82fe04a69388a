// Voelker & Hamann, Lee, diamond-webgl and Deng: the main numbers of their studies.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "bench/frame_time.h"
#include "bench/studies/cube_map_light.h"
#include "bench/studies/sampling_noise.h"
#include "bench/studies/scenes.h"
#include "bench/studies/table_cost.h"
#include "bench/studies/table_flip.h"
#include "render/beams/beam_tree.h"
#include "render/beams/screen_view.h"
#include "render/raytable/ray_table.h"
#include "stone/cuts/cuts.h"
#include "tests/render/bench_scenes.h"

namespace culet {
namespace {

Scene brilliant(double diameters, int pixels, int depth) {
    return tree_scene(base_scene(pixels).stone.solid, catalogue_material("diamond"), diameters,
                      pixels, depth);
}

// Perspective refraction is right to first order in the angle between a front facet's rays, which
// falls with the distance. So does the width of the strips along edges where it is wrong: half at
// twice the distance, up to the next order of about a twentieth. The tolerance is four standard
// deviations of a count of independent pixels; in strips a few go together.
TEST(VoelkerHamann, PerspectiveRefractionIsOffInProportionToTheFieldOfView) {
    const auto off = [](double diameters) {
        Scene scene = drawn_as(brilliant(diameters, 240, 6), Drawing::exact, 0);
        scene.settings.refraction = Refraction::perspective;
        return static_cast<double>(FrameRenderer(scene).draw().stats.retraced);
    };
    const double near = off(20), far = off(40);
    const double chance = 4 * std::sqrt(3 * (1 / near + 1 / far));
    EXPECT_NEAR(near / far, 2, 2 * (0.05 + chance));
}

// Reflections between planes are not chaotic: the number of sequences of facets grows more slowly
// than any exponential (Katok, The growth rate for the number of singular and periodic orbits for a
// polygonal billiard, 1987). So the factor from one depth to the next falls; it would be constant
// if every beam split into as many.
TEST(VoelkerHamann, BeamsDoNotGrowExponentiallyWithTheDepth) {
    const Scene scene = brilliant(6, 400, 8);
    const FacetNet net(scene.stone.solid);
    const auto beams = [&](int depth) {
        BeamLimits limits;
        limits.depth = depth;
        BeamTree tree;
        build_beams(net, screen_view(scene.camera), 2.417, limits, tree);
        return static_cast<double>(tree.grown());
    };
    double before = beams(4), factor = before / beams(2);
    for (int depth = 6; depth <= 14; depth += 2) {
        const double now = beams(depth);
        EXPECT_LT(now / before, factor) << depth;
        factor = now / before;
        before = now;
    }
}

// A cut path would have seen at most the brightest light: lobes of 4.7, 2 and 1 and 0.1 from all
// around, together less than 7.8.
TEST(GuySoler, ATreeCutAtFourPerCentLosesNoMoreThanItReports) {
    const auto drawn = [](double cut) {
        Scene scene = tree_scene(stone_of_facets(115), catalogue_material("diamond"), 6, 120, 8);
        scene.settings.tolerance = cut > 0 ? 1e-9 : 0;  // with 0 nothing is cut
        scene.settings.cut_weight = cut;
        FrameRenderer frames(drawn_as(scene, Drawing::averaged, 0));
        frames.draw();
        return frames.take();
    };
    const RenderResult whole = drawn(0), cut = drawn(0.04);
    EXPECT_LT(cut.stats.beams, whole.stats.beams);
    const double lost = whole.stats.mean_radiance - cut.stats.mean_radiance;
    EXPECT_GE(lost, 0);
    EXPECT_LE(lost, 7.8 * (cut.stats.remainder - whole.stats.remainder));
}

// Without dispersion the three trees are the same.
TEST(GuySoler, OneTreeServesThreeWavelengthsOfOneIndex) {
    Material glass;
    glass.index[0].n = 1.7;
    Scene scene = tree_scene(stone_of_facets(93), glass, 6, 80, 6);
    scene.settings.wavelengths_nm = k_three_wavelengths;
    scene = drawn_as(scene, Drawing::averaged, 0);
    const Picture three = FrameRenderer(scene).draw().picture;
    scene.settings.effects[static_cast<std::size_t>(Effects::dispersion)] = false;
    EXPECT_EQ(FrameRenderer(scene).draw().picture.rgb, three.rgb);
}

TEST(GuySoler, TheirStonesHaveAsManyFacets) {
    for (const int facets : {93, 115})
        EXPECT_EQ(stone_of_facets(facets).facets.size(), static_cast<std::size_t>(facets));
}

// docs/ray-tables.md: a table's picture is the reference's up to single-precision rounding and
// direction errors of 4e-7 radians. The light changes by less than 20 of its peak per radian (lobes
// of exponent 16).
TEST(Lee, NewLightFromATableIsTheReferencesPicture) {
    const TableCost cost = table_cost(brilliant(6, 60, 6));
    EXPECT_LT(cost.difference, 20 * 4e-7 + 1e-5);
}

// A ray of a convex stone leaves at the front, by reflection, and then at most once per face.
TEST(Lee, ATableOfAConvexStoneHasAtMostOneExitAFace) {
    for (const int depth : {2, 5, 9}) {
        const TableCost cost = table_cost(brilliant(6, 40, depth));
        EXPECT_LE(cost.exits, cost.hits * depth) << depth;
        EXPECT_GE(cost.exits, cost.hits) << depth;
        // Exits, and for each ray 4 bytes for its pixel, its distance and its last exit.
        EXPECT_NEAR(cost.bytes,
                    static_cast<double>(cost.exits) * static_cast<double>(exit_bytes(1)) +
                        static_cast<double>(cost.hits) * 12,
                    20000)
            << depth;  // the header and the facets' frames
    }
}

// The closed form agrees to the bisection's width.
TEST(DiamondWebgl, TheTablesColourFlipsWhereTheLawOfRefractionSays) {
    for (const double n : {2.2, 2.4175, 2.65})
        EXPECT_NEAR(table_flip_deg(n), closed_form_table_flip_deg(n), 2e-6) << n;
}

// Moving a boundary neither makes nor loses light; a smaller head gives less blue.
TEST(DiamondWebgl, ItsBoundariesMoveLightFromOneColourToAnother) {
    const EyeLight light = EyeLightTracer(make_cut("round-brilliant")).trace({0, 0, 1}, 2.4175);
    const AsetShares ags = aset_shares(light),
                     other = aset_shares(light, -1, diamond_webgl_bands());
    EXPECT_NEAR(other.red + other.green + other.blue + other.dark, 1, 1e-9);
    EXPECT_NEAR(other.dark, ags.dark, 1e-12);
    EXPECT_LT(other.blue, ags.blue);
    EXPECT_LT(other.green, ags.green);
}

// Across a stone of diameter 1 the direction to a window changes by 1 / distance. An edge of light
// is misplaced by that much, and the error is proportional: half at twice the distance, up to the
// next order, 1 / distance.
TEST(DiamondWebgl, ACubeMapsErrorFallsWithTheDistanceOfTheLight) {
    Scene scene = brilliant(6, 120, 6);
    const double size = diameter(scene.stone.solid);
    const double near = cube_map_error(scene, windows_at(6 * size), 1024),
                 far = cube_map_error(scene, windows_at(12 * size), 1024);
    EXPECT_NEAR(near / far, 2, 2 * 2 / 6.0);
}

// Sixteen times the rays give a quarter of the noise if they are independent. Spread evenly over a
// pixel they do better at edges, at best rays^-3/4, an eighth (Mitchell, Consequences of stratified
// sampling in graphics, 1996). A tenth is allowed for chance in a small picture. The sun is
// excluded: what one ray in a thousand sees through the glass ball cannot be estimated from few
// samples.
TEST(Deng, NoiseFallsWithTheRootOfTheRaysAtLeast) {
    const auto noise = sampling_noise(CULET_SOURCE_DIR "/samples/plain-shading/spheres.toml", 64,
                                      {4, 64}, {"light.cap.0.radiance=0"});
    const double falls = noise[0].rms / noise[1].rms;
    EXPECT_GT(falls, 4 * 0.9);
    EXPECT_LT(falls, 8 * 1.1);
}

}  // namespace
}  // namespace culet
