// Pictures with few wavelengths against the whole spectrum, which this test integrates
// independently.

#include "render/colour/few_wavelengths.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/beams/frame_renderer.h"
#include "render/colour/colour_difference.h"
#include "render/colour/material_colour.h"
#include "render/planner/wavelengths.h"
#include "render/setup/optical_setup.h"
#include "stone/cuts/cuts.h"
#include "tests/render/bench_scenes.h"

namespace culet {
namespace {

constexpr double k_width = k_usual_width_mm;

Lab lab_of(const Rgb& rgb) {
    return lab_from_linear_srgb(rgb[0], rgb[1], rgb[2]);
}

std::vector<Spectrum> rays_of(const Material& material) {
    return {material.absorption_per_mm.begin(),
            material.absorption_per_mm.begin() + ray_count(material.optic)};
}

// Daylight after one path, with a share along each principal ray.
Rgb few_colour(const FewWavelengths& few, const std::vector<double>& nm, double mm) {
    std::vector<double> light(nm.size(), 0.0);
    for (const std::vector<double>& absorption : few.absorption_per_mm) {
        for (std::size_t i = 0; i < nm.size(); ++i)
            light[i] += std::exp(-mm * absorption[i]) / double(few.absorption_per_mm.size());
    }
    return WavelengthSet(nm, few.rgb_weight).rgb_of(light.data());
}
Rgb whole_colour(const Material& material, double mm) {
    return body_colour(material, mm / light_path_mm(1)).rgb;
}

// Over exponentially distributed path lengths with a given mean.
template <class Colour>
Lab spread_colour(double mean, const Colour& colour) {
    Rgb sum{};
    double weights = 0;
    for (double mm = 0; mm < 8 * mean; mm += mean / 20) {
        const double weight = std::exp(-mm / mean);
        const Rgb here = colour(mm);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * here[c];
        weights += weight;
    }
    for (double& value : sum) value /= weights;
    return lab_of(sum);
}

// A CIEDE2000 of 1 to 2 is just noticeable.
TEST(FewWavelengths, HaveTheColourOfTheWholeSpectrum) {
    for (const std::string& name : catalogue_names()) {
        const Material material = catalogue_material(name);
        if (!material.has_absorption()) continue;
        for (const std::vector<double>& nm :
             {std::vector<double>{450, 540, 610}, even_wavelengths(3), even_wavelengths(5),
              even_wavelengths(8), even_wavelengths(15)}) {
            const FewWavelengths& few = fit_wavelengths(rays_of(material), nm, k_width);
            const auto seen = [&](double mm) { return few_colour(few, nm, mm); };
            const auto whole = [&](double mm) { return whole_colour(material, mm); };
            const double path = light_path_mm(k_width);
            EXPECT_LT(ciede2000(lab_of(seen(path)), lab_of(whole(path))), 2)
                << name << ", " << nm.size() << ": body colour";
            for (const double mean : {0.3, 0.6, 1.3, 3.0}) {
                EXPECT_LT(ciede2000(spread_colour(mean * k_width, seen),
                                    spread_colour(mean * k_width, whole)),
                          2)
                    << name << ", " << nm.size() << ": about " << mean << " widths";
            }
            double worst = 0, at = 0;
            for (double widths = 0; widths <= 5; widths += 0.2) {
                const double off =
                    ciede2000(lab_of(seen(widths * k_width)), lab_of(whole(widths * k_width)));
                if (off > worst) at = widths;
                worst = std::max(worst, off);
            }
            EXPECT_LT(worst, nm.size() == 3 ? 2.5 : 2)
                << name << ", " << nm.size() << ": after " << at << " widths";
        }
    }
}

// The light of a coloured lamp, for any shares: red + green + blue is white.
TEST(FewWavelengths, KeepColouredLights) {
    const Material ruby = catalogue_material("ruby_gem");
    const std::vector<double> nm{450, 540, 610};
    const WavelengthSet set(nm, fit_wavelengths(rays_of(ruby), nm, k_width).rgb_weight);
    for (const Rgb& rgb : {Rgb{1, 0, 0}, Rgb{0.2, 0.7, 0.1}, Rgb{0, 0, 3}}) {
        const Rgb back = set.rgb_of(set.spectrum_of(rgb).data());
        for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(back[c], rgb[c], 1e-9);
    }
    // Illuminant A, 2856 K: x 0.4476, y 0.4074 (CIE 15).
    const auto xyz = xyz_of_rgb(set.rgb_of(set.illuminant_relative("A").data()));
    EXPECT_NEAR(xyz[0] / (xyz[0] + xyz[1] + xyz[2]), 0.4476, 2e-3);
    EXPECT_NEAR(xyz[1] / (xyz[0] + xyz[1] + xyz[2]), 0.4074, 2e-3);
}

// A brilliant of 6.5 mm in white light from everywhere.
Scene coloured(const std::string& material, const std::vector<double>& nm) {
    Scene scene;
    scene.stone.solid = make_cut("round-brilliant", {{"diameter", k_width}});
    scene.stone.material = catalogue_material(material);
    scene.camera = bench_camera(scene.stone.solid, 6, {0, 0, 1}, 40);
    scene.lights.constant = 1;
    scene.settings.engine = k_preview_engine;
    scene.settings.check = Check::none;
    scene.settings.crystal_beams = CrystalBeams::merged;
    scene.settings.wavelengths_nm = nm;
    scene.settings.depth = 7;
    return scene;
}

Lab mean_colour(const Scene& scene) {
    FrameRenderer frames(scene);
    const Picture& picture = frames.draw().picture;
    Rgb sum{};
    double covered = 0;
    for (std::size_t p = 0; p < picture.pixels(); ++p) {
        for (std::size_t c = 0; c < 3; ++c) sum[c] += picture.rgb[3 * p + c];
        covered += picture.coverage[p];
    }
    // Pixels beside the stone see the light.
    for (double& value : sum) value = (value - (double(picture.pixels()) - covered)) / covered;
    return lab_of(sum);
}

TEST(FewWavelengths, DrawTheColourOfTheFullPicture) {
    const std::vector<double> full = even_wavelengths(29);
    // Not within 2: ruby, emerald, alexandrite, whose light changes from one wave to the other at
    // each face (docs/engines.md gives the differences).
    for (const char* name : {"sapphire_blue", "garnet_almandine", "peridot"}) {
        const Lab whole = mean_colour(coloured(name, full));
        for (const int count : {3, 8}) {
            const Lab few = mean_colour(coloured(name, even_wavelengths(count)));
            EXPECT_LT(ciede2000(few, whole), 2) << name << ", " << count;
        }
    }
}

// Spectra, full pictures and single-wavelength pictures use the material itself.
TEST(FewWavelengths, LeaveSpectraAsTheyAre) {
    const Material ruby = catalogue_material("ruby_gem");
    const auto first_absorption = [&](Scene scene) {
        const OpticalSetup setup = make_optical_setup(scene);
        EXPECT_TRUE(setup.rgb_weight.empty());
        return setup.bands.front().absorption[1][0];
    };
    Scene spectral = coloured("ruby_gem", {450, 550, 610});
    spectral.settings.spectral = true;
    EXPECT_EQ(first_absorption(spectral), ruby.absorption_per_mm[0].at(450));
    EXPECT_EQ(first_absorption(coloured("ruby_gem", even_wavelengths(29))),
              ruby.absorption_per_mm[0].at(410));
    EXPECT_EQ(first_absorption(coloured("ruby_gem", {589.3})), ruby.absorption_per_mm[0].at(589.3));
}

}  // namespace
}  // namespace culet
