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

class Lines {
public:
    Lines(ScenePlan& plan, const Scene& scene, const RenderSettings& user)
        : plan_(plan),
          scene_(scene),
          user_(user),
          beams_(drawn_by_beams(plan.settings)),
          preview_(plan.settings.engine == k_preview_engine) {}

    void add_all() {
        add_depth();
        add_wavelengths();
        add_samples();
        const bool edges =
            std::any_of(scene_.lights.sources.begin(), scene_.lights.sources.end(), has_edge);
        add("light_edges", edges,
            !edges     ? ""
            : preview_ ? "one colour a region"
            : beams_   ? "averaged over the pixel"
                       : "by the rays of the pixel",
            edges ? "lights with sharp edges" : "no light has an edge", 0);
        const bool map = scene_.lights.environment != nullptr;
        const bool filtered = map && beams_ && !preview_;
        add("environment_filter", filtered, filtered ? "mean over what a pixel sees" : "",
            !map       ? "there is no environment map"
            : preview_ ? "one colour a region"
            : beams_   ? "a pixel sees many texels"
                       : "every ray looks up its own texels",
            0);
        add("objects", false, "", "nothing stands beside the stone", 0);
    }

private:
    void add(const char* name, bool on, std::string fidelity, std::string why, double bound) {
        PlanItem line;
        line.name = name;
        line.on = on;
        line.fidelity = std::move(fidelity);
        line.why = std::move(why);
        line.bound = line.bound_delta_e = bound;
        line.seconds_with = line.seconds_without = plan_.seconds;
        plan_.items.push_back(std::move(line));
    }
    void add_depth() {
        const bool branches =
            plan_.item(name_of(Effects::birefringence)).on || !scene_.stone.convex;
        if (user_.depth > 0) {
            add("depth", true, fmt::format("{} faces", user_.depth), "as the scene says",
                plan_.bound_of_depth);
        } else if (branches && !beams_) {
            add("depth", true, "no limit: small paths are left to chance",
                "trees of light paths have no end", 0);
        } else {
            add("depth", true,
                fmt::format("paths above {:.2g} of the light",
                            plan_.settings.cut_weight.value_or(0)),
                fmt::format("{:.3g} faces on average", plan_.events_per_ray), 0);
        }
    }
    void add_wavelengths() {
        const std::vector<double>& nm = plan_.settings.wavelengths_nm;
        add("wavelengths", nm.size() > 1,
            nm.empty()       ? "as the scene calls for"
            : nm.size() == 1 ? fmt::format("{:g} nm alone", nm[0])
                             : fmt::format("{} wavelengths", nm.size()),
            !user_.wavelengths_nm.empty()         ? "as the scene says"
            : plan_.settings.wavelength_turns > 1 ? "the rays of a pixel take turns with them"
            : nm.size() == 1                      ? "nothing depends on wavelength"
                                                  : "more where the check asks for them",
            0);
    }
    void add_samples() {
        const int rays = plan_.settings.samples;
        add("samples", !beams_,
            preview_ ? "exact areas, one colour a region"
            : beams_ ? "exact areas"
                     : fmt::format("{} ray{} a pixel", rays, rays == 1 ? "" : "s"),
            beams_              ? "beams tile the picture"
            : user_.samples > 0 ? "as the scene says"
                                : "as few as their noise allows",
            beams_ ? 0 : plan_.bound_of_sampling);
    }

    ScenePlan& plan_;
    const Scene& scene_;
    const RenderSettings& user_;
    bool beams_, preview_;
};

}  // namespace

void set_resolutions(ScenePlan& plan, const Scene& scene, const RenderSettings& user) {
    plan.items.resize(k_effect_count);
    for (PlanItem& line : plan.items) line.fidelity = line.on ? k_fidelities.at(line.name) : "";
    Lines(plan, scene, user).add_all();
}

}  // namespace culet
