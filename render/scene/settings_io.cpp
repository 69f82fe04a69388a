#include "render/scene/settings_io.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "render/scene/view_presets.h"
#include "stone/text/name_suggestions.h"

namespace culet {

namespace {

constexpr std::size_t k_most_wavelengths = 1000;

void read_coherence(const TomlTable& table, RenderSettings& settings) {
    switch (table.kind("coherence")) {
        case TomlTable::Kind::missing:
            break;
        case TomlTable::Kind::boolean:
            settings.coherence = *table.boolean("coherence");
            break;
        default: {
            const std::string word = *table.text("coherence");
            if (word != "auto" && word != "on" && word != "off")
                table.fail("coherence",
                           fmt::format("coherence is auto, on or off, found \"{}\"", word));
            if (word != "auto") settings.coherence = word == "on";
        }
    }
    if (const auto bandwidth = table.number("bandwidth")) {
        if (!(*bandwidth >= 0 && *bandwidth <= 1000)) {
            table.fail("bandwidth",
                       fmt::format("bandwidth is in nm, 0 to 1000, found {}", *bandwidth));
        }
        settings.bandwidth_nm = *bandwidth;
    }
}

void read_filter(const TomlTable& table, RenderSettings& settings) {
    const std::string name = table.text("filter").value_or("box");
    if (name == "box") {
        settings.filter = PixelFilter::box;
        settings.filter_radius = 0.5;
    } else if (name == "tent") {
        settings.filter = PixelFilter::tent;
        settings.filter_radius = 1;
    } else if (name == "gaussian") {
        settings.filter = PixelFilter::gaussian;
        settings.filter_radius = 1;
    } else {
        table.fail("filter",
                   fmt::format("no pixel filter \"{}\"; known: box, tent, gaussian", name));
    }
    if (const auto radius = table.number("filter_radius")) {
        if (!(*radius > 0 && *radius <= 8)) {
            table.fail("filter_radius",
                       fmt::format("filter_radius is in pixels, 0 to 8, found {}", *radius));
        }
        settings.filter_radius = *radius;
    }
}

constexpr std::array k_refractions{"astigmatic", "perspective", "parallel"};
constexpr std::array k_checks{"none", "estimate", "full"};

void read_engine(const TomlTable& table, RenderSettings& settings) {
    if (const auto engine = table.text("engine")) {
        const std::vector<std::string> known = engine_names();
        if (std::find(known.begin(), known.end(), *engine) == known.end()) {
            const auto near = nearest_name(*engine, known);
            table.fail("engine", fmt::format("no engine \"{}\"{}; known: {}", *engine,
                                             near ? ", did you mean \"" + *near + "\"?" : "",
                                             fmt::join(known, ", ")));
        }
        settings.engine = *engine;
    }
    if (const auto refraction = table.text("refraction")) {
        const auto found = std::find(k_refractions.begin(), k_refractions.end(), *refraction);
        if (found == k_refractions.end()) {
            table.fail("refraction", fmt::format("no refraction \"{}\"; known: {}", *refraction,
                                                 fmt::join(k_refractions, ", ")));
        }
        settings.refraction = static_cast<Refraction>(found - k_refractions.begin());
    }
    if (const auto beams = table.text("crystal_beams")) {
        // Files written before 0.2.0 say "parted".
        if (*beams != "auto" && *beams != "merged" && *beams != "split" && *beams != "parted") {
            table.fail("crystal_beams",
                       fmt::format("crystal_beams is auto, merged or split, found \"{}\"", *beams));
        }
        if (*beams != "auto")
            settings.crystal_beams =
                *beams == "merged" ? CrystalBeams::merged : CrystalBeams::split;
    }
    if (const auto check = table.text("check")) {
        const auto found = std::find(k_checks.begin(), k_checks.end(), *check);
        if (found == k_checks.end()) {
            table.fail("check", fmt::format("no check \"{}\"; known: {}", *check,
                                            fmt::join(k_checks, ", ")));
        }
        settings.check = static_cast<Check>(found - k_checks.begin());
    }
}

void read_accuracy(const TomlTable& table, RenderSettings& settings) {
    if (const auto depth = table.integer("depth")) {
        if (*depth < 0 || *depth > k_deepest)
            table.fail("depth",
                       fmt::format("depth is 0 (by tolerance) to {}, found {}", k_deepest, *depth));
        settings.depth = static_cast<int>(*depth);
    }
    if (const auto tolerance = table.number("tolerance")) {
        if (!(*tolerance >= 0 && *tolerance <= 1)) {
            table.fail("tolerance",
                       fmt::format("tolerance is a fraction, 0 to 1, found {}", *tolerance));
        }
        settings.tolerance = *tolerance;
    }
    if (settings.tolerance == 0 && settings.depth == 0) {
        table.fail("tolerance", "with tolerance = 0 nothing is cut: give a depth");
    }
    const auto weight_in = [&](const char* key) -> std::optional<double> {
        const auto weight = table.number(key);
        if (weight && !(*weight > 0 && *weight <= 1))
            table.fail(key, fmt::format("{} is a share of the light, above 0 to 1, found {}", key,
                                        *weight));
        return weight;
    };
    settings.cut_weight = weight_in("cut_weight");
    settings.split_weight = weight_in("split_weight");
    const auto factor_in = [&](const char* key) -> std::optional<double> {
        const auto factor = table.number(key);
        if (factor && !(*factor >= 0 && *factor <= 1))
            table.fail(key,
                       fmt::format("{} is a share of the light, 0 to 1, found {}", key, *factor));
        return factor;
    };
    settings.reflection_factor = factor_in("reflection_factor");
    settings.transmission_factor = factor_in("transmission_factor");
    if (const auto beams = table.integer("most_beams")) {
        if (*beams < 1000 || *beams > (1 << 28)) {
            table.fail("most_beams",
                       fmt::format("most_beams is 1000 to {}, found {}", 1 << 28, *beams));
        }
        settings.most_beams = *beams;
    }
    if (const auto clamp = table.number("clamp_indirect")) {
        if (!(*clamp > 0))
            table.fail("clamp_indirect",
                       fmt::format("clamp_indirect is a radiance over 0, found {}", *clamp));
        settings.clamp_indirect = *clamp;
    }
    if (const auto samples = table.integer("samples")) {
        if (*samples < 1 || *samples > 4096)
            table.fail("samples", fmt::format("samples a pixel are 1 to 4096, found {}", *samples));
        settings.samples = static_cast<int>(*samples);
    }
    if (const auto turns = table.integer("wavelength_turns")) {
        if (*turns < 1 || *turns > 4096)
            table.fail("wavelength_turns",
                       fmt::format("wavelength_turns are 1 to 4096, found {}", *turns));
        settings.wavelength_turns = static_cast<int>(*turns);
    }
}

void read_effects(const TomlTable& table, RenderSettings& settings) {
    const auto set_effects = [&](const std::vector<std::string>& names) {
        settings.effects_auto = false;
        settings.effects.fill(false);
        std::vector<std::string> known;
        for (int e = 0; e < k_effect_count; ++e)
            known.emplace_back(name_of(static_cast<Effects>(e)));
        for (const std::string& name : names) {
            const auto found = std::find(known.begin(), known.end(), name);
            if (found == known.end()) {
                const auto near = nearest_name(name, known);
                table.fail("effects", fmt::format("no effect \"{}\"{}; known: {}", name,
                                                  near ? ", did you mean \"" + *near + "\"?" : "",
                                                  fmt::join(known, ", ")));
            }
            settings.effects[static_cast<std::size_t>(found - known.begin())] = true;
        }
    };
    if (table.kind("effects") == TomlTable::Kind::text) {
        const std::string word = *table.text("effects");
        if (word == "none") {
            set_effects({});
        } else if (word == "all") {
            settings.effects_auto = false;
            // "all" does not include coherence: it is used only if the scene calls for it.
            settings.effects[static_cast<std::size_t>(Effects::coherence)] = false;
        } else if (word != "auto") {
            set_effects({word});
        }
    } else if (const auto names = table.texts("effects")) {
        set_effects(*names);
    }
}

void read_wavelengths(const TomlTable& table, RenderSettings& settings) {
    if (auto wavelengths = table.numbers("wavelengths")) {
        if (wavelengths->size() > k_most_wavelengths) {
            table.fail("wavelengths", fmt::format("up to {} wavelengths are rendered, found {}",
                                                  k_most_wavelengths, wavelengths->size()));
        }
        std::sort(wavelengths->begin(), wavelengths->end());
        for (std::size_t i = 0; i < wavelengths->size(); ++i) {
            const double nm = (*wavelengths)[i];
            if (!(nm >= 200 && nm <= 2500)) {
                table.fail("wavelengths",
                           fmt::format("wavelengths are in nm, 200 to 2500, found {}", nm));
            }
            if (i > 0 && nm == (*wavelengths)[i - 1]) {
                table.fail("wavelengths", fmt::format("wavelength {} nm is given twice", nm));
            }
        }
        settings.wavelengths_nm = *wavelengths;
    }
}

std::string quoted(const std::string& word) {
    return "\"" + word + "\"";
}

}  // namespace

RenderSettings read_settings(const TomlTable& table) {
    table.refuse_unknown(with_view_keys(
        {"engine",      "depth",          "tolerance",         "effects",
         "wavelengths", "samples",        "coherence",         "bandwidth",
         "filter",      "filter_radius",  "refraction",        "crystal_beams",
         "cut_weight",  "split_weight",   "most_beams",        "wavelength_turns",
         "check",       "clamp_indirect", "reflection_factor", "transmission_factor"}));
    RenderSettings settings;
    read_engine(table, settings);
    read_coherence(table, settings);
    read_filter(table, settings);
    read_accuracy(table, settings);
    read_effects(table, settings);
    read_wavelengths(table, settings);
    return settings;
}

std::vector<std::pair<std::string, std::string>> written_settings(const RenderSettings& settings) {
    std::vector<std::pair<std::string, std::string>> written;
    const auto write = [&](const char* key, const std::string& value) {
        written.emplace_back(key, value);
    };
    write("engine", quoted(settings.engine));
    write("refraction", quoted(k_refractions[static_cast<std::size_t>(settings.refraction)]));
    if (settings.crystal_beams)
        write("crystal_beams",
              quoted(*settings.crystal_beams == CrystalBeams::merged ? "merged" : "split"));
    write("depth", std::to_string(settings.depth));
    // fmt writes the shortest decimals that read back as the same number.
    write("tolerance", fmt::format("{}", settings.tolerance));
    if (settings.cut_weight) write("cut_weight", fmt::format("{}", *settings.cut_weight));
    if (settings.split_weight) write("split_weight", fmt::format("{}", *settings.split_weight));
    if (settings.clamp_indirect)
        write("clamp_indirect", fmt::format("{}", *settings.clamp_indirect));
    if (settings.samples > 0) write("samples", std::to_string(settings.samples));
    if (settings.reflection_factor)
        write("reflection_factor", fmt::format("{}", *settings.reflection_factor));
    if (settings.transmission_factor)
        write("transmission_factor", fmt::format("{}", *settings.transmission_factor));
    if (settings.wavelength_turns)
        write("wavelength_turns", std::to_string(*settings.wavelength_turns));
    if (!settings.effects_auto) {
        std::vector<std::string> on;
        for (int e = 0; e < k_effect_count; ++e) {
            if (settings.effects[static_cast<std::size_t>(e)])
                on.push_back(quoted(name_of(static_cast<Effects>(e))));
        }
        write("effects", fmt::format("[{}]", fmt::join(on, ", ")));
    }
    if (settings.coherence) write("coherence", *settings.coherence ? "true" : "false");
    if (settings.bandwidth_nm) write("bandwidth", fmt::format("{}", *settings.bandwidth_nm));
    if (!settings.wavelengths_nm.empty())
        write("wavelengths", fmt::format("[{}]", fmt::join(settings.wavelengths_nm, ", ")));
    return written;
}

}  // namespace culet
