#include "viewer/engine/viewer_engine.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <utility>

#include "render/gpu/gpu_program.h"
#include "render/image/exposure.h"
#include "render/image/shown_bytes.h"
#include "render/reference/probe.h"
#include "render/scene/light_presets.h"
#include "stone/cuts/cuts.h"
#include "stone/text/errors.h"
#include "viewer/engine/engine_lists.h"
#include "viewer/engine/frame_request.h"
#include "viewer/engine/gpu_answer.h"
#include "viewer/engine/panorama.h"
#include "viewer/engine/shown_stone.h"
#include "viewer/engine/stone_json.h"
#include "viewer/engine/view_source.h"

namespace culet {

using Json = nlohmann::ordered_json;

struct ViewerEngine::State {
    std::string version;
    ViewItem item;
    std::vector<ShownStone> stones;
    std::size_t now = 0;
    std::vector<std::string> settings;
    std::vector<std::uint8_t> pixels;
    std::vector<float> radiance, texels;

    ShownStone& shown();
    FrameRequest request_of(const Json& arguments) {
        return frame_request(arguments, shown().scene().camera);
    }
    Json open(const Json& arguments, std::string_view document);
    Json set(const Json& arguments);
    Json picture(const Json& arguments, bool shown_as_bytes);
    Json gpu(const Json& arguments);
    Json path(const Json& arguments);
    Json cut(const Json& arguments);
    Json panorama(const Json& arguments, std::string_view bytes);
    Json stone(const Json& arguments, std::string_view bytes);

    struct Call {
        std::string_view name;
        Json (*answer)(State&, const Json& arguments, std::string_view attached);
    };
    static const Call k_calls[9];
};

ShownStone& ViewerEngine::State::shown() {
    if (stones.empty()) throw InputError("no stone is open");
    return stones[now];
}

Json ViewerEngine::State::open(const Json& arguments, std::string_view document) {
    ViewItem opened = read_view_item(document, arguments.value("item", 0));
    std::vector<ShownStone> all;
    for (ViewedStone& viewed : opened.stones)
        all.emplace_back(std::move(viewed), opened.scene, opened.files, opened.name);
    item = std::move(opened);
    stones = std::move(all);
    now = stones.empty() ? 0 : stones.size() - 1;
    settings.clear();
    Json shown_stones = Json::array();
    for (const ShownStone& stone : stones) shown_stones.push_back(summary_of(stone.viewed()));
    Json result{{"stones", shown_stones},  {"stone", now},
                {"refused", item.refused}, {"materials", material_list()},
                {"lights", light_list()},  {"cuts", cut_list()},
                {"version", version}};
    if (!stones.empty()) {
        const Scene& scene = shown().scene();
        result["camera"] = json_of(scene.camera);
        result["settings"] = settings_of(scene);
    }
    return result;
}

Json ViewerEngine::State::set(const Json& arguments) {
    const std::size_t wanted = arguments.value("stone", now);
    if (wanted >= stones.size())
        throw InputError(fmt::format("there is no stone {}, counted from 0", wanted));
    const auto keys = arguments.value("settings", settings);
    stones[wanted].set(keys, item.scene, item.files, item.name);
    now = wanted;
    settings = keys;
    const ShownStone& stone = shown();
    const OpticalSetup setup = make_optical_setup(stone.scene());
    Json effects = Json::array();
    for (const EffectDecision& decision : setup.effects) {
        effects.push_back(
            {{"name", name_of(decision.effect)}, {"on", decision.on}, {"why", decision.why}});
    }
    return {{"stone", now},
            {"wavelengths", setup.wavelengths_nm},
            {"engine", stone.scene().stone.convex ? k_beam_engine : k_reference_engine},
            {"effects", effects},
            {"notes", stone.scene().notes},
            {"refused", item.refused.empty() ? stone.refused() : item.refused},
            {"gpu_refused", item.refused.empty() ? refused_by_gpu(stone.scene()) : item.refused},
            {"camera", json_of(stone.scene().camera)},
            {"settings", settings_of(stone.scene())}};
}

Json ViewerEngine::State::picture(const Json& arguments, bool shown_as_bytes) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const FrameRequest request = request_of(arguments);
    if (!item.refused.empty()) throw InputError(item.refused);
    const RenderResult& result = shown().draw(request);
    const Scene& scene = shown().scene();
    Json answer{{"width", result.picture.width}, {"height", result.picture.height}};
    if (shown_as_bytes) {
        PngLook look = scene.film;
        look.ground = 0;  // the page's own
        if (const auto map = tone_map_named(arguments.value("tonemap", ""))) look.tone_map = *map;
        const auto asked = arguments.find("exposure");
        const LightPreset* const preset = find_light_preset(scene.light_preset);
        const bool to_the_stone = asked == arguments.end() || asked->is_null()
                                      ? preset != nullptr && !preset->instrument
                                      : asked->is_string();
        if (to_the_stone) {
            look.exposure = exposure_for_stone(result.picture, look.share_over_white);
        } else if (asked != arguments.end() && asked->is_number()) {
            look.exposure = asked->get<double>();
            if (!(look.exposure > 0 && std::isfinite(look.exposure)))
                throw InputError("exposure is auto, or a factor on linear light above 0");
        }
        pixels = shown_bytes(result.picture, look, true);
        answer["exposure"] = look.exposure;
    } else {
        radiance = result.picture.rgb;
    }
    const std::chrono::duration<double, std::milli> took = Clock::now() - start;
    answer["milliseconds"] = took.count();
    answer["build_ms"] = 1e3 * result.stats.seconds_build;
    answer["shade_ms"] = 1e3 * result.stats.seconds_shade;
    answer["beams"] = result.stats.beams;
    answer["depth"] = result.stats.depth;
    answer["wavelengths"] = result.stats.wavelengths_nm;
    answer["remainder"] = result.stats.remainder;
    return answer;
}

Json ViewerEngine::State::gpu(const Json& arguments) {
    FrameRequest request = request_of(arguments);
    const int samples = request.samples.value_or(1);
    GpuAnswer answer = gpu_answer(shown(), request, samples, arguments.value("known", ""));
    texels = std::move(answer.texels);
    return std::move(answer.json);
}

Json ViewerEngine::State::path(const Json& arguments) {
    const Scene scene = shown().scene_of(request_of(arguments));
    const EyeRay ray = EyeRays(scene.camera).through(arguments.at("x"), arguments.at("y"));
    return Json::parse(probe_json(probe(scene, ray)));
}

Json ViewerEngine::State::cut(const Json& arguments) {
    const ViewedStone& before = shown().viewed();
    ViewedStone viewed;
    viewed.role = "design";
    viewed.cut =
        CutChoice{arguments.at("kind"), arguments.value("values", std::map<std::string, double>())};
    Stone& stone = viewed.stone;
    stone = before.stone;
    stone.name = viewed.cut->kind;
    stone.solid = make_cut(viewed.cut->kind, viewed.cut->values);
    stone.up = {0, 0, 1};
    stone.up_facet.clear();
    stone.convex = cut_kind(viewed.cut->kind).convex;
    // Cuts are in mm.
    for (Vec3& vertex : stone.solid.vertices) vertex /= mm_per(stone.unit);
    for (Facet& facet : stone.solid.facets) facet.plane.offset /= mm_per(stone.unit);
    ShownStone design(viewed, item.scene, item.files, item.name);
    design.set(settings, item.scene, item.files, item.name);
    const auto place = std::find_if(stones.begin(), stones.end(), [](const ShownStone& one) {
        return one.viewed().role == "design";
    });
    now = static_cast<std::size_t>(place - stones.begin());
    if (place == stones.end()) {
        stones.push_back(std::move(design));
    } else {
        *place = std::move(design);
    }
    return {{"stone", now}, {"summary", summary_of(viewed)}, {"geometry", json_of(viewed)}};
}

Json ViewerEngine::State::panorama(const Json& arguments, std::string_view bytes) {
    Panorama panorama = panorama_of(arguments.at("name").get<std::string>(), bytes);
    const std::string setting = fmt::format("light={{environment=\"{}\"}}", panorama.name);
    std::vector<std::string> keys = settings;
    std::erase_if(keys, [](const std::string& key) { return key.starts_with("light"); });
    keys.push_back(setting);
    HeldFiles files = item.files;
    files[panorama.name] = std::move(panorama.bytes);
    shown().set(keys, item.scene, files, item.name);
    item.files = std::move(files);
    settings = keys;
    return {{"name", panorama.name},
            {"setting", setting},
            {"width", panorama.width},
            {"height", panorama.height},
            {"notes", panorama.notes}};
}

// In the material that is shown: `material` of the catalogue, or the shown stone's own.
Json ViewerEngine::State::stone(const Json& arguments, std::string_view bytes) {
    const Material own = shown().viewed().stone.material;
    const std::string chosen = arguments.value("material", "");
    const std::string material = chosen.empty() ? own.id : chosen;
    ViewSource source;
    source.file = std::filesystem::path(arguments.at("name").get<std::string>()).filename();
    source.choices.material = material.empty() ? "diamond" : material;
    source.choices.held[source.file.string()] = bytes;
    Scene scene;
    std::vector<std::string> notes;
    ViewItem read = item_of(source, notes, scene);
    if (chosen.empty()) read.stones.back().stone.material = own;
    if (material.empty()) {
        source.choices.material = "MATERIAL.toml";
        read.command = render_command(source);
    }
    read.name = source.file.filename().string();
    return {{"item", json_of(read)}};
}

// The only list of a page's calls, whether the engine runs in a worker or in the program.
const ViewerEngine::State::Call ViewerEngine::State::k_calls[] = {
    {"open", [](State& s, const Json& a, std::string_view text) { return s.open(a, text); }},
    {"set", [](State& s, const Json& a, std::string_view) { return s.set(a); }},
    {"draw", [](State& s, const Json& a, std::string_view) { return s.picture(a, true); }},
    {"radiance", [](State& s, const Json& a, std::string_view) { return s.picture(a, false); }},
    {"gpu", [](State& s, const Json& a, std::string_view) { return s.gpu(a); }},
    {"path", [](State& s, const Json& a, std::string_view) { return s.path(a); }},
    {"cut", [](State& s, const Json& a, std::string_view) { return s.cut(a); }},
    {"panorama",
     [](State& s, const Json& a, std::string_view text) { return s.panorama(a, text); }},
    {"stone", [](State& s, const Json& a, std::string_view text) { return s.stone(a, text); }},
};

ViewerEngine::ViewerEngine(std::string version) : state_(std::make_unique<State>()) {
    state_->version = std::move(version);
}
ViewerEngine::~ViewerEngine() = default;
ViewerEngine::ViewerEngine(ViewerEngine&&) noexcept = default;

std::string ViewerEngine::answer(std::string_view call, std::string_view arguments,
                                 std::string_view attached) {
    const auto known = std::find_if(std::begin(State::k_calls), std::end(State::k_calls),
                                    [&](const State::Call& one) { return one.name == call; });
    if (known == std::end(State::k_calls)) throw InputError(fmt::format("no call \"{}\"", call));
    try {
        return known->answer(*state_, Json::parse(arguments), attached).dump();
    } catch (const Json::exception& error) {
        throw InputError(fmt::format("{}: what was asked is not understood: {}", call,
                                     for_terminal(error.what())));
    }
}

std::vector<std::string_view> ViewerEngine::calls() {
    std::vector<std::string_view> names;
    for (const State::Call& call : State::k_calls) names.push_back(call.name);
    return names;
}

const std::vector<std::uint8_t>& ViewerEngine::pixels() const {
    return state_->pixels;
}
const std::vector<float>& ViewerEngine::radiance() const {
    return state_->radiance;
}
const std::vector<float>& ViewerEngine::texels() const {
    return state_->texels;
}

}  // namespace culet
