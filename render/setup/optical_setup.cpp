#include "render/setup/optical_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "render/setup/light_needs.h"
#include "render/setup/probe_wavelengths.h"
#include "render/setup/stone_bands.h"
#include "stone/design/design.h"
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

void decide_effects(const Scene& scene, const Optics& optics, OpticalSetup& setup) {
    Decider decider{scene, setup};
    const OpticCharacter optic = scene.stone.material.optic;
    const bool anisotropic = optic != OpticCharacter::isotropic;
    const bool one_wavelength = scene.settings.wavelengths_nm.size() == 1;
    decider.decide(Effects::dispersion, optics.span > 0 && !one_wavelength,
                   fmt::format("index changes by {:.4f} over the wavelengths", optics.span),
                   one_wavelength ? "one wavelength only" : "index is the same at every wavelength",
                   k_unknown);
    decider.decide(Effects::birefringence, optics.split > 0,
                   fmt::format("{} reaches {:.4f}",
                               optic == OpticCharacter::biaxial ? "n_gamma - n_alpha" : "n_e - n_o",
                               optics.split),
                   anisotropic ? "the principal indices are equal" : "the stone is isotropic",
                   k_unknown);
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

// Light that a ground facet scatters is followed in one isotropic, convex stone only.
void leave_out_for_ground(const Scene& scene, OpticalSetup& setup) {
    if (frosted_tiers(scene.stone.solid).empty()) return;
    for (const Effects effect : {Effects::birefringence, Effects::pleochroism}) {
        EffectDecision& decision = setup.effects[static_cast<std::size_t>(effect)];
        if (!decision.on || !scene.settings.effects_auto) continue;
        decision.on = false;
        decision.why = "frosted facets scatter the light of both waves";
        decision.error_bound = k_unknown;
    }
}

void require_scatters(const Scene& scene, const OpticalSetup& setup) {
    const std::string frosted = frosted_tiers(scene.stone.solid);
    if (frosted.empty() || !setup.general) return;
    throw InputError(fmt::format(
        "frosted facets (tiers {}) are drawn in convex stones in air, in unpolarised light, and "
        "without birefringence: leave that out of effects, or convert the design to .asc, which "
        "keeps no frosting",
        frosted));
}

// Which light paths the effects need.
void decide_paths(const Scene& scene, OpticalSetup& setup) {
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
}

std::vector<double> wavelengths_for(const Scene& scene, const Optics& optics,
                                    const OpticalSetup& setup, int nodes) {
    if (!scene.settings.wavelengths_nm.empty()) return scene.settings.wavelengths_nm;
    const bool coherent = setup.on(Effects::coherence);
    if (setup.on(Effects::dispersion) ||
        (setup.on(Effects::absorption) && optics.spectral_absorption) ||
        (coherent && has_polariser(scene)) || more_stones_need_spectrum(scene) ||
        light_needs(scene) == LightNeeds::a_spectrum)
        return even_nodes(coherent ? std::max(nodes, k_least_coherent_nodes) : nodes);
    // Three nodes carry any RGB light exactly.
    if (light_needs(scene) == LightNeeds::three_for_rgb) return {450, 550, 610};
    return {k_d_line_nm};
}

}  // namespace

bool chose_spectrum(const Scene& scene, const OpticalSetup& setup) {
    return scene.settings.wavelengths_nm.empty() &&
           setup.wavelengths_nm.size() >= static_cast<std::size_t>(k_node_counts[0]);
}

OpticalSetup make_optical_setup(const Scene& scene, int nodes) {
    const std::vector<double>& given = scene.settings.wavelengths_nm;
    const Optics optics =
        optics_of(scene.stone.material, given.empty() ? even_nodes(k_probes) : given);
    OpticalSetup setup;
    decide_effects(scene, optics, setup);
    leave_out_for_ground(scene, setup);
    decide_coherence(scene, optics, setup);
    decide_paths(scene, setup);
    require_scatters(scene, setup);
    setup.wavelengths_nm = wavelengths_for(scene, optics, setup, nodes);
    add_bands(scene, optics.spectral_absorption, setup);
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
