#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "stone/setting/parts.h"
#include "stone/setting/section_path.h"

namespace culet {

namespace {

// In wire diameters: wall thickness, reach of lip and seat inside the outline, thickness of the
// lip's edge, height below the seat.
constexpr double k_wall = 0.5, k_lip = 0.3, k_lip_edge = 0.12, k_below_seat = 0.6;
constexpr double k_longest_lip = 0.2;  // share of the stone's inner radius
constexpr double k_leg = 0.4;          // radius, in wire diameters
constexpr int k_usual_legs = 4;

// The whole stone beside its outline: x outward from it, y up. Along an edge of the stone x is at
// most its linear interpolation, so the corners suffice.
std::vector<PlanPoint> hull_of_stone(const SettingPlan& plan) {
    std::vector<PlanPoint> points;
    for (const Vec3& vertex : plan.solid.vertices)
        points.emplace_back(distance_outside(plan.girdle.points, PlanPoint(vertex)), vertex.z);
    return outer_hull_of(points);
}

// The collar's section, counter-clockwise; `inner` is the line beside the stone.
std::vector<PlanPoint> section_of(const std::vector<PlanPoint>& inner, const SettingPlan& plan) {
    const double outside =
        std::max_element(inner.begin(), inner.end(), [](auto& a, auto& b) { return a.x < b.x; })->x;
    const double wall = outside + k_wall * plan.wire;
    const PlanPoint seat = inner.front(), lip = inner.back();
    const double top = lip.y + k_lip_edge * plan.wire;
    // The wall begins to bend over the crown where the line leaves the girdle.
    double shoulder = seat.y;
    for (const PlanPoint& point : inner) {
        if (point.x > outside - 1e-9 * plan.wire) shoulder = std::max(shoulder, point.y);
    }
    shoulder = std::min(shoulder, top - k_lip_edge * plan.wire);
    const double bottom = seat.y - k_below_seat * plan.wire;
    std::vector<PlanPoint> section{{seat.x, bottom}, {wall, bottom}};
    const int steps = plan.sides / 4;
    for (int k = 0; k <= steps; ++k) {
        const double angle = 0.5 * std::numbers::pi * k / steps;
        section.emplace_back(k == steps ? lip.x : lip.x + (wall - lip.x) * std::cos(angle),
                             shoulder + (top - shoulder) * std::sin(angle));
    }
    section.insert(section.end(), inner.rbegin(), inner.rend());
    return section;
}

}  // namespace

Bezel make_bezel(const SettingPlan& plan) {
    Bezel bezel;
    const double lip = std::min(k_lip * plan.wire, k_longest_lip * inner_radius(plan.grip.hull()));
    const auto hull = hull_of_stone(plan);
    std::vector<PlanPoint> section;
    bezel.collar = at_clearance(
        plan,
        [&](double distance) {
            section = section_of(line_beside(hull, distance, -lip), plan);
            return swept_collar(plan.girdle.points, section);
        },
        "the bezel");
    const PlanPoint inner_foot = section[0], outer_foot = section[1];
    const double radius = std::min(k_leg * plan.wire, 0.45 * (outer_foot.x - inner_foot.x));
    const int count = plan.grip.corners() > 0 ? plan.grip.usual_prongs() : k_usual_legs;
    for (const GirdlePlace& usual : plan.grip.places(count, plan.wire)) {
        const auto [place, foot] = on_base(plan, usual);
        const auto beside = outer_hull(plan.solid, place, radius + plan.clearance);
        const PlanPoint from{-foot, plan.base_height},
            to{0.5 * (inner_foot.x + outer_foot.x), inner_foot.y};
        std::vector<Vec3> path;
        for (const PlanPoint& point : taut_path_between(
                 curve_beside(beside, radius + plan.clearance, 2 * plan.sides), from, to))
            path.push_back(in_space(place, point));
        const Vec3 aside(-place.outward.y, place.outward.x, 0);
        bezel.legs.push_back(round_wire(path, radius, aside, plan.sides));
    }
    return bezel;
}

}  // namespace culet
