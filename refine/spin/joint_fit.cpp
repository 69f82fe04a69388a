#include "refine/spin/joint_fit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <string>
#include <utility>

#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// Edges are swept level and straight across their side.
constexpr double k_across = radians(1.5);
// As halves of a real series differ: pixels.
constexpr double k_ground_depth = 0.1;
// Guesses nearer to a known facet are left out.
constexpr double k_guess = radians(8.0);
// The scatter of the outlines' points may grow so much with copies: in simulated series
// (bench_spin) by up to 1.2 times where the stone repeats its facets, 5 times where it does not.
constexpr double k_no_worse = 1.5;
constexpr double k_side_error = 0.1;  // pixels

// Both planes hold the edge. Its place is off by `sigma` in every direction across it, by as much
// for one plane as for the other: sum and difference of their heights there are independent.
void add_edge(const PlacedEdge& edge, const std::map<std::string, int>& plane_of,
              const std::vector<Plane>& planes, double sigma, std::vector<PlaneCondition>& to) {
    std::vector<int> bounded;
    for (const std::string& name : edge.facets) {
        const auto found = plane_of.find(name);
        if (found == plane_of.end()) continue;
        bounded.push_back(found->second);
        if (name != k_table_name) to.push_back({{{bounded.back(), edge.along, 0}}, 0, k_across});
    }
    if (bounded.size() == 1) to.push_back({{{bounded[0], edge.place, -1}}, 0, sigma});
    if (bounded.size() != 2) return;
    const double alike =
        glm::dot(planes[std::size_t(bounded[0])].normal, planes[std::size_t(bounded[1])].normal);
    for (const double sign : {1.0, -1.0})
        to.push_back({{{bounded[0], edge.place, -1}, {bounded[1], sign * edge.place, -sign}},
                      0,
                      sigma * std::sqrt(2 + 2 * sign * alike)});
}

void add_ground(double depth, int plane, std::vector<PlaneCondition>& to) {
    to.push_back({{{plane, {1, 0, 0}, 0}}, 0, k_ground_tilt});
    to.push_back({{{plane, {0, 1, 0}, 0}}, 0, k_ground_tilt});
    to.push_back({{{plane, {0, 0, 0}, 1}}, depth, k_ground_depth});
}

// A bright side looks wider than a dark one, in every frame: at one end of a facet and not at the
// other.
void add_side_errors(const Solid& solid, std::vector<double>& sigmas) {
    for (std::size_t f = 0; f < sigmas.size(); ++f) {
        const Facet& facet = solid.facets[f];
        if (facet.name == k_ground_name) continue;
        sigmas[f] = std::min(k_turning_tilt,
                             std::hypot(sigmas[f], k_side_error / narrow_width(solid, facet)));
    }
}

// What is seen, copies of it, and guesses where there is neither.
RepeatedFacets facets_of(const StandingStone& stone, std::optional<RepeatedFacets> repeated) {
    RepeatedFacets all;
    if (repeated) {
        all = std::move(*repeated);
    } else {
        for (std::size_t f = 0; f < stone.seen.size(); ++f) {
            const Facet& facet = stone.solid.facets[f];
            if (stone.seen[f]) all.planes.push_back({facet.name, facet.plane});
        }
    }
    const std::size_t known = all.planes.size();
    for (std::size_t f = 0; f < stone.seen.size(); ++f) {
        if (stone.seen[f]) continue;
        const Facet& facet = stone.solid.facets[f];
        const bool is_known =
            std::any_of(all.planes.begin(), all.planes.begin() + std::ptrdiff_t(known),
                        [&](const NamedPlane& p) {
                            return angle_between(p.plane.normal, facet.plane.normal) < k_guess;
                        });
        if (!is_known) all.planes.push_back({facet.name, facet.plane});
    }
    all.is_copy.resize(all.planes.size(), false);
    return all;
}

void stand(const RepeatedFacets& facets, const std::vector<std::string>& seen, JointStone& joint) {
    StandingStone& stone = joint.stone;
    stone.seen.clear();
    stone.is_copy.clear();
    Vec3 up = stone.at.z;
    for (Facet& facet : joint.fit.solid.facets) {
        const auto plane = std::size_t(std::stoi(facet.name.substr(1))) - 1;
        facet.name = facets.planes[plane].name;
        stone.seen.push_back(std::count(seen.begin(), seen.end(), facet.name) > 0);
        stone.is_copy.push_back(facets.is_copy[plane]);
        if (facet.name == k_table_name) up = facet.plane.normal;
    }
    add_side_errors(joint.fit.solid, joint.fit.tilt_sigmas);
    stone.tilt_sigmas = joint.fit.tilt_sigmas;
    stone.at = attitude_about(joint.fit.solid, up);
    stone.solid = upright(joint.fit.solid, stone.at);
}

// Nothing if the planes enclose no stone.
std::optional<JointStone> fitted(const StandingStone& from, const TurningSeries& start,
                                 const SeriesEvidence& evidence, const RepeatedFacets& facets) {
    TurningOutlines given;
    given.outlines = evidence.outlines;
    given.start = start;
    given.expected = evidence.expected;
    given.sigmas_times = evidence.sigmas_times;
    given.conditions = facets.conditions;
    for (PlaneCondition& condition : given.conditions) {
        for (auto& part : condition.parts) part.by_normal = from.on_turntable(part.by_normal);
    }
    std::map<std::string, int> plane_of;
    for (std::size_t p = 0; p < facets.planes.size(); ++p) {
        const auto& [name, plane] = facets.planes[p];
        given.planes.push_back({from.on_turntable(plane.normal), plane.offset});
        plane_of[name] = int(p);
        if (name == k_ground_name && evidence.ground_depth)
            add_ground(*evidence.ground_depth, int(p), given.conditions);
    }
    for (const PlacedEdge& edge : from.placed_edges)
        add_edge(edge, plane_of, given.planes, from.edge_sigma, given.conditions);
    std::vector<std::string> seen;
    for (std::size_t f = 0; f < from.seen.size(); ++f)
        if (from.seen[f]) seen.push_back(from.solid.facets[f].name);
    JointStone joint{from, {}, {}};
    try {
        joint.fit = refit_turning(given);
    } catch (const InputError&) {
        return std::nullopt;
    }
    stand(facets, seen, joint);
    return joint;
}

}  // namespace

JointStone joint_stone(TurningFit fit, const SeriesEvidence& evidence) {
    add_side_errors(fit.solid, fit.tilt_sigmas);
    if (evidence.ground_depth) lay_on_ground(fit, *evidence.ground_depth);
    const StandingStone stone = standing_stone(fit, evidence.pictures);
    JointStone alone{stone, fit, {}};
    if (auto joint = fitted(stone, fit.series, evidence, facets_of(stone, std::nullopt)))
        alone = std::move(*joint);
    auto repeated = repeated_facets(stone.solid, stone.tilt_sigmas, stone.seen, evidence.symmetry);
    if (!repeated) return alone;
    const FoundSymmetry symmetry{repeated->pairs, repeated->tilt_sigma, repeated->offset_sigma};
    auto joint = fitted(stone, fit.series, evidence, facets_of(stone, std::move(repeated)));
    if (!joint || joint->fit.scatter > k_no_worse * alone.fit.scatter) return alone;
    joint->symmetry = symmetry;
    return std::move(*joint);
}

}  // namespace culet
