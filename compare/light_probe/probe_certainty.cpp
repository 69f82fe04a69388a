#include "compare/light_probe/probe_certainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/scene/environment_layout.h"
#include "stone/numbers/quantile.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr double k_much = 0.7;  // stops between two views: too much disagreement

void doubt_views(LightProbe& probe) {
    for (std::size_t v = 0; v < probe.alignments.size(); ++v) {
        const ViewAlignment& a = probe.alignments[v];
        if (!a.ambiguous) continue;
        probe.doubt = fmt::format(
            "{}: the views fit together in more than one way (correlation {:.2f}, next best turn "
            "{:.2f}): {}, or check that they show one room",
            probe.views[v + 1].name, a.correlation, a.rival,
            probe.views.size() == 2 ? "say how far the camera went with --turned DEGREES"
                                    : "leave it out");
    }
    if (!probe.doubt.empty() || probe.alignments.empty()) return;
    if (probe.middle_disagreement <= k_much) {
        if (probe.mean_disagreement > k_much) {
            probe.notes.push_back(
                "what is near the ball, and the photographer, is elsewhere in each view: light "
                "from there is a mean (see the disagreement picture)");
        }
        return;
    }
    const auto worst = std::max_element(
        probe.alignments.begin(), probe.alignments.end(),
        [](const ViewAlignment& a, const ViewAlignment& b) { return a.residual < b.residual; });
    const std::string what_to_do =
        probe.views.size() == 2
            ? "look"
            : fmt::format("leave out {}, which differs the most, or look",
                          probe.views[std::size_t(worst - probe.alignments.begin()) + 1].name);
    probe.doubt = fmt::format(
        "the views differ by {:.1f} stops over half of the room: {} at the disagreement picture "
        "(did lights change or the ball move?)",
        probe.middle_disagreement, what_to_do);
}

void measure_light(LightProbe& probe) {
    double omega_sum = 0, covered = 0;
    std::vector<float> stops;
    double sum = 0;
    const MergedLight& light = probe.light;
    for (int y = 0; y < light.map.height; ++y) {
        const double omega = lat_long_solid_angle(y, light.map.width, light.map.height);
        for (int x = 0; x < light.map.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * light.map.width + x;
            omega_sum += omega;
            if (light.coverage[i] > 1e-4f) covered += omega;
            if (std::isfinite(light.disagreement[i])) {
                stops.push_back(light.disagreement[i]);
                sum += light.disagreement[i];
            }
        }
    }
    probe.covered = covered / omega_sum;
    if (!stops.empty()) {
        probe.mean_disagreement = sum / static_cast<double>(stops.size());
        probe.middle_disagreement = quantile(stops, 0.5);
        probe.worst_disagreement = quantile(std::move(stops), 0.99);
    }
}

void note_what_is_missing(LightProbe& probe) {
    const double missing = 100 * (1 - probe.covered);
    if (probe.views.size() == 1 || probe.moved) {
        probe.notes.push_back(
            fmt::format("one view: the {:.0f} degrees behind the ball are filled from around "
                        "them, and camera and photographer are still in the light; a second view "
                        "from the side mends both",
                        2 * degrees(std::asin(1 / probe.views[0].distance))));
    } else if (missing > 0.05) {
        probe.notes.push_back(
            fmt::format("{:.1f} % of all directions are seen by no view well", missing));
    }
    for (const ProbeViewResult& view : probe.views) {
        if (view.over_exposed > 1e-5) {
            probe.notes.push_back(
                fmt::format("{}: {:.2f} % of the ball is over-exposed: lights there are brighter "
                            "than found; add a shorter exposure",
                            view.name, 100 * view.over_exposed));
        }
        if (view.distance_from == "assumed") {
            probe.notes.push_back(fmt::format(
                "{}: the camera is assumed {:g} ball radii away: give --distance if you know it",
                view.name, view.distance));
        }
    }
}

void doubt_circles(LightProbe& probe) {
    for (const ProbeViewResult& view : probe.views) {
        if (!view.rival || !probe.doubt.empty()) continue;
        probe.doubt = fmt::format(
            "{}: the ball may be at {:.0f},{:.0f} with radius {:.0f} or at {:.0f},{:.0f} with "
            "radius {:.0f}: look, and say which with --ball X,Y,RADIUS",
            view.name, view.circle.x, view.circle.y, view.circle.radius, view.rival->x,
            view.rival->y, view.rival->radius);
    }
}

}  // namespace

void assess(LightProbe& probe) {
    measure_light(probe);
    note_what_is_missing(probe);
    doubt_circles(probe);
    doubt_views(probe);
    for (const NearLight& near : probe.near_lights) {
        probe.notes.insert(probe.notes.end(), near.notes.begin(), near.notes.end());
        if (!near.usable() && probe.doubt.empty()) probe.doubt = near.doubt;
    }
}

}  // namespace culet
