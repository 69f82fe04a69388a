// Expectations: closed forms of plates and retarders between polarisers, Beer and Lambert for each
// wave, and conservation. Scenes are read from text, as users write them.

#include "render/scene/view_presets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/image/image_io.h"
#include "render/reference/probe.h"
#include "render/reference/sampling.h"
#include "render/render.h"
#include "render/scene/scene_io.h"
#include "stone/cuts/cuts.h"
#include "stone/text/errors.h"
#include "tests/folder_test.h"

namespace {

using namespace culet;

class Views : public test::FolderTest {
protected:
    void SetUp() override {
        // A plate of 1 mm, 40 mm wide.
        std::vector<NamedPlane> planes;
        for (int axis = 0; axis < 3; ++axis) {
            for (int sign : {-1, 1}) {
                Vec3 n{0, 0, 0};
                n[axis] = sign;
                planes.push_back(
                    {"f" + std::to_string(2 * axis + (sign > 0)), {n, axis == 2 ? 0.5 : 20.0}});
            }
        }
        write_solid(intersect_half_spaces(planes).solid, folder_ / "plate.obj");
    }
    Scene scene(const std::string& text) const {
        std::ofstream(folder_ / "scene.toml") << text;
        return read_scene(folder_ / "scene.toml");
    }
    // Radiance in the middle of a one-wavelength picture of a few pixels.
    static double middle(const Scene& scene) {
        const RenderResult result = render(scene);
        const int x = scene.camera.width / 2, y = scene.camera.height / 2;
        return static_cast<double>(result.picture.at(x, y)[0]);
    }
    static std::string plate(const std::string& rest, const std::string& more = "") {
        return "mesh = \"plate.obj\"\n" + rest +
               "\n[camera]\nposition = [0, 0, 50]\northographic_width = 1\nsize = [4, 4]\n"
               "[render]\ndepth = 2\ntolerance = 0\nsamples = 1\n" +
               more + "\n";
    }
    // Radiance is stored as float.
    static constexpr double k_float = 1e-6;
};

const char* const k_quartz =
    "optic_axis = [1, 1, 0]\n[material]\noptic = \"uniaxial\"\nindex = { o = 1.544, e = 1.553 }\n";

TEST_F(Views, PolariscopeShowsThePlatesRetardation) {
    // The closed form of crystal_paths_test.cpp through the whole renderer: 45 degrees, crossed.
    const double t_o = 4 * 1.544 / (2.544 * 2.544), t_e = 4 * 1.553 / (2.553 * 2.553);
    for (const double nm : {450.0, 589.3, 640.0}) {
        const double delta = 2 * std::numbers::pi * 0.009 * 1e6 / nm;
        const std::string one = "wavelengths = [" + std::to_string(nm) + "]";
        const double crossed = middle(scene("preset = \"polariscope\"\n" + plate(k_quartz, one)));
        EXPECT_NEAR(crossed, 0.25 * (t_o * t_o + t_e * t_e - 2 * t_o * t_e * std::cos(delta)),
                    k_float);
        const double parallel = middle(scene(
            "preset = \"polariscope\"\npolariser = 0\nanalyser = 0\n" + plate(k_quartz, one)));
        EXPECT_NEAR(parallel, 0.25 * (t_o * t_o + t_e * t_e + 2 * t_o * t_e * std::cos(delta)),
                    k_float);
        const double extinct = middle(scene(
            "preset = \"polariscope\"\npolarizer = 45\nanalyzer = 135\n" + plate(k_quartz, one)));
        EXPECT_NEAR(extinct, 0, k_float);
    }
}

TEST_F(Views, AViewMayBeNamedInAnyTable) {
    for (const std::string table : {"camera", "light", "render"}) {
        std::string text = plate(k_quartz, "wavelengths = [550]");
        const std::string line = "preset = \"polariscope\"\npolarizer = 45\n";
        const auto at = text.find("[" + table + "]\n");
        if (at == std::string::npos) {
            text += "[" + table + "]\n" + line;
        } else {
            text.insert(at + table.size() + 3, line);
        }
        EXPECT_NEAR(middle(scene(text)), 0, k_float) << table;
    }
}

TEST_F(Views, CrossedPolarisersWithoutAStoneAreDarkAndAFullWavePlateColoursThem) {
    // Crossed, plate at 45 degrees: sin^2(pi G / lambda).
    const std::string away =
        "mesh = \"plate.obj\"\nmaterial = \"diamond\"\n[camera]\nposition = [100, 0, 50]\n"
        "look_at = [100, 0, 0]\nfov = 10\nsize = [8, 8]\n[render]\nsamples = 1\nwavelengths = [";
    for (const double nm : {450.0, 530.0, 640.0}) {
        const std::string one = away + std::to_string(nm) + "]\n";
        const RenderResult dark = render(scene("preset = \"polariscope\"\n" + one));
        for (float value : dark.picture.rgb) EXPECT_LT(std::abs(value), 1e-12f);
        const double sine = std::sin(std::numbers::pi * 530 / nm);
        EXPECT_NEAR(middle(scene("preset = \"polariscope\"\nretarder_nm = 530\n" + one)),
                    sine * sine, k_float);
    }
}

TEST_F(Views, DichroscopeShowsEachWavesAbsorption) {
    // Axis along the picture's x. The left window passes x, the extraordinary wave; the right one
    // the ordinary wave. Each passes half of the unpolarised light: T exp(-K d) / 2, depth 2.
    const Scene seen =
        scene("preset = \"dichroscope\"\n" +
              plate("optic_axis = [1, 0, 0]\n[material]\noptic = \"uniaxial\"\n"
                    "index = { o = 1.642, e = 1.619 }\nabsorption = { o = 1.5, e = 0.2 }\n",
                    "wavelengths = [550]"));
    const RenderResult result = render(seen);
    ASSERT_EQ(result.picture.width, 4);
    const auto through = [](double n, double K) {
        const double t = 4 * n / ((1 + n) * (1 + n));
        return 0.5 * t * t * std::exp(-K);
    };
    EXPECT_NEAR(static_cast<double>(result.picture.at(0, 2)[0]), through(1.619, 0.2), k_float);
    EXPECT_NEAR(static_cast<double>(result.picture.at(2, 2)[0]), through(1.642, 1.5), k_float);
}

TEST_F(Views, ConoscopeIsDarkAlongItsIsogyresAndOutsideAllDirections) {
    const Scene seen = scene(
        "preset = \"conoscope\"\ncone = 80\nmesh = \"plate.obj\"\noptic_axis = [0, 0, 1]\n"
        "[material]\noptic = \"uniaxial\"\nindex = { o = 1.658, e = 1.486 }\n"
        "[camera]\nposition = [0, 0, 50]\nsize = [41, 41]\n"
        "[render]\ndepth = 2\ntolerance = 0\nsamples = 1\nwavelengths = [589.3]\n");
    const RenderResult result = render(seen);
    double brightest = 0;
    for (int i = 0; i < 41; ++i) {
        EXPECT_NEAR(static_cast<double>(result.picture.at(i, 20)[0]), 0, k_float) << i;
        EXPECT_NEAR(static_cast<double>(result.picture.at(20, i)[0]), 0, k_float) << i;
        brightest = std::max(brightest, static_cast<double>(result.picture.at(i, i)[0]));
    }
    EXPECT_GT(brightest, 0.5);
    EXPECT_EQ(result.picture.at(0, 0)[0], 0.0f) << "sine over 1: no direction";
    EXPECT_EQ(result.picture.coverage[0], 0.0f);
}

TEST_F(Views, AMatchingLiquidHidesTheStone) {
    const Scene seen = scene(plate("immersion = 1.5\n[material]\nindex = 1.5\n",
                                   "wavelengths = [550]\n[[light.lobe]]\ndirection = [0, 0, -1]\n"
                                   "exponent = 3"));
    EXPECT_NEAR(middle(seen), 1, k_float);
}

TEST_F(Views, PolarisedLightAtBrewstersAngleIsNotReflected) {
    // tan B = n: p light enters without loss. Seen from the light's mirror direction, depth 1.
    const double n = 1.5, angle = std::atan(n);
    const Vec3 d{std::sin(angle), 0, -std::cos(angle)};
    for (const bool p : {true, false}) {
        Scene seen = scene(
            "mesh = \"plate.obj\"\n[material]\nindex = 1.5\n[light]\nconstant = 0\n"
            "[[light.hemisphere]]\ndirection = [0, 0, 1]\npolarization = " +
            std::string(p ? "[1, 0, 0]" : "[0, 1, 0]") +
            "\n[render]\ndepth = 1\ntolerance = 0\nwavelengths = [550]\n");
        const ProbeResult result = probe(seen, {Vec3{0, 0, 0.5} - 3.0 * d, d});
        const double r = (1 - n * n) / (1 + n * n);  // r_s at Brewster's angle
        EXPECT_NEAR(result.radiance[0], p ? 0 : r * r, 1e-14);
        if (!p) {
            EXPECT_NEAR(ellipse_of(result.stokes).degree, 1, 1e-12);
        }
    }
}

TEST_F(Views, SpectralPicturesCarryStokesParameters) {
    Scene seen = scene(
        "mesh = \"plate.obj\"\nmaterial = \"diamond\"\n[camera]\n"
        "position = [30, 0, 20]\nfov = 5\nsize = [6, 6]\n[light]\nconstant = 0\n"
        "[[light.hemisphere]]\ndirection = [0, 0, 1]\n"
        "[render]\ndepth = 4\nsamples = 1\nwavelengths = [500, 600]\n");
    seen.settings.spectral = true;
    const RenderResult result = render(seen);
    bool polarised = false;
    for (int wave = 0; wave < 2; ++wave) {
        for (std::size_t i = 0; i < result.picture.pixels(); ++i) {
            const float s0 = result.picture.spectral[wave][i];
            const float s1 = result.picture.polarised[0][wave][i],
                        s2 = result.picture.polarised[1][wave][i],
                        s3 = result.picture.polarised[2][wave][i];
            EXPECT_LE(s1 * s1 + s2 * s2 + s3 * s3, s0 * s0 * 1.0001f);
            // The reflection vibrates in the face, perpendicular to the plane of incidence, which
            // contains the picture's x.
            polarised = polarised || s1 < -0.01f * s0;
        }
    }
    EXPECT_TRUE(polarised) << "oblique reflection polarises along the face";
    write_picture(result.picture, folder_ / "s.exr");
    EXPECT_EQ(read_picture(folder_ / "s.exr").picture.wavelengths_nm.size(), 2u);
}

TEST_F(Views, AHeartBalancesAndNeedsToBeSaidNotConvex) {
    write_solid(make_cut("heart"), folder_ / "heart.obj");
    const std::string text =
        "mesh = \"heart.obj\"\n@material = \"corundum\"\n[camera]\nposition = [4, 3, 40]\n"
        "fov = 9\nsize = [24, 24]\n[light]\nconstant = 1\n"
        "[render]\nsamples = 1\ndepth = 5\ntolerance = 0\nwavelengths = [589.3]\n";
    std::string convex = text, carved = text;
    convex.replace(convex.find('@'), 1, "convex = true\n");
    carved.replace(carved.find('@'), 1, "convex = false\n");
    try {
        render(scene(convex));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("convex = false"), std::string::npos);
    }
    const RenderStats stats = render(scene(carved)).stats;
    EXPECT_NEAR(stats.mean_radiance + stats.remainder + stats.cut, 1, 1e-12);
    EXPECT_EQ(stats.cut, 0);
}

TEST_F(Views, ALightBeforeTheStoneHidesIt) {
    const std::string text = plate("[material]\nindex = 1.5\n",
                                   "wavelengths = [550]\n[[light.sphere]]\ncenter = [0, 0, 20]\n"
                                   "radius = 2\nradiance = 3");
    EXPECT_EQ(middle(scene(text)), 3);
    const ProbeResult result = probe(scene(text), {{0, 0, 50}, {0, 0, -1}});
    EXPECT_FALSE(result.hit);
    EXPECT_EQ(result.radiance[0], 3);
}

TEST_F(Views, MoreWavelengthsForAFinerTolerance) {
    std::size_t before = 0;
    for (const char* tolerance : {"0.5", "0.02", "0.0001"}) {
        const RenderStats stats =
            render(
                scene("mesh = \"plate.obj\"\nmaterial = \"diamond\"\n[camera]\n"
                      "position = [20, 0, 30]\nfov = 40\nsize = [24, 24]\n"
                      "[light]\nconstant = 0\n[[light.lobe]]\ndirection = [0.3, 0.1, -1]\n"
                      "exponent = 60\n[[light.cap]]\ndirection = [-1, 0, -0.2]\nhalf_angle = 20\n"
                      "[render]\nsamples = 1\ntolerance = " +
                      std::string(tolerance) + "\n"))
                .stats;
        EXPECT_GE(stats.wavelengths_nm.size(), before) << tolerance;
        before = stats.wavelengths_nm.size();
    }
    EXPECT_GT(before, 8u);
}

TEST_F(Views, MistakesAreNamed) {
    const auto message = [&](const std::string& text) -> std::string {
        try {
            scene(text);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const std::string rest = "mesh = \"plate.obj\"\nmaterial = \"quartz\"\n";
    EXPECT_NE(message("preset = \"microscope\"\n" + rest).find("conoscope"), std::string::npos);
    EXPECT_NE(
        message("preset = \"polariscope\"\nanalyzer = 0\nanalyser = 1\n" + rest).find("not both"),
        std::string::npos);
    EXPECT_NE(
        message("preset = \"dichroscope\"\n" + rest + "[camera]\nsize = [5, 4]\n").find("even"),
        std::string::npos);
    EXPECT_NE(message("preset = \"polariscope\"\nretarder_angle = 3\n" + rest).find("retarder_nm"),
              std::string::npos);
    EXPECT_NE(message(rest + "[light]\nconstant = 1\n[[light.cap]]\ndirection = [0, 0, 1]\n"
                             "half_angle = 3\npolarization = [0, 0, 2]\n")
                  .find("parallel"),
              std::string::npos);
    EXPECT_NE(message("immersion = 0.5\n" + rest + "[light]\nconstant = 1\n").find("index"),
              std::string::npos);
    EXPECT_NE(message("preset = \"conoscope\"\ncone = 120\n" + rest).find("90"), std::string::npos);
}

TEST(Sampling, FiltersHaveTheirVarianceAndNoOffset) {
    // Box r^2/3, tent r^2/6, gaussian truncated at two deviations: 0.773741 sigma^2 (its closed
    // form, 1 - 4 phi(2)/(2 Phi(2) - 1)). 64 midpoints a side miss some of the warp's steep ends.
    const double phi = std::exp(-2.0) / std::sqrt(2 * std::numbers::pi);
    const double inside = std::erf(std::numbers::sqrt2);
    for (const auto& [filter, radius, variance] :
         {std::tuple{PixelFilter::box, 0.5, 0.25 / 3},
          {PixelFilter::tent, 1.0, 1.0 / 6},
          {PixelFilter::gaussian, 2.0, 1 - 4 * phi / inside}}) {
        double sum = 0, squares = 0;
        const auto points = sample_pattern(4096, false, filter, radius);
        for (const SamplePoint& p : points) {
            sum += p.x - 0.5;
            squares += (p.y - 0.5) * (p.y - 0.5);
        }
        EXPECT_NEAR(sum / 4096, 0, 1e-12);
        EXPECT_NEAR(squares / 4096 / variance, 1, 5e-3);
    }
}

}  // namespace
