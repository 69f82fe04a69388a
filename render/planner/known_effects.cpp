#include <fmt/format.h>

#include <cctype>

#include "render/planner/planner.h"
#include "render/setup/a_priori.h"

namespace culet {

namespace {

// Shortens "Garnet (almandine), coloured" to "garnet".
std::string spoken(const Material& material) {
    std::string name = material.name.empty() ? material.id : material.name;
    name = name.substr(0, name.find_first_of("(,"));
    while (!name.empty() && name.back() == ' ') name.pop_back();
    if (name.empty() || name.starts_with("material of")) return "the stone";
    if (name.size() > 1 && std::islower(static_cast<unsigned char>(name[1])))
        name[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(name[0])));
    return name;
}

}  // namespace

void explain_known_effects(const Scene& scene, ScenePlan& plan) {
    const std::string stone = spoken(scene.stone.material);
    const bool isotropic = scene.stone.material.optic == OpticCharacter::isotropic;
    const double absorbed = absorbed_across(scene);
    const auto line = [&](Effects effect) -> PlanItem& {
        return plan.items[static_cast<std::size_t>(effect)];
    };
    const auto where_on = [&](Effects effect, const auto& text) {
        if (line(effect).on) line(effect).why = text();
    };
    if (isotropic) {
        for (Effects effect : {Effects::birefringence, Effects::pleochroism, Effects::coherence})
            line(effect).why = stone + " is isotropic";
    } else if (absorbed == 0) {
        line(Effects::pleochroism).why = stone + " is clear: no wave is absorbed";
    } else if (absorbance_apart(scene) == 0) {
        line(Effects::pleochroism).why = stone + "'s waves are absorbed alike";
    }
    if (absorbed == 0) line(Effects::absorption).why = stone + " is clear";
    where_on(Effects::birefringence, [&] {
        return fmt::format("{}'s two images lie up to {:.2g} px apart", stone, images_apart(scene));
    });
    where_on(Effects::dispersion, [&] {
        const IndexSpans spans = index_spans(scene);
        return fmt::format("{}'s index changes by {:.4f}: colours leave up to {:.2g} degrees apart",
                           stone, spans.dispersion,
                           exit_deviation(spans.dispersion, spans.mean) * 57.29577951308232);
    });
    where_on(Effects::absorption, [&] {
        return fmt::format("{} takes up to {:.0f} % of the light on one way across", stone,
                           100 * absorbed);
    });
    where_on(Effects::pleochroism, [&] {
        return fmt::format("{}'s waves differ by up to {:.2g} in absorbance on one way across",
                           stone, absorbance_apart(scene));
    });
    where_on(Effects::aperture, [&] {
        return fmt::format("the lens blurs points by up to {:.2g} px", aperture_blur(scene));
    });
}

}  // namespace culet
