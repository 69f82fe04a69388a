#include "fit/hypotheses/topology_stage.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "fit/readings/binder.h"
#include "stone/solid/checks.h"
#include "stone/solid/half_edges.h"

namespace culet {

namespace {

// The same reading on the changed solid; nothing if its facets are gone.
std::optional<Reading> carried_over(const Reading& reading, const Solid& before,
                                    const Solid& after) {
    Reading r = reading;
    const auto facet = [&](int f) {
        return f < 0 ? f : find_facet(after, before.facets[std::size_t(f)].name);
    };
    std::vector<int> kept;
    const bool in_pairs = r.kind == ReadingKind::dihedral || r.kind == ReadingKind::edge ||
                          (r.kind == ReadingKind::mirror && !r.has_direction);
    const std::size_t stride = in_pairs ? 2 : 1;
    for (std::size_t i = 0; i + stride <= r.facets.size(); i += stride) {
        std::vector<int> term;
        for (std::size_t k = 0; k < stride; ++k) term.push_back(facet(r.facets[i + k]));
        if (std::any_of(term.begin(), term.end(), [](int f) { return f < 0; })) continue;
        if (r.kind == ReadingKind::edge && !share_edge(after, term[0], term[1])) continue;
        kept.insert(kept.end(), term.begin(), term.end());
    }
    const bool all = kept.size() == r.facets.size();
    // Readings that many facets share keep the facets that are left; others need all of theirs.
    const bool shared = r.kind == ReadingKind::meet || r.kind == ReadingKind::parallel ||
                        r.kind == ReadingKind::coplanar;
    const std::size_t least = r.kind == ReadingKind::meet ? 3 : 2;
    if (!all && !(shared && kept.size() >= least)) return std::nullopt;
    r.facets = kept;
    if (r.datum.facet >= 0 && (r.datum.facet = facet(r.datum.facet)) < 0) return std::nullopt;
    for (Place& place : r.places) {
        // Corners have no names that survive a change.
        if (place.vertex >= 0) return std::nullopt;
        if (place.facet >= 0 && (place.facet = facet(place.facet)) < 0) return std::nullopt;
        if (place.other_facet >= 0) {
            place.other_facet = facet(place.other_facet);
            if (place.other_facet < 0 || !share_edge(after, place.facet, place.other_facet)) {
                return std::nullopt;
            }
        }
    }
    return r;
}

}  // namespace

bool change_solid(TopologyStage& stage, Solid solid, std::vector<std::string>& changes) {
    if (solid.facets.empty()) return false;
    TopologyStage next;
    next.stone = stage.stone;
    next.stone.solid = std::move(solid);
    if (!stage.stone.up_facet.empty() && find_facet(next.stone.solid, stage.stone.up_facet) < 0) {
        return false;
    }
    std::vector<std::string> dropped;
    for (std::size_t i = 0; i < stage.readings.size(); ++i) {
        auto reading = carried_over(stage.readings[i], stage.stone.solid, next.stone.solid);
        // A released meet may no longer exist.
        if (reading && reading->released) {
            bool meets = false;
            const HalfEdges edges = half_edges(next.stone.solid);
            for (const std::vector<int>& there : edges.facets_of_vertex) {
                meets = meets ||
                        std::all_of(reading->facets.begin(), reading->facets.end(), [&](int f) {
                            return std::find(there.begin(), there.end(), f) != there.end();
                        });
            }
            if (!meets) reading.reset();
        }
        if (!reading) {
            if (stage.origin[i] >= 0) dropped.push_back(stage.readings[i].id);
            continue;
        }
        next.readings.push_back(std::move(*reading));
        next.origin.push_back(stage.origin[i]);
    }
    std::vector<std::string> gone;
    for (const Facet& facet : stage.stone.solid.facets) {
        if (find_facet(next.stone.solid, facet.name) < 0) gone.push_back(facet.name);
    }
    if (!gone.empty()) {
        changes.push_back(fmt::format("facets removed, the readings leave them no room: {}",
                                      fmt::join(gone, ", ")));
    }
    if (!dropped.empty()) {
        changes.push_back(
            fmt::format("readings that no longer apply: {}", fmt::join(dropped, ", ")));
    }
    stage = std::move(next);
    return true;
}

Reading released_meet(const TopologyStage& stage, const std::vector<std::string>& names,
                      int number) {
    Reading r;
    r.id = fmt::format("released-meet-{}", number);
    r.kind = ReadingKind::meet;
    r.released = true;
    for (const std::string& name : names) {
        r.facets.push_back(find_facet(stage.stone.solid, name));
        r.of.push_back(name);
    }
    return r;
}

std::vector<std::string> corner_of(const Solid& solid, const std::vector<std::string>& names) {
    const HalfEdges edges = half_edges(solid);
    for (const std::vector<int>& there : edges.facets_of_vertex) {
        std::vector<std::string> here;
        for (int f : there) here.push_back(solid.facets[std::size_t(f)].name);
        if (std::all_of(names.begin(), names.end(), [&](const std::string& n) {
                return std::find(here.begin(), here.end(), n) != here.end();
            })) {
            return here;
        }
    }
    return {};
}

}  // namespace culet
