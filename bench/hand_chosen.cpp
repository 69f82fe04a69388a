#include "bench/hand_chosen.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "render/beams/frame_renderer.h"
#include "render/planner/planner.h"
#include "render/planner/wavelengths.h"
#include "stone/text/errors.h"
#include "tests/cpu_time.h"

namespace culet {

namespace {

constexpr double k_cuts[] = {0.3, 0.1, 0.03, 0.01, 0.003, 0.001};
constexpr int k_nodes[] = {1, 3, 5, 8, 15};
constexpr int k_sides[] = {1, 2, 3, 4, 6, 8, 12, 16, 24};
// Settings are not pursued if their error exceeds the tolerance, or their cost that of another one
// within it, by this factor.
constexpr double k_hopeless = 4;

struct Hand {
    std::vector<Effects> without;
    std::string words;
};

std::vector<Hand> hands(const Scene& scene) {
    const OpticalSetup whole = make_optical_setup(scene);
    std::vector<Hand> found{{{}, ""}};
    if (whole.on(Effects::birefringence)) found.push_back({{Effects::birefringence}, ", one wave"});
    const std::size_t count = found.size();
    for (std::size_t i = 0; i < count; ++i) {
        Hand less = found[i];
        less.without.push_back(Effects::polarization);
        less.words += ", unpolarised";
        // Split waves carry polarisation anyway.
        if (!whole.splits || i > 0) found.push_back(less);
    }
    return found;
}

RenderSettings with(const Scene& scene, const Hand& hand, int nodes, double cut) {
    RenderSettings settings = scene.settings;
    settings.effects_auto = false;
    settings.effects.fill(true);
    settings.effects[static_cast<std::size_t>(Effects::coherence)] = false;
    for (Effects effect : hand.without) settings.effects[static_cast<std::size_t>(effect)] = false;
    settings.wavelengths_nm = nodes == 1 ? std::vector<double>{589.3} : even_wavelengths(nodes);
    settings.tolerance = cut;
    settings.cut_weight = cut;
    settings.split_weight = std::max(0.1, cut);
    return settings;
}

}  // namespace

namespace {

// For the reference, which is equally accurate at all pixels, a few suffice.
Truth some_of(const Truth& truth) {
    constexpr std::size_t k_some = 200;
    Truth some = truth;
    some.pixels = truth.pixels.range(0, k_some);
    some.drawing.rgb.resize(some.pixels.at.size());
    return some;
}

}  // namespace

ReferenceSample sample_reference(const Scene& scene, const Truth& truth) {
    const RenderSettings& settings = scene.settings;
    PathLimits limits;
    limits.seed = settings.seed;
    limits.depth = settings.depth > 0 ? settings.depth : k_deepest;
    limits.cut_weight = settings.cut_weight.value_or(settings.tolerance);
    limits.split_weight = settings.split_weight.value_or(0.1);
    limits.roulette = make_optical_setup(scene).splits;
    const PilotDrawing drawing = draw_pilot(scene, truth.pixels, limits, settings.samples);
    ReferenceSample sample;
    // The time of the rays only; setup weighs little in a whole picture.
    sample.cpu =
        drawing.seconds * truth.pixels.in_picture / static_cast<double>(truth.pixels.at.size());
    Picture picture;
    picture.width = scene.camera.width;
    picture.height = scene.camera.height;
    picture.rgb.resize(3 * picture.pixels());
    for (std::size_t i = 0; i < truth.pixels.at.size(); ++i) {
        const auto [x, y] = truth.pixels.at[i];
        for (std::size_t c = 0; c < 3; ++c)
            picture.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                             static_cast<std::size_t>(x)) +
                        c] = static_cast<float>(drawing.rgb[i][c]);
    }
    sample.found = compare_with_truth(truth, picture);
    sample.halves_apart = drawing.few_rays;
    return sample;
}

std::vector<HandChosen> hand_chosen(const Scene& whole, const Truth& truth, double finest) {
    std::vector<HandChosen> found;
    Scene scene = whole;
    const double seconds_of_pixel =
        truth.drawing.seconds / static_cast<double>(truth.pixels.at.size());
    double best = std::numeric_limits<double>::infinity();  // within the finest tolerance
    const auto keep = [&](const std::string& words, double cpu, double error) {
        found.push_back({words, cpu, error});
        if (error <= finest) best = std::min(best, cpu);
    };
    const bool crystal = make_optical_setup(scene).splits;
    const Truth some = some_of(truth);
    for (const Hand& hand : hands(scene)) {
        for (const char* engine : {"preview", "beams"}) {
            for (int nodes : k_nodes) {
                double before = std::numeric_limits<double>::infinity();
                for (double cut : k_cuts) {
                    scene.settings = with(whole, hand, nodes, cut);
                    scene.settings.engine = engine;
                    if (!refused_by_beams(scene).empty()) continue;
                    if (cut < 0.3 * finest) break;
                    RenderResult drawn;
                    const Clocks took =
                        quickest([&] { drawn = FrameRenderer(scene).draw(false); }, 1, 0);
                    const double error = compare_with_truth(truth, drawn.picture).measured;
                    keep(fmt::format("{}, {} nm, cut {:g}{}", engine, nodes, cut, hand.words),
                         took.cpu, error);
                    // Stop at finer cuts that gain nothing, or cost more than what already
                    // suffices.
                    if (error > 0.95 * before || took.cpu > k_hopeless * best) break;
                    before = error;
                }
            }
        }
        for (int nodes : k_nodes) {
            for (bool turns : {false, true}) {
                for (double cut : {0.1, 0.03, 0.01, 0.003}) {
                    if (crystal && cut < 0.01) break;
                    double before = std::numeric_limits<double>::infinity();
                    for (int side : k_sides) {
                        scene.settings = with(whole, hand, nodes, cut);
                        scene.settings.engine = "reference";
                        scene.settings.samples = side * side;
                        const int turn = turns_for(side * side, nodes);
                        if (turns && turn == 1) continue;
                        scene.settings.wavelength_turns = turns ? turn : 1;
                        // Costs as much as the truth's rays, which carry about four wavelengths.
                        if (turns == false && nodes > 3 && side > 3) break;
                        const ReferenceSample sample = sample_reference(scene, some);
                        const double error = sample.found.measured;
                        keep(fmt::format("reference, {} rays, {} nm{}, cut {:g}{}", side * side,
                                         nodes, turns ? " in turns" : "", cut, hand.words),
                             sample.cpu, error);
                        if (error <= finest || error > 0.95 * before ||
                            sample.cpu >
                                std::min(2 * best, seconds_of_pixel * truth.pixels.in_picture))
                            break;
                        before = error;
                    }
                }
            }
        }
    }
    return found;
}

const HandChosen* cheapest_within(const std::vector<HandChosen>& settings, double tolerance) {
    const HandChosen* best = nullptr;
    for (const HandChosen& one : settings) {
        if (one.error <= tolerance && (best == nullptr || one.cpu < best->cpu)) best = &one;
    }
    return best;
}

}  // namespace culet
