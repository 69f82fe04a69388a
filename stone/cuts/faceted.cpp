#include "stone/cuts/faceted.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "stone/numbers/units.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

struct Side {
    const char* name;
    Vec3 out;         // horizontal unit normal
    double distance;  // of the girdle facet from the axis
};

std::vector<Side> sides_of(const StepProportions& p) {
    const double a = p.length / 2, b = p.width / 2, r = std::sqrt(0.5);
    std::vector<Side> sides{
        {"E", {1, 0, 0}, a}, {"N", {0, 1, 0}, b}, {"W", {-1, 0, 0}, a}, {"S", {0, -1, 0}, b}};
    if (p.corner > 0) {
        const double distance = r * (a + b - p.corner);
        sides = {{"E", {1, 0, 0}, a},  {"NE", {r, r, 0}, distance},
                 {"N", {0, 1, 0}, b},  {"NW", {-r, r, 0}, distance},
                 {"W", {-1, 0, 0}, a}, {"SW", {-r, -r, 0}, distance},
                 {"S", {0, -1, 0}, b}, {"SE", {r, -r, 0}, distance}};
    }
    return sides;
}

// Each of the eight sides shortens by 2 tan(22.5 deg) times the inset, so the last tier that starts
// with eight sides limits the size of a corner.
void require_eight_sides(const StepProportions& p) {
    double inset = 0;
    for (const std::vector<StepTier>* tiers : {&p.crown, &p.pavilion}) {
        double start = 0;
        for (std::size_t t = 0; t + 1 < tiers->size(); ++t) {
            start += (*tiers)[t].height / std::tan((*tiers)[t].angle);
        }
        inset = std::max(inset, start);
    }
    const double shorter = 2 * std::tan(radians(22.5)) * inset;
    const double least = shorter / std::sqrt(2.0);
    const double most = (std::min(p.length, p.width) - shorter) / 2;
    if (!(p.corner > least && p.corner < most)) {
        throw InputError(fmt::format(
            "corners that take {:.4g} % of the width do not last through all steps: expected more "
            "than {:.4g} % and less than {:.4g} %",
            100 * p.corner / p.width, 100 * least / p.width, 100 * most / p.width));
    }
}

// Every plane must have a facet.
Solid solid_of(const std::vector<NamedPlane>& planes, const char* what) {
    const HalfSpaceSolid raw = intersect_half_spaces(planes);
    const ContractedSolid clean = contract_near_meets(raw.solid, 1e-9 * diameter(raw.solid));
    if (clean.solid.facets.size() != planes.size()) {
        std::string lost;
        for (const NamedPlane& plane : planes) {
            if (find_facet(clean.solid, plane.name) < 0) lost += " " + plane.name;
        }
        throw InputError(
            fmt::format("these proportions leave no room for the {}'s facets{}", what, lost));
    }
    return clean.solid;
}

}  // namespace

Solid step_cut(const StepProportions& p) {
    if (p.corner > 0) require_eight_sides(p);
    std::vector<NamedPlane> planes;
    double inset = 0, height = p.girdle / 2;
    const std::vector<Side> sides = sides_of(p);
    for (std::size_t t = 0; t < p.crown.size(); ++t) {
        const StepTier& tier = p.crown[t];
        for (const Side& side : sides) {
            const Vec3 n = std::sin(tier.angle) * side.out + std::cos(tier.angle) * Vec3{0, 0, 1};
            planes.push_back({fmt::format("C{}{}", t + 1, side.name),
                              {n, std::sin(tier.angle) * (side.distance - inset) +
                                      std::cos(tier.angle) * height}});
        }
        inset += tier.height / std::tan(tier.angle);
        height += tier.height;
    }
    planes.insert(planes.begin(), {"T", {{0, 0, 1}, height}});
    for (const Side& side : sides)
        planes.push_back({fmt::format("G{}", side.name), {side.out, side.distance}});
    inset = 0;
    height = p.girdle / 2;
    for (std::size_t t = 0; t < p.pavilion.size(); ++t) {
        const StepTier& tier = p.pavilion[t];
        for (const Side& side : sides) {
            const Vec3 n = std::sin(tier.angle) * side.out - std::cos(tier.angle) * Vec3{0, 0, 1};
            planes.push_back({fmt::format("P{}{}", t + 1, side.name),
                              {n, std::sin(tier.angle) * (side.distance - inset) +
                                      std::cos(tier.angle) * height}});
        }
        inset += tier.height / std::tan(tier.angle);
        height += tier.height;
    }
    return solid_of(planes, "step cut");
}

Solid princess_cut(const PrincessProportions& p) {
    const double z_up = p.girdle / 2, z_low = -z_up, z_table = z_up + p.crown_height;
    const Vec3 culet{0, 0, z_low - p.pavilion_depth};
    std::vector<NamedPlane> planes{{"T", {{0, 0, 1}, z_table}}};
    const std::array<Side, 4> sides{{{"E", {1, 0, 0}, p.length / 2},
                                     {"N", {0, 1, 0}, p.width / 2},
                                     {"W", {-1, 0, 0}, p.length / 2},
                                     {"S", {0, -1, 0}, p.width / 2}}};
    const auto plane = [](const Vec3& a, const Vec3& b, const Vec3& c) {
        return plane_through(std::array<Vec3, 3>{a, b, c});
    };
    // The upper, flatter crown tier takes 60 % of the way from table to girdle and 45 % of the
    // height.
    const double middle_scale = p.table + (1 - p.table) * 0.6,
                 middle_height = z_up + 0.55 * p.crown_height;
    for (const char* tier : {"C1", "C2", "G", "P"}) {
        for (std::size_t s = 0; s < 4; ++s) {
            const Side &side = sides[s], &next = sides[(s + 1) % 4], &last = sides[(s + 3) % 4];
            const std::string name = std::string(tier) + side.name;
            const auto corner = [&](const Side& other, double scale, double z) {
                return scale * (side.distance * side.out + other.distance * other.out) +
                       Vec3{0, 0, z};
            };
            const Vec3 to_next = corner(next, 1, z_low), to_last = corner(last, 1, z_low);
            if (tier[0] == 'G') {
                planes.push_back({name, {side.out, side.distance}});
            } else if (tier[1] == '1') {
                planes.push_back({name, plane(corner(last, 1, z_up), corner(next, 1, z_up),
                                              corner(next, middle_scale, middle_height))});
            } else if (tier[1] == '2') {
                planes.push_back({name, plane(corner(last, middle_scale, middle_height),
                                              corner(next, middle_scale, middle_height),
                                              corner(next, p.table, z_table))});
            } else {
                // The profile in the side's middle bulges out from the straight line to the culet;
                // a chevron is the triangle of two of its points and the girdle's corner.
                std::vector<Vec3> profile;
                for (int j = 1; j <= p.chevrons; ++j) {
                    const double t = static_cast<double>(j) / p.chevrons;
                    const double radius = side.distance * (1 - t),
                                 bulge = 0.22 * t * (1 - t) * p.pavilion_depth;
                    profile.push_back(radius * side.out +
                                      Vec3{0, 0, z_low - t * p.pavilion_depth - bulge});
                }
                profile.back() = culet;
                planes.push_back(
                    {fmt::format("P1{}", side.name), plane(to_next, to_last, profile[0])});
                for (std::size_t j = 0; j + 1 < profile.size(); ++j) {
                    planes.push_back({fmt::format("P{}{}a", j + 2, side.name),
                                      plane(profile[j], profile[j + 1], to_next)});
                    planes.push_back({fmt::format("P{}{}b", j + 2, side.name),
                                      plane(profile[j + 1], profile[j], to_last)});
                }
            }
        }
    }
    // Planes through three points may face inwards: turn them.
    for (NamedPlane& named : planes) {
        if (named.plane.offset < 0) named.plane = {-named.plane.normal, -named.plane.offset};
    }
    return solid_of(planes, "princess");
}

}  // namespace culet
