#include "render/export/optical_parts.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/optics/conductor.h"
#include "stone/design/design.h"
#include "stone/export/mean_material.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

// Wavelengths at which red, green and blue absorption are read (as in
// Material::absorption_from_rgb).
constexpr std::array<double, 3> k_rgb_nm{610, 545, 465};

}  // namespace

StoneOptics optics_of(const Stone& stone, const Scene& scene, std::vector<std::string>& notes) {
    const Material& material = stone.material;
    Scene of_stone = scene;
    of_stone.stone = stone;
    const OpticalSetup setup = make_optical_setup(of_stone);
    const std::vector<double>& nm = scene.settings.wavelengths_nm;
    const bool one_wavelength = nm.size() == 1;
    StoneOptics optics;
    optics.index_nm = one_wavelength ? nm.front() : k_d_line_nm;
    optics.index = mean_index(material, optics.index_nm);
    optics.disperses = setup.on(Effects::dispersion);
    optics.birefringent = setup.on(Effects::birefringence);
    optics.pleochroic = setup.on(Effects::absorption) && setup.on(Effects::pleochroism);
    if (optics.birefringent)
        add_note(notes,
                 fmt::format("double refraction: the mean index {:.4f} is written", optics.index));
    if (!setup.on(Effects::absorption)) return optics;
    for (std::size_t c = 0; c < 3; ++c)
        optics.absorption[c] = mm_per(stone.unit) *
                               mean_absorption(material, one_wavelength ? nm.front() : k_rgb_nm[c]);
    if (optics.pleochroic) add_note(notes, "pleochroism: the mean absorption is written");
    const bool has_spectrum =
        std::any_of(material.absorption_per_mm.begin(),
                    material.absorption_per_mm.begin() + ray_count(material.optic),
                    [](const Spectrum& spectrum) { return !spectrum.is_constant(); });
    if (has_spectrum && !one_wavelength)
        add_note(notes,
                 "the spectrum of absorption: three values for red, green and blue are written");
    return optics;
}

MetalIndex finite_index_of(const MetalMaterial& metal) {
    const double most = extinction_of_reflectance(0.9999);
    MetalIndex index = index_of(metal);
    for (double& k : index.k) k = std::min(k, most);
    return index;
}

void note_left_out(const Scene& scene, std::vector<std::string>& notes) {
    const OpticalSetup setup = make_optical_setup(scene);
    if (const std::string frosted = frosted_tiers(scene.stone.solid); !frosted.empty())
        add_note(notes, fmt::format("frosting: polished here are tiers {}", frosted));
    if (setup.polarised) add_note(notes, "polarisation by the faces");
    if (setup.on(Effects::aperture)) add_note(notes, "the lens: the picture is that of a pinhole");
}

void note_light_map(const DistantLights& lights, double degrees, std::vector<std::string>& notes) {
    if (lights.has_edges())
        add_note(notes, fmt::format("sharp edges of distant lights: the map has texels of "
                                    "{:.2g} degrees",
                                    degrees));
}

}  // namespace culet
