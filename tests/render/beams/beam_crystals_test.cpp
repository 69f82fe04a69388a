// Polarised light and crystals in beams, against the reference.

#include <gtest/gtest.h>

#include "stone/solid/perpendicular.h"
#include "tests/render/beams/beam_lights.h"

namespace {

using namespace culet;

// Every kind of polarised light, with a retarder and an analyser.
Scene polarised_scene() {
    Scene scene = plain_scene(round_brilliant());
    look(scene, {0.21, 0.34, 1}, 10);
    scene.camera.optics.analyzer = 0.5;
    scene.camera.optics.retarder = {137, 1.2};
    scene.lights.polarisation = LinearPolarisation{glm::normalize(Vec3{1, 0.2, 0}), {}, 1};
    CosinePowerLight lobe;
    lobe.direction = glm::normalize(Vec3{0.3, 0.2, 1});
    lobe.exponent = 3;
    lobe.radiance.value = 2.0;
    lobe.radiance.polarisation = LinearPolarisation{{0, 1, 0}, {}, 0.7};
    scene.lights.sources.push_back(lobe);
    // Behind a sheet light whose normal is turned into each ray.
    DiscLight cap;
    cap.direction = glm::normalize(Vec3{-1, 0.3, 1});
    cap.to = 0.6;
    cap.radiance.value = 3.0;
    cap.radiance.polarisation =
        LinearPolarisation{perpendicular_to(cap.direction), cap.direction, 1};
    scene.lights.sources.push_back(cap);
    return scene;
}

void give_crystal(Scene& scene, const std::vector<double>& n,
                  const std::vector<double>& absorption) {
    Material& material = scene.stone.material;
    material.optic = n.size() == 2 ? OpticCharacter::uniaxial : OpticCharacter::biaxial;
    for (std::size_t i = 0; i < n.size(); ++i) {
        material.index[i].n = n[i];
        material.absorption_per_mm[i] = Spectrum(absorption[i]);
    }
    const Vec3 a = glm::normalize(Vec3{0.3, 0.2, 1}), b = perpendicular_to(a);
    scene.stone.crystal.axes = {a, b, glm::cross(a, b)};
}

// Single rays carry the reference's Stokes parameters to single precision. Outliers are rays within
// rounding error of an edge of a facet or light.
TEST(PolarisedBeams, SeeWhatTheReferenceSeesThroughTheEyesOptics) {
    const Scene scene = polarised_scene();
    const Difference d = difference(with_engine(scene, "beams", 1).picture,
                                    with_engine(scene, "reference", 1).picture);
    EXPECT_LE(d.off, 3) << d;
    EXPECT_GT(d.pixels, 3000);
}

TEST(PolarisedBeams, HaveAllFourStokesParameters) {
    Scene scene = polarised_scene();
    scene.settings.spectral = true;
    const Picture beams = with_engine(scene, "beams", 1).picture,
                  reference = with_engine(scene, "reference", 1).picture;
    for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_EQ(beams.polarised[k].size(), 1u);
        int off = 0;
        double largest = 0;
        for (std::size_t i = 0; i < beams.pixels(); ++i) {
            const double exact = static_cast<double>(reference.polarised[k][0][i]);
            off += !(std::abs(static_cast<double>(beams.polarised[k][0][i]) - exact) < 5e-4);
            largest = std::max(largest, std::abs(exact));
        }
        EXPECT_LE(off, 3) << "S" << k + 1;
        EXPECT_GT(largest, 0.05) << "S" << k + 1;
    }
}

struct NamedCrystal {
    std::string name;
    std::vector<double> n, absorption;
    bool coherent;
};

// Merged waves follow one path with the mean index. Over some six segments the exact rays leave it
// by about |n1 - n2| in angle, here 1e-5. A pixel is 0.02, so only pixels within 1e-3 pixels of an
// edge may change, and coefficients change by 0.2 |n1 - n2| (notes on physics: Guy & Soler's
// merging). Coherent light turns by the phase, for which a hundredth of a wave is negligible.
TEST(MergedBeams, AreTheReferenceWhereTheSplitIsSmall) {
    const std::vector<NamedCrystal> crystals{
        {"positive", {1.76, 1.76001}, {0, 0}, false},
        {"negative, coherent", {1.76, 1.75998}, {0, 0}, true},
        {"dichroic", {1.76, 1.76001}, {0.9, 0.05}, false},
        {"biaxial, three colours", {1.76, 1.76001, 1.76003}, {0.9, 0.05, 0.4}, false},
        {"biaxial, coherent", {1.76, 1.76001, 1.76003}, {0.2, 0.05, 0.4}, true}};
    for (const NamedCrystal& crystal : crystals) {
        SCOPED_TRACE(crystal.name);
        Scene scene = plain_scene(round_brilliant());
        look(scene, {0.21, 0.34, 1}, 10);
        scene.settings.depth = 5;
        scene.lights.sources.push_back(
            CosinePowerLight{glm::normalize(Vec3{0.3, 0.2, 1}), 3, {2.0, {}}});
        give_crystal(scene, crystal.n, crystal.absorption);
        if (crystal.coherent) {
            scene.camera.optics.analyzer = 0.4;
            scene.lights.polarisation = LinearPolarisation{{1, 0, 0}, {}, 1};
            scene.settings.coherence = true;
            scene.settings.bandwidth_nm = 10;
        }
        scene.settings.crystal_beams = CrystalBeams::merged;
        const Difference d = difference(with_engine(scene, "beams", 1).picture,
                                        with_engine(scene, "reference", 1).picture, 5e-3);
        EXPECT_LE(d.share_off(), 5e-3) << d;
        EXPECT_LE(d.mean, 2e-3) << d;
    }
}

// Split waves are exact rays at a cell's middle and first order beside it. Powers are added, as in
// the reference without coherence; only pruned light is missing.
TEST(SplitBeams, AreTheReferenceInCrystalsOfStrongSplit) {
    std::mt19937_64 random(20290);
    const std::vector<NamedCrystal> crystals{
        {"zircon", {1.925, 1.984}, {0.05, 0.3}, false},
        {"calcite", {1.658, 1.486}, {0, 0}, false},
        {"biaxial", {1.654, 1.67, 1.69}, {0.3, 0, 0.1}, false}};
    for (const NamedCrystal& crystal : crystals) {
        SCOPED_TRACE("seed 20290, " + crystal.name);
        Scene scene = plain_scene(random_stone(random, 12));
        look(scene, random_direction(random), 9, 1.5);
        scene.settings.depth = 4;
        scene.lights.sources.push_back(
            CosinePowerLight{glm::normalize(Vec3{0.3, 0.2, 1}), 3, {2.0, {}}});
        give_crystal(scene, crystal.n, crystal.absorption);
        scene.settings.crystal_beams = CrystalBeams::split;
        const RenderResult beams = with_engine(scene, "beams", 1),
                           exact = with_engine(scene, "reference", 1);
        // Off by more than a hundredth: pixels next to edges, which a map displaces by about a
        // hundredth of a pixel, and next to total reflection, where first order fails.
        const Difference d = difference(beams.picture, exact.picture, 1e-2);
        EXPECT_LE(d.share_off(), 0.04) << d;
        EXPECT_LE(d.mean, 5e-3) << d;
        EXPECT_NEAR(beams.stats.remainder, exact.stats.remainder, 5e-3);
        EXPECT_NEAR(beams.stats.absorbed, exact.stats.absorbed, 5e-3);
    }
}

TEST(SplitBeams, SeePolarisedLightsAndAnalysers) {
    Scene scene = polarised_scene();
    scene.settings.depth = 4;
    give_crystal(scene, {1.925, 1.984}, {0, 0});
    scene.settings.coherence = false;
    scene.settings.crystal_beams = CrystalBeams::split;
    const Difference d = difference(with_engine(scene, "beams", 1).picture,
                                    with_engine(scene, "reference", 1).picture, 1e-2);
    EXPECT_LE(d.share_off(), 0.06) << d;
    EXPECT_LE(d.mean, 1e-2) << d;
}

// In a constant light of 1 a pixel that the stone fills shows 1 less the remainder.
TEST(SplitBeams, BalanceInAFurnace) {
    Scene scene = plain_scene(round_brilliant());
    look(scene, {0.21, 0.34, 1}, 10);
    give_crystal(scene, {1.925, 1.984}, {0, 0});
    scene.settings.depth = 5;
    scene.settings.crystal_beams = CrystalBeams::split;
    const RenderStats stats = with_engine(scene, "beams", 16).stats;
    // Maps are first order within a cell; weights are curved next to total reflection.
    EXPECT_NEAR(stats.mean_radiance + stats.remainder, 1, 2e-3);
}

TEST(CrystalBeams, PartWhereTheTwoImagesAreSeenApart) {
    Scene scene = plain_scene(round_brilliant());
    look(scene, {0.21, 0.34, 1}, 10);
    const auto said = [&] {
        return with_engine(scene, "beams", 1)
            .stats.effects[static_cast<std::size_t>(Effects::birefringence)]
            .why;
    };
    scene.settings.depth = 3;
    give_crystal(scene, {1.925, 1.984}, {0, 0});
    EXPECT_NE(said().find("split"), std::string::npos) << said();
    give_crystal(scene, {1.925, 1.925001}, {0, 0});
    EXPECT_NE(said().find("merged"), std::string::npos) << said();
    give_crystal(scene, {1.925, 1.984}, {0, 0});
    scene.settings.coherence = true;
    EXPECT_NE(said().find("merged: the two waves interfere"), std::string::npos) << said();
}

}  // namespace
