#include "refine/spin/standing_stone.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>

#include "refine/spin/surface_edges.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr int k_attitudes = 3;
constexpr double k_level_table = radians(0.2);
constexpr double k_edge_on = 0.05;   // sine of an angle
constexpr std::size_t k_swept = 64;  // frames in which edges are looked for, at most
constexpr double k_same_as_ground = radians(12.0);

// Seen from both sides of its plane by more than `k_edge_on`.
bool turns_edge_on(const Vec3& normal, const TurningSeries& series) {
    double least = 1, most = -1;
    for (const double turn : series.turns) {
        const PictureAxes at = picture_axes(series.camera, turn);
        const double to_camera = glm::dot(normal, glm::normalize(glm::cross(at.across, at.along)));
        least = std::min(least, to_camera);
        most = std::max(most, to_camera);
    }
    return least < -k_edge_on && most > k_edge_on;
}

void place_edges(const CrownedStone& crowned, StandingStone& stone) {
    for (const auto& [facet, edges] : crowned.edges_of) {
        for (const SurfaceEdge& e : edges) {
            const double x = std::cos(e.azimuth), y = std::sin(e.azimuth);
            const Vec3 place = stone.on_turntable({e.radius * x, e.radius * y, e.height});
            std::vector<PlacedEdge>& all = stone.placed_edges;
            auto known = std::find_if(all.begin(), all.end(),
                                      [&](const PlacedEdge& p) { return p.place == place; });
            if (known == all.end())
                known = all.insert(known, {place, stone.on_turntable({-y, x, 0}), {}});
            known->facets.push_back(facet);
        }
    }
}

// x along the least width, though the girdle may have become narrower.
void turn_to_width(StandingStone& stone) {
    const StoneAttitude turned = attitude_about(stone.solid, {0, 0, 1});
    stone.solid = upright(std::move(stone.solid), turned);
    stone.at = {stone.on_turntable(turned.x), stone.on_turntable(turned.y), stone.at.z};
}

}  // namespace

std::vector<bool> seen_facets(const TurningFit& fit) {
    std::vector<bool> seen;
    for (std::size_t f = 0; f < fit.tilt_sigmas.size(); ++f)
        seen.push_back(fit.solid.facets[f].name == k_ground_name ||
                       (fit.tilt_sigmas[f] <= k_turning_tilt / 2 &&
                        turns_edge_on(fit.solid.facets[f].plane.normal, fit.series)));
    return seen;
}

void lay_on_ground(TurningFit& fit, double depth) {
    const Vec3 down{0, 0, -1};
    const std::vector<bool> seen = seen_facets(fit);
    std::vector<NamedPlane> planes;
    std::map<std::string, double> sigmas{{k_ground_name, k_ground_tilt}};
    for (std::size_t f = 0; f < seen.size(); ++f) {
        const Facet& facet = fit.solid.facets[f];
        if (!seen[f] && angle_between(facet.plane.normal, down) < k_same_as_ground) continue;
        planes.push_back({facet.name, facet.plane});
        sigmas[facet.name] = fit.tilt_sigmas[f];
    }
    planes.push_back({k_ground_name, {down, depth}});
    HalfSpaceSolid lying = intersect_half_spaces(planes);
    if (lying.solid.facets.empty()) return;
    fit.solid = std::move(lying.solid);
    fit.tilt_sigmas.clear();
    for (const Facet& facet : fit.solid.facets) fit.tilt_sigmas.push_back(sigmas[facet.name]);
}

StandingStone standing_stone(const TurningFit& fit,
                             const std::vector<const LevelPicture*>& pictures) {
    StandingStone stone;
    const std::vector<bool> seen = seen_facets(fit);
    stone.at = attitude_of(fit.solid, seen, {0, 0, 1});
    const std::size_t every = (pictures.size() + k_swept - 1) / k_swept;
    std::vector<SweptFrame> swept;
    for (std::size_t k = 0; k < pictures.size(); k += every)
        swept.push_back(swept_frame(*pictures[k]));
    std::optional<CrownedStone> with_crown;
    // Edges are looked for across the way up: the table tells it better than the outlines.
    for (int i = 0; i < k_attitudes; ++i) {
        stone.solid = upright(fit.solid, stone.at);
        for (std::size_t s = 0; s < swept.size(); ++s)
            swept[s].projection =
                projection_of(picture_axes(fit.series.camera, fit.series.turns[s * every]),
                              stone.at, *pictures[s * every]);
        with_crown = crowned(stone.solid, seen, fit.tilt_sigmas, swept);
        if (!with_crown || with_crown->table_tilt < k_level_table) break;
        if (i + 1 < k_attitudes)
            stone.at = attitude_about(fit.solid,
                                      stone.on_turntable(with_crown->solid.facets[0].plane.normal));
    }
    stone.tilt_sigmas = fit.tilt_sigmas;
    stone.seen = seen;
    if (with_crown) {
        place_edges(*with_crown, stone);
        stone.edges = with_crown->edges;
        stone.edge_sigma = with_crown->edge_sigma;
        stone.solid = std::move(with_crown->solid);
        stone.tilt_sigmas = std::move(with_crown->tilt_sigmas);
        stone.seen.assign(stone.solid.facets.size(), true);
        for (const int f : with_crown->unseen) stone.seen[std::size_t(f)] = false;
    }
    turn_to_width(stone);
    stone.is_copy.assign(stone.seen.size(), false);
    return stone;
}

}  // namespace culet
