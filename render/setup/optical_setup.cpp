#include "render/setup/optical_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/colour/few_wavelengths.h"
#include "render/setup/light_needs.h"
#include "render/setup/probe_wavelengths.h"
#include "stone/text/errors.h"

namespace culet {

const char* name_of(Effects effect) {
    switch (effect) {
        case Effects::dispersion:
            return "dispersion";
        case Effects::birefringence:
            return "birefringence";
        case Effects::polarization:
            return "polarization";
        case Effects::absorption:
            return "absorption";
        case Effects::pleochroism:
            return "pleochroism";
        case Effects::aperture:
            return "aperture";
        case Effects::coherence:
            return "coherence";
    }
    return "";
}

namespace {

// For interference colours: fringes over wavelength are 10 nm wide at 30 waves.
constexpr int k_least_coherent_nodes = 29;
constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();

std::vector<double> even_nodes(int count) {
    std::vector<double> nm;
    for (int i = 0; i < count; ++i)
        nm.push_back(k_first_nm + (k_last_nm - k_first_nm) * i / (count - 1));
    return nm;
}

struct Decider {
    const Scene& scene;
    OpticalSetup& setup;

    bool allowed(Effects effect) const {
        return scene.settings.effects_auto ||
               scene.settings.effects[static_cast<std::size_t>(effect)];
    }
    void decide(Effects effect, bool matters, const std::string& why_on, const std::string& why_off,
                double bound_if_forbidden) {
        EffectDecision& decision = setup.effects[static_cast<std::size_t>(effect)];
        decision.effect = effect;
        decision.on = matters && allowed(effect);
        decision.why = !matters ? why_off : decision.on ? why_on : "switched off by the scene";
        decision.error_bound = matters && !decision.on ? bound_if_forbidden : 0;
    }
};

bool has_polariser(const Scene& scene) {
    return scene.camera.optics.analyzer || polarised(scene.lights);
}

// Spans of the stone's optics over the wavelengths used.
struct Optics {
    double span = 0;       // of the indices over wavelength
    double split = 0;      // largest difference of two indices
    double strongest = 0;  // absorption per mm
    bool spectral_absorption = false, unequal_absorption = false;
};

Optics optics_of(const Material& material, const std::vector<double>& nm) {
    Optics optics;
    const int rays = ray_count(material.optic);
    for (int ray = 0; ray < rays; ++ray) {
        const RefractiveIndex& index = material.index[ray];
        const Spectrum& absorption = material.absorption_per_mm[ray];
        for (double at : nm) {
            optics.span = std::max(optics.span, std::abs(index.at(at) - index.at(nm.front())));
            optics.split =
                std::max(optics.split, std::abs(index.at(at) - material.index[0].at(at)));
            optics.unequal_absorption = optics.unequal_absorption ||
                                        absorption.at(at) != material.absorption_per_mm[0].at(at);
        }
        optics.strongest = std::max(optics.strongest, absorption.max());
        optics.spectral_absorption = optics.spectral_absorption || !absorption.is_constant();
    }
    if (rays == 3) {
        for (double at : nm)
            optics.split = std::max(optics.split,
                                    std::abs(material.index[2].at(at) - material.index[1].at(at)));
    }
    return optics;
}

bool more_stones_need_spectrum(const Scene& scene) {
    return std::any_of(scene.more_stones.begin(), scene.more_stones.end(), [](const Stone& stone) {
        const Optics optics = optics_of(stone.material, even_nodes(k_probes));
        return optics.span > 0 || optics.spectral_absorption;
    });
}

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

void decide_coherence(const Scene& scene, const Optics& optics, OpticalSetup& setup) {
    const double extent = diameter(scene.stone.solid) * mm_per(scene.stone.unit);
    const double waves = optics.split * extent / (k_d_line_nm * 1e-6);
    const bool crystal = setup.on(Effects::birefringence);
    const bool asked = scene.settings.coherence.value_or(
        (!scene.settings.effects_auto &&
         scene.settings.effects[static_cast<std::size_t>(Effects::coherence)]) ||
        has_polariser(scene));
    std::string why = "there are no two waves";
    if (crystal && asked) {
        why = "the two waves interfere while their retardation is below the coherence length";
    } else if (crystal) {
        why = "nothing polarises at the light or the eye: the two waves' powers are added";
        if (waves < 1)
            why += fmt::format(
                " (they stay within {:.2g} waves of each other: coherence = \"on\" "
                "would be exact)",
                waves);
    }
    setup.effects[static_cast<std::size_t>(Effects::coherence)] = {
        Effects::coherence, crystal && asked, why, crystal && !asked ? k_unknown : 0};
}

}  // namespace

bool chose_spectrum(const Scene& scene, const OpticalSetup& setup) {
    return scene.settings.wavelengths_nm.empty() &&
           setup.wavelengths_nm.size() >= static_cast<std::size_t>(k_node_counts[0]);
}

OpticalSetup make_optical_setup(const Scene& scene, int nodes) {
    const Material& material = scene.stone.material;
    OpticalSetup setup;
    Decider decider{scene, setup};
    const bool anisotropic = material.optic != OpticCharacter::isotropic;
    const std::vector<double>& given = scene.settings.wavelengths_nm;
    const Optics optics = optics_of(material, given.empty() ? even_nodes(k_probes) : given);

    const bool one_wavelength = given.size() == 1;
    decider.decide(Effects::dispersion, optics.span > 0 && !one_wavelength,
                   fmt::format("index changes by {:.4f} over the wavelengths", optics.span),
                   one_wavelength ? "one wavelength only" : "index is the same at every wavelength",
                   k_unknown);
    decider.decide(
        Effects::birefringence, optics.split > 0,
        fmt::format("{} reaches {:.4f}",
                    material.optic == OpticCharacter::biaxial ? "n_gamma - n_alpha" : "n_e - n_o",
                    optics.split),
        anisotropic ? "the principal indices are equal" : "the stone is isotropic", k_unknown);
    decider.decide(Effects::absorption, optics.strongest > 0,
                   fmt::format("up to {:.4f} per mm", optics.strongest), "the stone is clear", 1.0);
    decider.decide(
        Effects::pleochroism,
        optics.unequal_absorption && decider.allowed(Effects::absorption) && optics.split > 0,
        "the two rays are absorbed differently",
        anisotropic ? "both rays are absorbed alike" : "the stone is isotropic", 1.0);
    decider.decide(Effects::polarization, true, "faces polarise light, and later faces see it", "",
                   k_unknown);
    decider.decide(Effects::aperture, scene.camera.aperture_radius > 0,
                   fmt::format("pupil radius {:.4g}", scene.camera.aperture_radius),
                   "pinhole camera", k_unknown);
    decide_coherence(scene, optics, setup);

    const bool dispersive = setup.on(Effects::dispersion);
    const bool coherent = setup.on(Effects::coherence);
    setup.splits = setup.on(Effects::birefringence);
    setup.stokes =
        has_polariser(scene) || (setup.on(Effects::polarization) &&
                                 (scene.settings.spectral || surroundings_polarise(scene)));
    setup.general = setup.splits || setup.stokes || scene.immersion != 1 ||
                    (!scene.stone.convex && scene.settings.meets_again);
    setup.polarised = setup.on(Effects::polarization);
    if (!scene.stone.convex) {
        for (const Facet& facet : scene.stone.solid.facets)
            setup.open_edges += static_cast<int>(facet.corners.size());
        setup.open_edges /= 2;
    }
    if (setup.general && !setup.polarised) {
        EffectDecision& decision = setup.effects[static_cast<std::size_t>(Effects::polarization)];
        decision.on = setup.polarised = true;
        decision.why = setup.splits           ? "the split waves of a crystal always carry it"
                       : setup.stokes         ? "polarised lights and analysers need it"
                       : scene.immersion != 1 ? "always on for a stone in a liquid"
                                              : "always on for stones that are not convex";
        decision.error_bound = 0;
    }
    if (!given.empty()) {
        setup.wavelengths_nm = given;
    } else if (dispersive || (setup.on(Effects::absorption) && optics.spectral_absorption) ||
               (coherent && has_polariser(scene)) || more_stones_need_spectrum(scene) ||
               light_needs(scene) == LightNeeds::a_spectrum) {
        setup.wavelengths_nm =
            even_nodes(coherent ? std::max(nodes, k_least_coherent_nodes) : nodes);
    } else if (light_needs(scene) == LightNeeds::three_for_rgb) {
        // Three nodes carry any RGB light exactly.
        setup.wavelengths_nm = {450, 550, 610};
    } else {
        setup.wavelengths_nm = {k_d_line_nm};
    }

    const double mm = mm_per(scene.stone.unit);
    const int count = static_cast<int>(setup.wavelengths_nm.size());
    const bool each_ray = setup.on(Effects::pleochroism) && setup.splits;
    const FewWavelengths* few = nullptr;
    // Spectral pictures, and scenes with objects, use the wavelengths themselves.
    if (setup.on(Effects::absorption) && optics.spectral_absorption && !scene.settings.spectral &&
        !scene.has_objects() && count >= k_least_fitted && count <= k_most_fitted) {
        few = &fit_wavelengths(absorption_of(material, each_ray), setup.wavelengths_nm,
                               mm * diameter(scene.stone.solid));
        setup.rgb_weight = few->rgb_weight;
    }
    const double spacing =
        count > 1 ? (setup.wavelengths_nm.back() - setup.wavelengths_nm.front()) / (count - 1) : 0;
    const double bandwidth = scene.settings.bandwidth_nm.value_or(spacing);
    const int per_band = dispersive || coherent ? 1 : k_band_nodes;
    for (int first = 0; first < count; first += per_band) {
        Band band;
        band.first = first;
        band.count = std::min(per_band, count - first);
        const double nm = dispersive       ? setup.wavelengths_nm[first]
                          : one_wavelength ? given.front()
                                           : k_d_line_nm;
        std::array<double, 3> n =
            along_axes(material.optic, [&](int ray) { return material.index[ray].at(nm); });
        band.n = mean(n);
        // Without birefringence, use the mean over the vibration directions.
        if (!setup.splits) n = {band.n, band.n, band.n};
        // In a uniaxial crystal only the optic axis matters.
        band.crystal = material.optic == OpticCharacter::uniaxial
                           ? uniaxial_crystal(scene.stone.crystal.axes[0], n[1], n[0])
                           : Crystal(scene.stone.crystal.axes, n);
        band.two_waves = !band.crystal.isotropic();
        band.n_outside = scene.immersion;
        band.absorbs = setup.on(Effects::absorption);
        for (int i = 0; i < band.count; ++i) {
            const double at = setup.wavelengths_nm[first + i];
            std::array<double, 3> K = along_axes(material.optic, [&](int ray) {
                return mm * (few ? few->absorption_per_mm[each_ray ? ray : 0][first + i]
                                 : material.absorption_per_mm[ray].at(at));
            });
            if (!setup.on(Effects::pleochroism) || !band.two_waves) K.fill(mean(K));
            for (int axis = 0; axis < 3; ++axis) band.absorption[axis][i] = K[axis];
        }
        const double here = setup.wavelengths_nm[first];
        band.wavelength = here * 1e-6 / mm;
        if (coherent) {
            band.coherence_length = bandwidth > 0 ? band.wavelength * here / bandwidth
                                                  : std::numeric_limits<double>::infinity();
        }
        setup.bands.push_back(band);
    }
    return setup;
}

PathWork work_along_paths(const OpticalSetup& setup) {
    PathWork work;
    work.general = setup.general;
    work.polarised = setup.polarised;
    work.nodes = setup.bands.front().count;
    work.edges = setup.open_edges;
    return work;
}

bool paths_branch(const Scene& scene, const OpticalSetup& setup) {
    return setup.splits || !scene.stone.convex;
}

bool paths_branch(const Scene& scene) {
    return paths_branch(scene, make_optical_setup(scene));
}

}  // namespace culet
