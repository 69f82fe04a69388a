#include "render/setup/stone_bands.h"

#include <algorithm>
#include <limits>

#include "render/colour/few_wavelengths.h"
#include "render/setup/probe_wavelengths.h"

namespace culet {

namespace {

// Orders values by the crystal's three axes (uniaxial: axis 0 is the optic axis, e).
template <class Value>
std::array<double, 3> along_axes(OpticCharacter optic, const Value& value) {
    switch (optic) {
        case OpticCharacter::isotropic:
            return {value(0), value(0), value(0)};
        case OpticCharacter::uniaxial:
            return {value(1), value(0), value(0)};
        case OpticCharacter::biaxial:
            return {value(0), value(1), value(2)};
    }
    return {};
}

double mean(const std::array<double, 3>& v) {
    // Keeps equal values exactly equal.
    return v[0] == v[1] && v[1] == v[2] ? v[0] : (v[0] + v[1] + v[2]) / 3;
}

// Absorption per mm of each principal ray, or their mean if the waves are not separated.
std::vector<Spectrum> absorption_of(const Material& material, bool each_ray) {
    const int rays = ray_count(material.optic);
    const std::vector<Spectrum> all(material.absorption_per_mm.begin(),
                                    material.absorption_per_mm.begin() + rays);
    if (each_ray || rays == 1) return all;
    const std::vector<double> nm = even_nodes(k_node_counts.back());
    std::vector<double> values;
    for (const double at : nm)
        values.push_back(mean(along_axes(material.optic, [&](int r) { return all[r].at(at); })));
    return {Spectrum(nm, values)};
}

void set_indices(const Scene& scene, bool splits, double nm, Band& band) {
    const Material& material = scene.stone.material;
    std::array<double, 3> n =
        along_axes(material.optic, [&](int ray) { return material.index[ray].at(nm); });
    band.n = mean(n);
    // Without birefringence, use the mean over the vibration directions.
    if (!splits) n = {band.n, band.n, band.n};
    // In a uniaxial crystal only the optic axis matters.
    band.crystal = material.optic == OpticCharacter::uniaxial
                       ? uniaxial_crystal(scene.stone.crystal.axes[0], n[1], n[0])
                       : Crystal(scene.stone.crystal.axes, n);
    band.two_waves = !band.crystal.isotropic();
    band.n_outside = scene.immersion;
}

// `few`: fitted absorption, or null.
void set_absorption(const Stone& stone, const OpticalSetup& setup, const FewWavelengths* few,
                    Band& band) {
    const double mm = mm_per(stone.unit);
    const bool each_ray = few && few->absorption_per_mm.size() > 1;
    band.absorbs = setup.on(Effects::absorption);
    for (int i = 0; i < band.count; ++i) {
        const int node = band.first + i;
        const double at = setup.wavelengths_nm[node];
        std::array<double, 3> K = along_axes(stone.material.optic, [&](int ray) {
            return mm * (few ? few->absorption_per_mm[each_ray ? ray : 0][node]
                             : stone.material.absorption_per_mm[ray].at(at));
        });
        if (!setup.on(Effects::pleochroism) || !band.two_waves) K.fill(mean(K));
        for (int axis = 0; axis < 3; ++axis) band.absorption[axis][i] = K[axis];
    }
}

}  // namespace

void add_bands(const Scene& scene, bool coloured, OpticalSetup& setup) {
    const std::vector<double>& nm = setup.wavelengths_nm;
    const double mm = mm_per(scene.stone.unit);
    const int count = static_cast<int>(nm.size());
    const bool each_ray = setup.on(Effects::pleochroism) && setup.splits;
    const FewWavelengths* few = nullptr;
    // Spectral pictures, and scenes with objects, use the wavelengths themselves.
    if (setup.on(Effects::absorption) && coloured && !scene.settings.spectral &&
        !scene.has_objects() && count >= k_least_fitted && count <= k_most_fitted) {
        few = &fit_wavelengths(absorption_of(scene.stone.material, each_ray), nm,
                               mm * diameter(scene.stone.solid));
        setup.rgb_weight = few->rgb_weight;
    }
    const double spacing = count > 1 ? (nm.back() - nm.front()) / (count - 1) : 0;
    const double bandwidth = scene.settings.bandwidth_nm.value_or(spacing);
    const bool dispersive = setup.on(Effects::dispersion);
    const bool coherent = setup.on(Effects::coherence);
    const bool one_wavelength = scene.settings.wavelengths_nm.size() == 1;
    const int per_band = dispersive || coherent ? 1 : k_band_nodes;
    for (int first = 0; first < count; first += per_band) {
        Band band;
        band.first = first;
        band.count = std::min(per_band, count - first);
        const double here = nm[first];
        set_indices(scene, setup.splits, dispersive || one_wavelength ? here : k_d_line_nm, band);
        set_absorption(scene.stone, setup, few, band);
        band.wavelength = here * 1e-6 / mm;
        if (coherent) {
            band.coherence_length = bandwidth > 0 ? band.wavelength * here / bandwidth
                                                  : std::numeric_limits<double>::infinity();
        }
        setup.bands.push_back(band);
    }
}

}  // namespace culet
