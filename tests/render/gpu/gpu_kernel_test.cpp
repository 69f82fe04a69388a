// The GPU kernel against the reference, along the same rays.
//
// Bounds: the requirement is 2e-3 of the mean, outside pixels at edges of the path pattern. Single
// precision must be far better in smooth lights: a path of seven faces turns a rounding error of
// 6e-8 of the stone's size into some 1e-6 in place and angle, and the light's slope per radian is
// of order 1 to 10. Some pixels may take another path: those whose ray passes an edge of a facet or
// light by less than that rounding error. A pixel is some 1/80 of the stone, so this is 1e-4 of a
// pixel beside an edge; with some ten edges through every pixel it is one pixel in a thousand.

#include "tests/render/gpu/gpu_scenes.h"

#include <fmt/format.h>

#include "stone/material/material_io.h"
#include "stone/solid/perpendicular.h"
#include "tests/render/bench_scenes.h"

namespace culet {
namespace {

constexpr double k_bound = 2e-3;
constexpr double k_single_precision = 2e-5;
constexpr double k_decided_otherwise = 1e-3;

Scene facing(const Solid& solid) {
    Scene scene = plain_scene(solid);
    look(scene, {0.21, 0.34, 1}, 10);
    scene.camera.width = scene.camera.height = 160;
    scene.settings.depth = 7;
    scene.lights.constant = 0.1;
    scene.lights.sources = {CosinePowerLight{glm::normalize(Vec3{0.3, 0.2, 1}), 16, {4.7}},
                            CosinePowerLight{glm::normalize(Vec3{-1, 0.4, 0.5}), 8, {2.0}}};
    return scene;
}

PixelErrors gpu_against(const Scene& scene, const std::string& engine) {
    return errors_of(with_engine(scene, "gpu", 1).picture, with_engine(scene, engine, 1).picture,
                     inner_pixels(scene));
}

// `pixels`: at least this many must remain away from edges, else the measurement says little.
void expect_near(const PixelErrors& errors, double bound, int pixels) {
    EXPECT_LE(errors.inner_rms, bound) << errors;
    EXPECT_GE(errors.inner, pixels) << errors;
    EXPECT_LE(errors.off, 1 + k_decided_otherwise * errors.stone) << errors;
    EXPECT_EQ(errors.not_finite, 0);
}

using GpuKernel = GpuTest;

TEST_F(GpuKernel, DrawsARoundBrilliantAsTheReferenceDoes) {
    for (const bool polarised : {false, true}) {
        SCOPED_TRACE(polarised ? "polarised" : "not polarised");
        Scene scene = facing(round_brilliant());
        scene.camera.width = scene.camera.height = 320;
        set_polarised(scene, polarised);
        expect_near(gpu_against(scene, k_reference_engine), k_single_precision, 10000);
    }
}

TEST_F(GpuKernel, TakesEveryWavelengthItsOwnWay) {
    Scene scene = facing(round_brilliant());
    scene.stone.material = catalogue_material("diamond");
    for (const std::vector<double>& nm : std::vector<std::vector<double>>{
             {450, 550, 610}, {410, 450, 490, 530, 570, 610, 650, 690}}) {
        SCOPED_TRACE(nm.size());
        scene.settings.wavelengths_nm = nm;
        expect_near(gpu_against(scene, k_reference_engine), k_single_precision, 500);
    }
}

void expect_as_reference(const NamedChange& light, const NamedChange& change) {
    SCOPED_TRACE(light.name + ", " + change.name);
    Scene scene = facing(round_brilliant());
    scene.camera.width = scene.camera.height = 80;
    scene.settings.depth = 5;
    light.make(scene);
    change.make(scene);
    expect_near(gpu_against(scene, k_reference_engine), k_bound, 50);
}

TEST_F(GpuKernel, DrawsEveryLight) {
    const std::vector<NamedChange> all = optics();
    for (const std::vector<NamedChange>& lights : {edgeless_lights(), edged_lights()}) {
        for (const NamedChange& light : lights) {
            expect_as_reference(light, all[0]);
            expect_as_reference(light, all[4]);
        }
    }
}

TEST_F(GpuKernel, DrawsEveryOptics) {
    for (const NamedChange& change : optics()) expect_as_reference(edged_lights().back(), change);
}

TEST_F(GpuKernel, SeesAnEnvironment) {
    Scene scene = facing(round_brilliant());
    scene.lights = {};
    scene.lights.environment = smooth_environment();
    scene.settings.wavelengths_nm = {450, 550, 610};
    expect_near(gpu_against(scene, k_reference_engine), k_single_precision, 1000);
}

TEST_F(GpuKernel, AbsorbsAsGarnetDoes) {
    Scene scene = facing(round_brilliant());
    scene.stone.unit = LengthUnit::mm;
    scene.stone.material = catalogue_material("garnet_almandine");
    scene.settings.wavelengths_nm = {450, 500, 550, 600, 650};
    expect_near(gpu_against(scene, k_reference_engine), k_single_precision, 1000);
    scene.settings.effects_auto = false;
    scene.settings.effects.fill(true);
    scene.settings.effects[static_cast<std::size_t>(Effects::dispersion)] = false;
    SCOPED_TRACE("five wavelengths on one way");
    expect_near(gpu_against(scene, k_reference_engine), k_single_precision, 1000);
}

TEST_F(GpuKernel, DrawsRandomStonesOfAnyView) {
    std::mt19937_64 random(40);
    for (int i = 0; i < 12; ++i) {
        SCOPED_TRACE(fmt::format("seed 40, stone {}", i));
        Scene scene = facing(random_stone(random, 10 + 4 * i));
        scene.stone.material.index[0].n = 1.3 + 0.1 * i;
        look(scene, random_direction(random), i % 2 == 0 ? 4 : 1000, 1.5);
        scene.settings.depth = 5;
        expect_near(gpu_against(scene, k_reference_engine), k_bound, 500);
    }
}

// Every kind of polarised light, with a retarder and an analyser.
Scene polarised_scene() {
    Scene scene = facing(round_brilliant());
    scene.camera.optics.analyzer = 0.5;
    scene.camera.optics.retarder = {137, 1.2};
    scene.lights.constant = 1;
    scene.lights.polarisation = LinearPolarisation{glm::normalize(Vec3{1, 0.2, 0}), {}, 1};
    CosinePowerLight lobe;
    lobe.direction = glm::normalize(Vec3{0.3, 0.2, 1});
    lobe.exponent = 3;
    lobe.radiance.value = 2.0;
    lobe.radiance.polarisation = LinearPolarisation{{0, 1, 0}, {}, 0.7};
    DiscLight cap;
    cap.direction = glm::normalize(Vec3{-1, 0.3, 1});
    cap.to = 0.6;
    cap.radiance.value = 3.0;
    cap.radiance.polarisation =
        LinearPolarisation{perpendicular_to(cap.direction), cap.direction, 1};
    scene.lights.sources = {lobe, cap};
    return scene;
}

TEST_F(GpuKernel, SeesPolarisedLightThroughAnAnalyserAndAPlate) {
    Scene scene = polarised_scene();
    expect_near(gpu_against(scene, k_reference_engine), k_bound, 1000);
    // Every ray along the table's normal: no plane of incidence at the first face.
    look(scene, {0, 0, 1}, 10);
    scene.camera.orthographic_width = 2.2;
    expect_near(gpu_against(scene, k_reference_engine), k_bound, 1000);
}

TEST_F(GpuKernel, HasAllFourStokesParameters) {
    Scene scene = polarised_scene();
    scene.settings.depth = 5;
    scene.settings.spectral = true;
    scene.settings.wavelengths_nm = {450, 550, 610, 650};
    const Picture gpu = with_engine(scene, "gpu", 1).picture,
                  reference = with_engine(scene, "reference", 1).picture;
    ASSERT_EQ(gpu.wavelengths_nm, reference.wavelengths_nm);
    ASSERT_EQ(gpu.spectral.size(), 4u);
    for (std::size_t node = 0; node < 4; ++node) {
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_EQ(gpu.polarised[k].size(), 4u);
            int off = 0;
            double largest = 0;
            for (std::size_t i = 0; i < gpu.pixels(); ++i) {
                const double exact = static_cast<double>(reference.polarised[k][node][i]);
                off += !(std::abs(static_cast<double>(gpu.polarised[k][node][i]) - exact) < 5e-4);
                largest = std::max(largest, std::abs(exact));
            }
            // Rays within rounding error of an edge of a facet or light.
            EXPECT_LE(off, 10) << "S" << k + 1 << " at node " << node;
            EXPECT_GT(largest, 0.05) << "S" << k + 1;
        }
    }
    EXPECT_LE(difference(gpu, reference, 1e-3).off, 10);
}

TEST_F(GpuKernel, MergesACrystalsWavesAsBeamsDo) {
    struct Crystal {
        const char* name;
        std::vector<double> n, absorption;
        bool coherent;
    };
    const std::vector<Crystal> crystals{
        {"tourmaline", {1.642, 1.622}, {0.9, 0.05}, false},
        {"positive", {1.76, 1.80}, {0, 0}, false},
        {"biaxial, three colours", {1.654, 1.67, 1.69}, {0.9, 0.05, 0.4}, false},
        {"tourmaline, coherent", {1.642, 1.622}, {0.9, 0.05}, true},
        {"biaxial, coherent", {1.654, 1.67, 1.69}, {0.2, 0.05, 0.4}, true}};
    for (const std::string cut : {"emerald", "round-brilliant"}) {
        for (const Crystal& crystal : crystals) {
            SCOPED_TRACE(cut + ", " + crystal.name);
            Scene scene = facing(cut == "emerald" ? make_cut("emerald", {{"width", 1.6}})
                                                  : round_brilliant());
            Material& material = scene.stone.material;
            material.optic =
                crystal.n.size() == 2 ? OpticCharacter::uniaxial : OpticCharacter::biaxial;
            for (std::size_t i = 0; i < crystal.n.size(); ++i) {
                material.index[i].n = crystal.n[i];
                material.absorption_per_mm[i] = Spectrum(crystal.absorption[i]);
            }
            const Vec3 a = glm::normalize(Vec3{0.3, 0.2, 1}), b = perpendicular_to(a);
            scene.stone.crystal.axes = {a, b, glm::cross(a, b)};
            if (crystal.coherent) {
                scene.camera.optics.analyzer = 0.4;
                scene.lights.polarisation = LinearPolarisation{{1, 0, 0}, {}, 1};
                scene.settings.coherence = true;
                scene.settings.bandwidth_nm = 10;
            }
            scene.settings.crystal_beams = CrystalBeams::merged;
            expect_near(gpu_against(scene, k_beam_engine), k_bound, 1000);
        }
    }
}

TEST_F(GpuKernel, AveragesSamplesAndPupilsAsTheReferenceDoes) {
    Scene scene = facing(round_brilliant());
    scene.camera.width = scene.camera.height = 60;
    scene.settings.depth = 5;
    scene.settings.filter = PixelFilter::gaussian;
    scene.settings.filter_radius = 1;
    const Difference plain = difference(with_engine(scene, "gpu", 9).picture,
                                        with_engine(scene, "reference", 9).picture);
    // Occasionally one ray of nine is on the other side of an edge.
    EXPECT_LE(plain.off, 3) << plain;
    EXPECT_LE(plain.mean, 1e-4) << plain;
    scene.camera.aperture_radius = 0.4;
    scene.camera.focus_distance = 9.5;
    for (const bool parallel : {false, true}) {
        if (parallel) scene.camera.orthographic_width = 2.4;
        const RenderResult gpu = with_engine(scene, "gpu", 12),
                           reference = with_engine(scene, "reference", 12);
        const Difference pupil = difference(gpu.picture, reference.picture);
        EXPECT_LE(pupil.off, 3) << pupil;
        EXPECT_LE(pupil.mean, 1e-4) << pupil;
        EXPECT_NEAR(gpu.stats.remainder, reference.stats.remainder, 1e-5);
        EXPECT_NEAR(gpu.stats.mean_radiance, reference.stats.mean_radiance,
                    1e-4 * reference.stats.mean_radiance);
        EXPECT_EQ(gpu.stats.depth, reference.stats.depth);
    }
}

}  // namespace
}  // namespace culet
