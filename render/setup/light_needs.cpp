#include "render/setup/light_needs.h"

#include <algorithm>

namespace culet {

namespace {

LightNeeds needs_of(const LightColour& light) {
    if (std::holds_alternative<double>(light.value)) return LightNeeds::one_wavelength;
    if (std::holds_alternative<Rgb>(light.value)) return LightNeeds::three_for_rgb;
    return std::get<std::string>(light.value) == "D65" ? LightNeeds::one_wavelength
                                                       : LightNeeds::a_spectrum;
}

LightNeeds needs_of(const Lights& lights) {
    LightNeeds most = lights.environment ? LightNeeds::three_for_rgb : LightNeeds::one_wavelength;
    for (const Light& light : lights.sources) most = std::max(most, needs_of(colour_of(light)));
    return most;
}

LightNeeds needs_of(const SurfaceColour& colour) {
    return std::holds_alternative<double>(colour.value) ? LightNeeds::one_wavelength
                                                        : LightNeeds::three_for_rgb;
}

LightNeeds needs_of(const SurfaceMaterial& material) {
    return std::visit(
        [](const auto& m) {
            using M = std::decay_t<decltype(m)>;
            if constexpr (std::is_same_v<M, EmitterMaterial>) {
                return needs_of(m.radiance);
            } else if constexpr (std::is_same_v<M, DielectricMaterial>) {
                return needs_of(m.absorption);
            } else if constexpr (std::is_same_v<M, MetalMaterial>) {
                return m.f0 ? needs_of(*m.f0) : std::max(needs_of(m.n), needs_of(m.k));
            } else {
                return needs_of(m.albedo);
            }
        },
        material);
}

}  // namespace

LightNeeds light_needs(const Scene& scene) {
    LightNeeds most = needs_of(scene.lights);
    for (const SceneObject& object : scene.objects)
        most = std::max(most, needs_of(object.material));
    return most;
}

bool surroundings_polarise(const Scene& scene) {
    if (!scene.more_stones.empty()) return true;
    return std::any_of(scene.objects.begin(), scene.objects.end(), [](const SceneObject& object) {
        const auto* metal = std::get_if<MetalMaterial>(&object.material);
        return std::holds_alternative<DielectricMaterial>(object.material) ||
               (metal != nullptr && metal->roughness == 0);
    });
}

}  // namespace culet
