#include "compare/study/study_words.h"

#include <fmt/format.h>

#include "render/setup/optical_setup.h"

namespace culet {

std::vector<std::string> effects_left_out(const StudiedScene& studied,
                                          const RenderSettings& settings) {
    std::vector<std::string> names;
    Scene scene = studied.scene;
    scene.settings = settings;
    const OpticalSetup setup = make_optical_setup(scene);
    for (const EffectDecision& decision : studied.exact.effects) {
        if (decision.on && !setup.on(decision.effect)) names.emplace_back(name_of(decision.effect));
    }
    return names;
}

std::string words_of(const StudiedScene& studied, const RenderSettings& settings) {
    std::string words = settings.engine;
    if (settings.samples > 0)
        words +=
            fmt::format(", {} ray{} a pixel", settings.samples, settings.samples > 1 ? "s" : "");
    if (!settings.wavelengths_nm.empty() && studied.exact.wavelengths_nm.size() > 1) {
        words += fmt::format(", {} wavelength{}", settings.wavelengths_nm.size(),
                             settings.wavelengths_nm.size() > 1 ? "s" : "");
    }
    if (settings.depth > 0) words += fmt::format(", depth {}", settings.depth);
    words += fmt::format(", tolerance {:g}", settings.tolerance);
    if (settings.cut_weight) words += fmt::format(", weights over {:.2g}", *settings.cut_weight);
    if (settings.crystal_beams) {
        words +=
            *settings.crystal_beams == CrystalBeams::merged ? ", waves merged" : ", waves split";
    }
    const std::vector<std::string> out = effects_left_out(studied, settings);
    if (!out.empty()) words += fmt::format(", without {}", fmt::join(out, ", "));
    return words;
}

std::string key_of(const StudiedScene& studied, const RenderSettings& settings) {
    return fmt::format("{}|{}|{}|{}|{}|{}|{}|{}|{}|{}", settings.engine, settings.samples,
                       settings.tolerance, settings.depth, settings.effects_auto,
                       fmt::join(settings.wavelengths_nm, " "),
                       settings.crystal_beams ? static_cast<int>(*settings.crystal_beams) : -1,
                       settings.cut_weight.value_or(-1), settings.split_weight.value_or(-1),
                       fmt::join(effects_left_out(studied, settings), " "));
}

}  // namespace culet
