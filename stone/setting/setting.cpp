#include "stone/setting/setting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/setting/parts.h"
#include "stone/solid/caliper.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

constexpr double k_wire = 1.0 / 8, k_clearance = 1.0 / 500;  // of the girdle's width
// The gallery's base: its distance inside the girdle's outline / the inner radius, and its sideways
// reach on the hoop / the hoop's radius.
constexpr double k_base_inside = 0.5, k_base_on_hoop = 0.4, k_furthest_inside = 0.8;
constexpr double k_shank_wire = 0.105;  // wire diameter / ring diameter: 1.8 mm on 17 mm
constexpr int k_hoop_steps = 6;         // per side of the wire

// x across, y along the hoop, z up.
Solid upright(const Solid& solid, const PlanFrame& frame, const Vec3& up) {
    const auto turned = [&](const Vec3& v) {
        return Vec3(glm::dot(v, frame.x), glm::dot(v, frame.y), glm::dot(v, up));
    };
    Solid stands = solid;
    for (Vec3& v : stands.vertices) v = turned(v);
    for (Facet& facet : stands.facets) facet.plane.normal = turned(facet.plane.normal);
    return stands;
}

double narrowest(const PlanOutline& hull) {
    double least = INFINITY;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const PlanPoint side = glm::normalize(hull[(i + 1) % hull.size()] - hull[i]);
        double furthest = 0;
        for (const PlanPoint& point : hull)
            furthest = std::max(furthest, cross(side, point - hull[i]));
        least = std::min(least, furthest);
    }
    return least;
}

void decide(SettingOptions& options, double width) {
    const auto take = [](std::optional<double>& value, double usual) {
        if (!value) value = usual;
        return *value;
    };
    const double wire = take(options.prong_diameter, k_wire * width);
    const double clearance = take(options.clearance, k_clearance * width);
    if (!(wire >= 0.01 * width && wire <= 0.3 * width)) {
        throw InputError(fmt::format(
            "a prong of {:.4g} does not go with a stone {:.4g} wide: --prong-diameter is from "
            "{:.3g} to {:.3g}",
            wire, width, 0.01 * width, 0.3 * width));
    }
    if (!(clearance >= 1e-6 * width && clearance <= wire)) {
        throw InputError(fmt::format(
            "a clearance of {:.4g} does not go with a wire of {:.4g}: --clearance is from {:.3g} "
            "to the wire's diameter",
            clearance, wire, 1e-6 * width));
    }
    if (options.shank && !(options.ring_diameter >= 2 * wire)) {
        throw InputError(fmt::format("a ring of {:.4g} has no room for a wire of {:.4g}",
                                     options.ring_diameter, wire));
    }
    check(options.smoothness >= 8 && options.smoothness % 4 == 0, "smoothness");
}

std::vector<Vec3> at_height(const PlanOutline& outline, double height) {
    std::vector<Vec3> path;
    for (const PlanPoint& point : outline) path.emplace_back(point.x, point.y, height);
    return path;
}

// The hoop's axis is the plan's x; its highest point is under the middle of the stone.
Shell make_shank(const SettingPlan& plan, double inner_diameter, double wire) {
    const double radius = 0.5 * (inner_diameter + wire);
    const PlanPoint middle = middle_of(plan.grip.hull());
    std::vector<Vec3> path;
    const int steps = k_hoop_steps * plan.sides;
    for (int i = 0; i < steps; ++i) {
        const double angle = 2 * std::numbers::pi * i / steps;
        path.emplace_back(middle.x, middle.y + radius * std::cos(angle),
                          plan.base_height - radius + radius * std::sin(angle));
    }
    return closed_wire(path, 0.5 * wire, {1, 0, 0}, plan.sides);
}

}  // namespace

Setting make_setting(const Solid& solid, const Vec3& up, const SettingOptions& asked) {
    const PlanFrame frame = plan_frame(up);
    const Solid stone = upright(solid, frame, up);
    const GirdleOutline girdle = girdle_outline(stone);
    const GripOutline grip(girdle.points);
    const StoneSurface surface(stone);
    Setting setting;
    setting.x = frame.x;
    setting.y = frame.y;
    setting.up = up;
    setting.options = asked;
    setting.girdle_height = girdle.height;
    decide(setting.options, narrowest(grip.hull()));
    SettingOptions& options = setting.options;
    SettingPlan plan{stone, surface, girdle, grip};
    plan.wire = *options.prong_diameter;
    plan.clearance = *options.clearance;
    plan.sides = options.smoothness;

    double lowest = INFINITY;
    for (const Vec3& v : stone.vertices) lowest = std::min(lowest, v.z);
    const double shank_wire = k_shank_wire * options.ring_diameter;
    const double below = 0.5 * std::max(plan.wire, options.shank ? shank_wire : 0.0);
    plan.base_height = lowest - below - 2 * plan.clearance;
    const double inner = inner_radius(grip.hull());
    double inside = k_base_inside * inner;
    if (options.shank)
        inside = std::max(inside, inner - k_base_on_hoop * 0.5 * options.ring_diameter);
    if (inside > k_furthest_inside * inner) {
        throw InputError(fmt::format(
            "a stone {:.4g} wide does not sit on a ring of {:.4g}: --ring takes a larger one, and "
            "--no-shank makes the head alone",
            narrowest(grip.hull()), options.ring_diameter));
    }
    plan.base = moved_outline(grip.hull(), -inside);

    const auto add = [&](std::string name, Shell shell) {
        setting.parts.push_back({std::move(name), std::move(shell)});
    };
    if (options.style == SettingStyle::prong) {
        if (options.prongs == 0) options.prongs = grip.usual_prongs();
        const std::vector<Prong> prongs = make_prongs(plan, options.prongs);
        for (const Prong& prong : prongs)
            add(fmt::format("prong{}", setting.parts.size() + 1), prong.shell);
        if (auto rail = make_rail(plan, prongs)) add("gallery2", std::move(*rail));
    } else {
        Bezel bezel = make_bezel(plan);
        add("bezel", std::move(bezel.collar));
        for (Shell& leg : bezel.legs)
            add(fmt::format("leg{}", setting.parts.size()), std::move(leg));
    }
    add("gallery1", closed_wire(at_height(plan.base, plan.base_height), 0.5 * plan.wire, {0, 0, 1},
                                plan.sides));
    if (options.shank) add("shank", make_shank(plan, options.ring_diameter, shank_wire));

    setting.clearance = plan.far();
    setting.low = Vec3(INFINITY, INFINITY, INFINITY);
    setting.high = -setting.low;
    for (SettingPart& part : setting.parts) {
        part.gap = surface.distance_to(part.shell, plan.wire);
        if (!(part.gap >= plan.clearance)) {
            throw InputError(
                fmt::format("{} comes nearer to the stone than {:.4g}: a thinner "
                            "--prong-diameter may do",
                            part.name, plan.clearance));
        }
        setting.clearance = std::min(setting.clearance, part.gap);
        for (Vec3& v : part.shell.vertices) {
            setting.low = glm::min(setting.low, v);
            setting.high = glm::max(setting.high, v);
            v = setting.in_frame_of_stone(v);
        }
    }
    return setting;
}

Solid mesh_of(const Setting& setting) {
    Solid mesh;
    for (const SettingPart& part : setting.parts) {
        const int first = static_cast<int>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), part.shell.vertices.begin(),
                             part.shell.vertices.end());
        for (const auto& t : part.shell.triangles) {
            Facet facet;
            facet.name = part.name;
            for (const int corner : t) facet.corners.push_back(first + corner);
            const std::array<Vec3, 3> corners{part.shell.vertices[t[0]], part.shell.vertices[t[1]],
                                              part.shell.vertices[t[2]]};
            facet.plane = plane_through(corners);
            mesh.facets.push_back(std::move(facet));
        }
    }
    return mesh;
}

}  // namespace culet
