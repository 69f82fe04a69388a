#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/setting/parts.h"
#include "stone/setting/section_path.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_gap_tolerance = 1e-3;   // of the wire
constexpr double k_least_distance = -0.4;  // of the wire; relative to the hull
constexpr int k_most_tries = 40;
// How far a claw reaches over the girdle: of the wire, and at most of the stone's inner radius.
constexpr double k_claw = 0.8, k_longest_claw = 0.4;
// Where a rail is tried: share of the height from the base to where the prongs stop being straight.
constexpr double k_highest_rail = 0.7, k_lowest_rail = 0.3, k_rail_step = 0.05;
constexpr double k_rail_wire = 0.75;

std::vector<Vec3> in_space(const GirdlePlace& place, const std::vector<PlanPoint>& path) {
    std::vector<Vec3> points;
    for (const PlanPoint& point : path) points.push_back(in_space(place, point));
    return points;
}

}  // namespace

Shell at_clearance(const SettingPlan& plan, const std::function<Shell(double)>& make,
                   const std::string& what) {
    const double room = k_gap_tolerance * plan.wire;
    double distance = plan.clearance, near_gap = plan.far();
    double too_near = k_least_distance * plan.wire;  // largest distance found to be too near
    std::optional<double> kept_at;
    Shell kept;
    for (int i = 0; i < k_most_tries; ++i) {
        Shell shell = make(distance);
        const double gap = plan.surface.distance_to(shell, plan.far());
        if (gap >= plan.clearance) {
            if (!kept_at || gap < near_gap) {
                near_gap = gap;
                kept_at = distance;
                kept = std::move(shell);
            }
            if (gap <= plan.clearance + room) break;
        } else {
            too_near = std::max(too_near, distance);
        }
        // Where metal moves straight away from the stone, the gap grows like the distance.
        double next = distance + plan.clearance + 0.5 * room - gap;
        if (kept_at && (next <= too_near || next >= *kept_at)) next = 0.5 * (too_near + *kept_at);
        if (!kept_at && next <= too_near) next = too_near + 0.1 * plan.wire;
        if (next > 2 * plan.wire + plan.clearance) break;
        // Negative where the stone recedes on both sides, so that the hull is wider than the stone.
        distance = std::max(next, k_least_distance * plan.wire);
        if (kept_at == distance) break;
    }
    if (!kept_at || near_gap > plan.clearance + room) {
        throw InputError(
            fmt::format("{} cannot be laid against the stone at a clearance of {:.4g}: another "
                        "--prong-diameter, --clearance or number of prongs may do",
                        what, plan.clearance));
    }
    return kept;
}

FootedPlace on_base(const SettingPlan& plan, GirdlePlace place) {
    double way = distance_along(plan.base, place.at, -place.outward);
    if (way < 0) {
        place.outward = glm::normalize(place.at - middle_of(plan.base));
        way = distance_along(plan.base, place.at, -place.outward);
    }
    check(way >= 0, "a wire's foot stands on the base");
    return {place, way};
}

std::vector<Prong> make_prongs(const SettingPlan& plan, int count) {
    std::vector<Prong> prongs;
    const double radius = 0.5 * plan.wire;
    for (const GirdlePlace& usual : plan.grip.places(count, plan.wire)) {
        const auto [place, foot] = on_base(plan, usual);
        Prong prong;
        prong.place = place;
        const auto hull = outer_hull(plan.solid, place, radius + plan.clearance);
        prong.foot = {-foot, plan.base_height};
        const double claw =
            std::min(k_claw * plan.wire, k_longest_claw * inner_radius(plan.grip.hull()));
        const Vec3 aside(-place.outward.y, place.outward.x, 0);
        prong.shell = at_clearance(
            plan,
            [&, at = place](double distance) {
                const auto curve = curve_beside(hull, radius + distance, 2 * plan.sides);
                const auto path = taut_path(curve, prong.foot, -std::max(claw - radius, 0.0));
                prong.shoulder = path[1];
                return round_wire(in_space(at, path), radius, aside, plan.sides);
            },
            fmt::format("prong {}", prongs.size() + 1));
        prongs.push_back(std::move(prong));
    }
    return prongs;
}

std::optional<Shell> make_rail(const SettingPlan& plan, const std::vector<Prong>& prongs) {
    const Prong& prong = prongs.front();
    for (double part = k_highest_rail; part > k_lowest_rail - 1e-9; part -= k_rail_step) {
        const PlanPoint at = prong.foot + part * (prong.shoulder - prong.foot);
        if (at.x >= 0) continue;
        // Find the outline, moved inward, that passes through the first prong.
        double less = 0, more = -prong.foot.x;
        for (int i = 0; i < 50; ++i) {
            const double middle = 0.5 * (less + more);
            const double way = distance_along(moved_outline(plan.grip.hull(), -middle),
                                              prong.place.at, -prong.place.outward);
            (way < -at.x ? less : more) = middle;
        }
        std::vector<Vec3> path;
        for (const PlanPoint& point : moved_outline(plan.grip.hull(), -less))
            path.emplace_back(point.x, point.y, at.y);
        Shell rail = closed_wire(path, 0.5 * k_rail_wire * plan.wire, {0, 0, 1}, plan.sides);
        if (plan.surface.distance_to(rail, plan.far()) > plan.clearance) return rail;
    }
    return std::nullopt;
}

}  // namespace culet
