#include "render/planner/resolutions.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "render/beams/frame_renderer.h"

namespace culet {

namespace {

// How finely an effect that is on is simulated.
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
    if (endless) return "no limit: small paths are left to chance";
    return fmt::format("paths above {:.2g} of the light", plan.settings.cut_weight.value_or(0));
}

std::string wavelengths_of(const std::vector<double>& nm) {
    if (nm.empty()) return "as the scene calls for";
    return nm.size() == 1 ? fmt::format("{:g} nm alone", nm[0])
                          : fmt::format("{} wavelengths", nm.size());
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
        : endless      ? "trees of light paths have no end"
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

}  // namespace culet
