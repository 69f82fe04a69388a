#include "render/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "stone/errors.h"

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
    }
    return "";
}

namespace {

// The wavelength of refractive indices in handbooks: the sodium D line.
constexpr double k_d_line_nm = 589.3;
// Where the eye's response is, and how many nodes serve: see docs/rendering.md for the measured
// errors.
constexpr double k_first_nm = 410, k_last_nm = 690;
constexpr int k_nodes = 15;
constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();

// What of a scene's light depends on wavelength. D65 is flat here (colour.h).
enum class LightNeeds { one_wavelength, three_for_rgb, a_spectrum };

LightNeeds needs_of(const LightColour& light) {
    if (std::holds_alternative<double>(light.value)) return LightNeeds::one_wavelength;
    if (std::holds_alternative<Rgb>(light.value)) return LightNeeds::three_for_rgb;
    return std::get<std::string>(light.value) == "D65" ? LightNeeds::one_wavelength
                                                       : LightNeeds::a_spectrum;
}

LightNeeds needs_of(const Lights& lights) {
    LightNeeds most = lights.environment ? LightNeeds::three_for_rgb : LightNeeds::one_wavelength;
    const auto take = [&most](const auto& list) {
        for (const auto& light : list) most = std::max(most, needs_of(light.radiance));
    };
    take(lights.spheres);
    take(lights.lobes);
    take(lights.hemispheres);
    take(lights.caps);
    take(lights.planes);
    return most;
}

std::vector<double> even_nodes(int count) {
    std::vector<double> nm;
    for (int i = 0; i < count; ++i)
        nm.push_back(k_first_nm + (k_last_nm - k_first_nm) * i / (count - 1));
    return nm;
}

struct Decider {
    const Scene& scene;
    Plan& plan;

    bool allowed(Effects effect) const {
        return scene.settings.effects_auto ||
               scene.settings.effects[static_cast<std::size_t>(effect)];
    }
    void decide(Effects effect, bool matters, const std::string& why_on, const std::string& why_off,
                double bound_if_forbidden) {
        EffectDecision& decision = plan.effects[static_cast<std::size_t>(effect)];
        decision.effect = effect;
        decision.on = matters && allowed(effect);
        decision.why = !matters ? why_off : decision.on ? why_on : "switched off by the scene";
        decision.error_bound = matters && !decision.on ? bound_if_forbidden : 0;
    }
};

}  // namespace

Plan make_plan(const Scene& scene) {
    const Material& material = scene.stone.material;
    if (material.optic == OpticCharacter::biaxial) {
        throw InputError(
            fmt::format("{} is biaxial, and biaxial stones are not rendered yet; a uniaxial "
                        "[material] with index o and e "
                        "near its own would come close",
                        material.name.empty() ? material.id : material.name));
    }
    Plan plan;
    Decider decider{scene, plan};
    const int rays = ray_count(material.optic);
    const std::vector<double>& given = scene.settings.wavelengths_nm;

    double span = 0, split = 0, strongest = 0;
    bool spectral_absorption = false, unequal_absorption = false;
    const std::vector<double> probes = given.empty() ? even_nodes(k_nodes) : given;
    for (int ray = 0; ray < rays; ++ray) {
        const RefractiveIndex& index = material.index[ray];
        for (double nm : probes)
            span = std::max(span, std::abs(index.at(nm) - index.at(probes.front())));
        strongest = std::max(strongest, material.absorption_per_mm[ray].max());
        spectral_absorption = spectral_absorption || !material.absorption_per_mm[ray].is_constant();
    }
    if (rays == 2) {
        for (double nm : probes) {
            split = std::max(split, std::abs(material.index[1].at(nm) - material.index[0].at(nm)));
            unequal_absorption = unequal_absorption || material.absorption_per_mm[0].at(nm) !=
                                                           material.absorption_per_mm[1].at(nm);
        }
    }

    const bool one_wavelength = given.size() == 1;
    decider.decide(Effects::dispersion, span > 0 && !one_wavelength,
                   fmt::format("index changes by {:.4f} over the wavelengths", span),
                   one_wavelength ? "one wavelength only" : "index is the same at every wavelength",
                   k_unknown);
    decider.decide(Effects::birefringence, split > 0,
                   fmt::format("n_e - n_o reaches {:.4f}", split),
                   rays == 1 ? "the stone is isotropic" : "n_e = n_o", k_unknown);
    decider.decide(Effects::absorption, strongest > 0,
                   fmt::format("up to {:.4f} per mm", strongest), "the stone is clear", 1.0);
    decider.decide(Effects::pleochroism,
                   unequal_absorption && decider.allowed(Effects::absorption) && split > 0,
                   "the two rays are absorbed differently",
                   rays == 1 ? "the stone is isotropic" : "both rays are absorbed alike", 1.0);
    decider.decide(Effects::polarization, true, "faces polarise light, and later faces see it", "",
                   k_unknown);
    decider.decide(Effects::aperture, scene.camera.aperture_radius > 0,
                   fmt::format("pupil radius {:.4g}", scene.camera.aperture_radius),
                   "pinhole camera", k_unknown);

    const bool dispersive = plan.on(Effects::dispersion);
    const bool crystal = plan.on(Effects::birefringence);
    plan.polarised = plan.on(Effects::polarization);
    if (crystal && !plan.polarised) {
        EffectDecision& decision = plan.effects[static_cast<std::size_t>(Effects::polarization)];
        decision.on = true;
        decision.why = "the split waves of a crystal always carry it";
        decision.error_bound = 0;
    }
    if (!given.empty()) {
        plan.wavelengths_nm = given;
    } else if (dispersive || (plan.on(Effects::absorption) && spectral_absorption) ||
               needs_of(scene.lights) == LightNeeds::a_spectrum) {
        plan.wavelengths_nm = even_nodes(k_nodes);
    } else if (needs_of(scene.lights) == LightNeeds::three_for_rgb) {
        // Three nodes carry any RGB light exactly.
        plan.wavelengths_nm = {450, 550, 610};
    } else {
        plan.wavelengths_nm = {k_d_line_nm};
    }

    const double mm = mm_per(scene.stone.unit);
    const int count = static_cast<int>(plan.wavelengths_nm.size());
    const int per_band = dispersive ? 1 : k_band_nodes;
    for (int first = 0; first < count; first += per_band) {
        Band band;
        band.first = first;
        band.count = std::min(per_band, count - first);
        const double nm = dispersive       ? plan.wavelengths_nm[first]
                          : one_wavelength ? given.front()
                                           : k_d_line_nm;
        const double n_o = material.index[0].at(nm),
                     n_e = rays == 2 ? material.index[1].at(nm) : n_o;
        band.crystal = crystal && n_o != n_e;
        // Without the split, light sees the mean over directions of the two vibrations.
        band.n = rays == 2 ? (2 * n_o + n_e) / 3 : n_o;
        band.uniaxial = {scene.stone.crystal.axes[0], n_o, n_e};
        band.absorbs = plan.on(Effects::absorption);
        for (int i = 0; i < band.count; ++i) {
            const double at = plan.wavelengths_nm[first + i];
            double k_o = material.absorption_per_mm[0].at(at) * mm;
            double k_e = rays == 2 ? material.absorption_per_mm[1].at(at) * mm : k_o;
            if (!plan.on(Effects::pleochroism) || !band.crystal)
                k_o = k_e = rays == 2 ? (2 * k_o + k_e) / 3 : k_o;
            band.absorption[0][i] = k_o;
            band.absorption[1][i] = k_e;
        }
        plan.bands.push_back(band);
    }
    return plan;
}

}  // namespace culet
