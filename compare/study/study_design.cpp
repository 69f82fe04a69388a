#include "compare/study/study_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "compare/study/study_words.h"
#include "render/beams/frame_renderer.h"
#include "render/setup/optical_setup.h"

namespace culet {

namespace {

constexpr std::array k_depths{2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512};
constexpr std::array k_samples{1, 4, 16, 36, 64};
constexpr std::array k_tolerances{0.3, 0.1, 0.03, 0.01, 0.003, 0.001};

void without(RenderSettings& settings, Effects effect) {
    settings.effects_auto = false;
    settings.effects[static_cast<std::size_t>(effect)] = false;
    if (effect == Effects::coherence) settings.coherence = false;
}

std::vector<Effects> effects_on(const RenderStats& stats) {
    std::vector<Effects> on;
    for (const EffectDecision& decision : stats.effects) {
        if (decision.on) on.push_back(decision.effect);
    }
    return on;
}

// Sets of more and more wavelengths, up to the reference's.
std::vector<std::vector<double>> wavelength_sets(const StudiedScene& studied) {
    const std::vector<double>& finest = studied.exact.wavelengths_nm;
    std::vector<std::vector<double>> sets;
    if (studied.scene.settings.wavelengths_nm.size() == 1 || finest.size() < 2) return sets;
    sets.push_back({k_d_line_nm});
    if (finest.size() > 3) sets.push_back({450, 550, 610});
    for (const int count : k_node_counts) {
        Scene scene = studied.scene;
        scene.settings.wavelengths_nm.clear();
        scene.settings.effects_auto = true;
        const std::vector<double> nodes = make_optical_setup(scene, count).wavelengths_nm;
        if (nodes.size() <= finest.size() && nodes.size() > sets.back().size())
            sets.push_back(nodes);
    }
    return sets;
}

// All effects at this tolerance, drawn by `engine`.
RenderSettings with_all(const Scene& scene, const std::string& engine, double tolerance) {
    RenderSettings settings = exact_settings(scene, tolerance, k_node_counts[1]);
    settings.engine = engine;
    if (engine == k_reference_engine) settings.samples = 4;
    return settings;
}

class CandidateDesign {
public:
    explicit CandidateDesign(const StudiedScene& studied) : studied_(studied) {}

    void add(const std::string& sweep, const std::string& setting, const RenderSettings& settings,
             bool automatic = false, bool needed = false) {
        candidates_.push_back({sweep, setting, settings, automatic, needed});
    }

    void automatic() {
        for (const double tolerance : studied_.tolerances) {
            RenderSettings settings = with_all(studied_.scene, k_auto_engine, tolerance);
            settings.effects_auto = true;
            if (studied_.scene.settings.wavelengths_nm.size() != 1) settings.wavelengths_nm.clear();
            add("automatic", fmt::format("tolerance {:g}", tolerance), settings, true,
                tolerance == studied_.tolerance);
        }
    }
    // Engines at all tolerances.
    void engines() {
        std::vector<double> order = studied_.tolerances;
        std::stable_sort(order.begin(), order.end(), [&](double a, double b) {
            return (a == studied_.tolerance) > (b == studied_.tolerance);
        });
        for (const double tolerance : order) {
            const std::string setting = fmt::format("{:g}", tolerance);
            const bool needed = tolerance == studied_.tolerance;
            if (studied_.beams) {
                for (const char* engine : {k_beam_engine, k_preview_engine}) {
                    add("tolerance", setting, with_all(studied_.scene, engine, tolerance), false,
                        needed);
                }
            }
            add("tolerance", setting, with_all(studied_.scene, k_reference_engine, tolerance),
                false, needed);
        }
    }
    // One setting varied at a time; `base` is the faster engine that can draw the scene.
    void sweeps() {
        const RenderSettings base =
            with_all(studied_.scene, studied_.beams ? k_beam_engine : k_reference_engine,
                     studied_.tolerance);
        for (const Effects effect : effects_on(studied_.exact)) {
            RenderSettings settings = base;
            without(settings, effect);
            add("effects", fmt::format("without {}", name_of(effect)), settings);
        }
        RenderSettings none = base;
        none.effects_auto = false;
        none.effects.fill(false);
        add("effects", "none", none);
        for (const std::vector<double>& nm : wavelength_sets(studied_)) {
            RenderSettings settings = base;
            settings.wavelengths_nm = nm;
            add("wavelengths", fmt::format("{}", nm.size()), settings);
        }
        for (const int samples : k_samples) {
            RenderSettings settings =
                with_all(studied_.scene, k_reference_engine, studied_.tolerance);
            settings.samples = samples;
            add("samples", fmt::format("{}", samples), settings);
        }
        if (studied_.beams && studied_.scene.camera.aperture_radius == 0) {
            RenderSettings settings = base;
            settings.samples = 1;
            add("samples", "1", settings);
        }
        for (const int depth : k_depths) {
            if (depth > std::max(48, studied_.exact.depth / 4) || depth >= studied_.exact.depth)
                break;
            RenderSettings settings = base;
            settings.depth = depth;
            add("depth", fmt::format("{}", depth), settings);
        }
        // Limits paths only by weight, at a large depth.
        const int deep = std::min(24, std::max(2, studied_.exact.depth));
        for (const double tolerance : k_tolerances) {
            RenderSettings settings = base;
            settings.depth = deep;
            settings.tolerance = tolerance;
            add("pruning", fmt::format("depth {}, {:g}", deep, tolerance), settings);
        }
        if (!studied_.beams) return;
        if (studied_.scene.stone.material.optic != OpticCharacter::isotropic) {
            for (const CrystalBeams beams : {CrystalBeams::merged, CrystalBeams::split}) {
                RenderSettings settings = base;
                settings.crystal_beams = beams;
                add("crystal beams", beams == CrystalBeams::merged ? "merged" : "split", settings);
            }
        }
    }
    std::vector<StudyCandidate> take() { return std::move(candidates_); }

private:
    const StudiedScene& studied_;
    std::vector<StudyCandidate> candidates_;
};

// The last value of a list for which `coarser` holds.
template <class List, class Coarser>
auto next_coarser(const List& list, Coarser coarser) {
    const auto found = std::find_if(list.rbegin(), list.rend(), coarser);
    return found == list.rend() ? std::nullopt : std::optional(*found);
}

}  // namespace

RenderSettings exact_settings(const Scene& scene, double tolerance, int nodes) {
    RenderSettings settings = scene.settings;
    settings.engine = k_reference_engine;
    settings.tolerance = tolerance;
    settings.depth = 0;
    settings.effects_auto = false;
    settings.effects.fill(true);
    // As "all" in a scene file: if the scene needs it.
    settings.effects[static_cast<std::size_t>(Effects::coherence)] = false;
    settings.crystal_beams.reset();
    settings.cut_weight.reset();
    settings.split_weight.reset();
    settings.checked_pixels = settings.checked_samples = 0;
    settings.refraction = Refraction::astigmatic;
    settings.samples = 0;
    settings.spectral = false;
    // A single wavelength is what the scene shows; several are a matter of accuracy.
    if (settings.wavelengths_nm.size() != 1) {
        settings.wavelengths_nm.clear();
        Scene exact = scene;
        exact.settings = settings;
        settings.wavelengths_nm = make_optical_setup(exact, nodes).wavelengths_nm;
    }
    return settings;
}

std::vector<StudyCandidate> study_design(const StudiedScene& studied) {
    CandidateDesign candidates(studied);
    candidates.automatic();
    candidates.engines();
    candidates.sweeps();
    return candidates.take();
}

std::vector<StudyCandidate> cheaper_neighbours(const StudiedScene& studied,
                                               const RenderSettings& settings,
                                               const RenderStats& drawn) {
    const std::vector<Effects> on = effects_on(drawn);
    std::vector<StudyCandidate> found;
    const auto add = [&](auto change) {
        RenderSettings changed = settings;
        change(changed);
        found.push_back({"search", words_of(studied, changed), changed});
    };
    if (const auto coarser = next_coarser(
            k_tolerances, [&](double t) { return t > settings.tolerance * (1 + 1e-9); }))
        add([&](RenderSettings& s) { s.tolerance = *coarser; });
    if (settings.cut_weight) add([](RenderSettings& s) { s.cut_weight = 3 * *s.cut_weight; });
    if (const auto fewer = next_coarser(wavelength_sets(studied), [&](const auto& nm) {
            return nm.size() < drawn.wavelengths_nm.size();
        }))
        add([&](RenderSettings& s) { s.wavelengths_nm = *fewer; });
    const int depth = settings.depth > 0 ? settings.depth : drawn.depth / 2;
    if (const auto shallower = next_coarser(k_depths, [&](int d) { return d < depth; }))
        add([&](RenderSettings& s) { s.depth = *shallower; });
    for (const Effects effect : on) {
        add([&](RenderSettings& s) {
            if (s.effects_auto) s.effects.fill(true);
            without(s, effect);
        });
    }
    if (settings.engine == k_reference_engine) {
        const int samples = settings.samples > 0 ? settings.samples : 16;
        if (const auto less = next_coarser(k_samples, [&](int s) { return s < samples; }))
            add([&](RenderSettings& s) { s.samples = *less; });
    }
    if (settings.engine == k_beam_engine) {
        add([](RenderSettings& s) {
            s.engine = k_preview_engine;
            s.samples = 0;
        });
        if (studied.scene.camera.aperture_radius == 0)
            add([](RenderSettings& s) { s.samples = s.samples == 1 ? 0 : 1; });
    }
    if (drawn_by_beams(settings) && settings.crystal_beams != CrystalBeams::merged &&
        std::find(on.begin(), on.end(), Effects::birefringence) != on.end())
        add([](RenderSettings& s) { s.crystal_beams = CrystalBeams::merged; });
    return found;
}

}  // namespace culet
