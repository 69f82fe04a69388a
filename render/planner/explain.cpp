#include "render/planner/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "render/beams/frame_renderer.h"
#include "render/planner/planner.h"
#include "render/scene/settings_io.h"

namespace culet {

ScenePlan plan_scene(const Scene& scene, const Progress& progress) {
    return Planner(scene, progress).run_to_explain(false);
}

ScenePlan plan_to_explain(const Scene& scene, const Progress& progress) {
    ScenePlan plan = Planner(scene, progress).run_to_explain(true);
    for (PlanItem& line : plan.items) {
        if (line.name == name_of(Effects::birefringence) && line.on &&
            tried_with_merged_waves(scene))
            line.why +=
                ", which a few rays overrate: the picture is first drawn with merged waves, and "
                "kept if the check agrees";
    }
    return plan;
}

namespace {

const std::map<std::string, std::string> k_fidelities{
    {"dispersion", "each wavelength its own way"},
    {"birefringence", "both waves, each its own way"},
    {"polarization", "exact at every face"},
    {"absorption", "along every segment"},
    {"pleochroism", "each wave by its own direction"},
    {"aperture", "points of the pupil"},
    {"coherence", "until their retardation is too large"}};

std::string depth_of(const ScenePlan& plan, const RenderSettings& user, bool endless) {
    if (user.depth > 0) return fmt::format("{} faces", user.depth);
    if (endless) return "no limit: weak paths end at random";
    return fmt::format("paths above {:.2g} of the light", plan.settings.cut_weight.value_or(0));
}

std::string wavelengths_of(const std::vector<double>& nm) {
    if (nm.empty()) return "as the scene calls for";
    return nm.size() == 1 ? fmt::format("{:g} nm alone", nm[0])
                          : fmt::format("{} wavelengths", nm.size());
}

std::string in_seconds(double seconds) {
    if (seconds < 1) return fmt::format("{:.0f} ms", std::max(1.0, 1e3 * seconds));
    if (seconds < 100) return fmt::format("{:.1f} s", seconds);
    return fmt::format("{:.0f} s", seconds);
}

}  // namespace

void set_resolutions(ScenePlan& plan, const Scene& scene, const RenderSettings& user) {
    plan.items.resize(k_effect_count);
    for (PlanItem& line : plan.items) line.fidelity = line.on ? k_fidelities.at(line.name) : "";
    const auto add = [&plan](const char* name, bool on, std::string fidelity, std::string why,
                             double bound = 0) {
        PlanItem line;
        line.name = name;
        line.on = on;
        line.fidelity = std::move(fidelity);
        line.why = std::move(why);
        line.bound = line.bound_delta_e = bound;
        line.seconds_with = line.seconds_without = plan.seconds;
        plan.items.push_back(std::move(line));
    };
    const bool beams = drawn_by_beams(plan.settings),
               preview = plan.settings.engine == k_preview_engine;
    const bool endless =
        !beams && (plan.item(name_of(Effects::birefringence)).on || !scene.stone.convex);
    add("depth", true, depth_of(plan, user, endless),
        user.depth > 0 ? "as the scene says"
        : endless      ? "every path is followed"
                       : fmt::format("{:.3g} faces on average", plan.events_per_ray),
        user.depth > 0 ? plan.bound_of_depth : 0);
    const std::vector<double>& nm = plan.settings.wavelengths_nm;
    add("wavelengths", nm.size() > 1, wavelengths_of(nm),
        !user.wavelengths_nm.empty()         ? "as the scene says"
        : plan.settings.wavelength_turns > 1 ? "the rays of a pixel take turns with them"
        : nm.size() == 1                     ? "nothing depends on wavelength"
                                             : "more where the check asks for them");
    const int rays = plan.settings.samples;
    add("samples", !beams,
        preview ? "exact areas, one colour a region"
        : beams ? "exact areas"
                : fmt::format("{} ray{} a pixel", rays, rays == 1 ? "" : "s"),
        beams              ? "beams tile the picture"
        : user.samples > 0 ? "as the scene says"
                           : "as few as their noise allows",
        beams ? 0 : plan.bound_of_sampling);
    const bool edges =
        std::any_of(scene.lights.sources.begin(), scene.lights.sources.end(), has_edge);
    add("light_edges", edges,
        !edges    ? ""
        : preview ? "one colour a region"
        : beams   ? "averaged over the pixel"
                  : "by the rays of the pixel",
        edges ? "lights with sharp edges" : "no light has an edge");
    const bool map = scene.lights.environment != nullptr, filtered = map && beams && !preview;
    add("environment_filter", filtered, filtered ? "mean over what a pixel sees" : "",
        !map      ? "there is no environment map"
        : preview ? "one colour a region"
        : beams   ? "a pixel sees many texels"
                  : "every ray looks up its own texels");
    add("objects", false, "", "nothing stands beside the stone");
}

std::string explain(const ScenePlan& plan) {
    std::string text =
        fmt::format("{:<19}{:<5}{}: {}\n", "engine", "", plan.settings.engine, plan.engine_why);
    for (const PlanItem& line : plan.items) {
        text += fmt::format("{:<19}{:<5}", line.name, line.on ? "on:" : "off:");
        if (!line.fidelity.empty()) text += line.fidelity + "; ";
        text += line.why;
        // Only weighed effects; those that a scene cannot have take no time either way.
        if (line.seconds_with != line.seconds_without || line.matters > 0) {
            text += fmt::format(" ({}, {} it {})",
                                in_seconds(line.on ? line.seconds_with : line.seconds_without),
                                line.on ? "without" : "with",
                                in_seconds(line.on ? line.seconds_without : line.seconds_with));
        }
        text += "\n";
    }
    if (plan.pilot_pixels > 0) {
        text += fmt::format(
            "{:<19}{:<5}{:.2g} of the mean radiance, CIEDE2000 {:.2g}", "error bound", "",
            plan.bound + (plan.settings.engine == k_reference_engine ? plan.bound_of_sampling : 0),
            plan.bound_delta_e);
        if (plan.settings.engine != k_reference_engine)
            text += "; plus the beams' own error, measured on the finished picture";
        text += fmt::format("\n{:<19}{:<5}{} of processor time; with everything on {}\n", "time",
                            "", in_seconds(plan.seconds), in_seconds(plan.seconds_everything));
    }
    return text;
}

std::string plan_json(const ScenePlan& plan) {
    using Json = nlohmann::ordered_json;
    const auto number = [](double v) { return std::isnan(v) ? Json(nullptr) : Json(v); };
    Json items = Json::array();
    for (const PlanItem& line : plan.items) {
        items.push_back({{"name", line.name},
                         {"on", line.on},
                         {"fidelity", line.fidelity},
                         {"why", line.why},
                         {"error_bound", number(line.bound)},
                         {"error_bound_deltaE00", number(line.bound_delta_e)},
                         {"matters", number(line.matters)},
                         {"matters_deltaE00", number(line.matters_delta_e)},
                         {"seconds_with", number(line.seconds_with)},
                         {"seconds_without", number(line.seconds_without)}});
    }
    Json settings = Json::object();
    for (const auto& [key, value] : written_settings(plan.settings))
        settings[key] = Json::parse(value);
    const Json json = {{"schema", 1},
                       {"engine", plan.settings.engine},
                       {"engine_why", plan.engine_why},
                       {"tolerance", plan.tolerance},
                       {"depth", plan.settings.depth},
                       {"cut_weight", plan.settings.cut_weight.value_or(0)},
                       {"samples", plan.settings.samples},
                       {"wavelengths", plan.settings.wavelengths_nm},
                       {"items", items},
                       {"error_bound", number(plan.bound)},
                       {"error_bound_of_sampling", number(plan.bound_of_sampling)},
                       {"error_bound_deltaE00", number(plan.bound_delta_e)},
                       {"seconds", plan.seconds},
                       {"seconds_everything", plan.seconds_everything},
                       {"seconds_planning", plan.seconds_planning},
                       {"pilot_pixels", plan.pilot_pixels},
                       {"mean_radiance", plan.mean_radiance},
                       {"settings", settings},
                       {"stone_and_light", plan.stone_and_light},
                       {"checked_bound", number(plan.checked_bound)}};
    return json.dump(2) + "\n";
}

}  // namespace culet
