#include "stone/cut_planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>

#include "stone/errors.h"
#include "stone/face_soup.h"
#include "stone/units.h"

namespace culet {

namespace {

/// Planes this close are one plane given twice: files give angles to 1e-6 degrees (2e-8 rad) and
/// distances to 1e-8, so two that agree to this were meant to be the same.
constexpr double k_same_plane = 1e-9;

/// More planes than any stone has facets; the exact intersection takes seconds at this many.
constexpr std::size_t k_most_planes = 5000;

struct SinCos {
    double sin = 0, cos = 1;
};

/// Of part / whole of a full turn. Reduced to an eighth of a turn about the nearest quarter,
/// without rounding, so that settings that mirror each other give values that mirror each other
/// exactly.
SinCos of_turn(double part, double whole) {
    part = std::fmod(part, whole);
    const double rest = std::remainder(4 * part, whole);
    const int quarter = static_cast<int>(std::lround((4 * part - rest) / whole));
    const double s = std::sin(rest / whole * (std::numbers::pi / 2));
    const double c = std::cos(rest / whole * (std::numbers::pi / 2));
    switch (((quarter % 4) + 4) % 4) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

}  // namespace

Plane plane_of(const CutSetting& setting, const CutSheet& sheet) {
    const SinCos around = of_turn(setting.index - sheet.gear_offset, sheet.gear);
    const SinCos tilt = of_turn(setting.angle_deg, 360);
    const double up = setting.pavilion ? -tilt.cos : tilt.cos;
    return {{tilt.sin * around.sin, tilt.sin * around.cos, up}, setting.distance};
}

CutSetting setting_of(const Plane& plane, const CutSheet& sheet) {
    const Vec3& n = plane.normal;
    const double level = std::hypot(n.x, n.y);
    CutSetting setting;
    setting.angle_deg = degrees(std::atan2(level, std::abs(n.z)));
    setting.pavilion = n.z < 0;
    setting.distance = plane.offset;
    const double teeth = std::abs(sheet.gear);
    double index = sheet.gear_offset;
    // A table has every index; the offset's is as good as any.
    if (level > 0) index += std::atan2(n.x, n.y) / (2 * std::numbers::pi) * sheet.gear;
    index = std::fmod(index, teeth);
    if (index <= 0) index += teeth;
    setting.index = index;
    return setting;
}

std::vector<std::string> tier_names(const std::vector<CutPlane>& planes) {
    std::map<int, std::set<std::string>> names;
    for (const CutPlane& p : planes) {
        if (!p.name.empty()) names[p.tier].insert(p.name);
    }
    std::vector<std::string> of_plane;
    for (const CutPlane& p : planes) {
        const auto found = names.find(p.tier);
        const bool one = p.tier >= 0 && found != names.end() && found->second.size() == 1;
        of_plane.push_back(one ? *found->second.begin() : std::string());
    }
    return of_plane;
}

void build_solid(ReadCut& cut, const std::vector<CutPlane>& planes, const CutReading& how,
                 const std::filesystem::path& file) {
    if (planes.empty()) throw InputError(file, "holds no facets");
    if (planes.size() > k_most_planes) {
        throw InputError(file, fmt::format("holds {} facets; designs of more than {} are not read",
                                           planes.size(), k_most_planes));
    }
    double scale = 0;
    for (const CutPlane& p : planes) scale = std::max(scale, std::abs(p.plane.offset));

    std::vector<NamedPlane> distinct;
    std::vector<const CutPlane*> origin;
    for (const CutPlane& p : planes) {
        const bool repeated = std::any_of(distinct.begin(), distinct.end(), [&](const auto& d) {
            return std::abs(d.plane.offset - p.plane.offset) <= k_same_plane * scale &&
                   glm::length(d.plane.normal - p.plane.normal) <= k_same_plane;
        });
        if (repeated) {
            cut.repeated_planes.push_back(p.place);
            continue;
        }
        distinct.push_back({std::to_string(distinct.size()), p.plane});
        origin.push_back(&p);
    }
    HalfSpaceSolid whole = intersect_half_spaces(distinct);
    if (!whole.bounded) {
        throw InputError(file,
                         fmt::format("the {} planes do not close the stone: facets are missing",
                                     distinct.size()));
    }
    if (whole.empty) {
        throw InputError(file, "no point lies below all planes: an angle or a distance is wrong");
    }
    for (const int unused : whole.unused_planes) {
        cut.unused_planes.push_back(origin[unused]->place);
    }
    const double width =
        std::min(width_along(whole.solid, {1, 0, 0}), width_along(whole.solid, {0, 1, 0}));
    ContractedSolid contracted = how.meet_tolerance > 0
                                     ? contract_near_meets(whole.solid, how.meet_tolerance * width)
                                     : ContractedSolid{std::move(whole.solid), 0, {}};
    if (contracted.solid.facets.size() < 4) {
        throw InputError(file, fmt::format("nothing is left of the stone when meets within {:g} of "
                                           "its width are joined: give a smaller tolerance",
                                           how.meet_tolerance));
    }
    cut.solid = std::move(contracted.solid);
    cut.contracted_edges = contracted.contracted_edges;
    for (const std::string& vanished : contracted.vanished) {
        cut.unused_planes.push_back(origin[std::stoul(vanished)]->place);
    }

    // The facets still carry the numbers of their planes.
    const std::vector<std::string> tiers = tier_names(planes);
    std::vector<std::string> names, of_tier;
    for (const Facet& facet : cut.solid.facets) {
        const CutPlane* const plane = origin[std::stoul(facet.name)];
        names.push_back(plane->name);
        of_tier.push_back(tiers[static_cast<std::size_t>(plane - planes.data())]);
    }
    names = told_apart(std::move(names), of_tier);
    for (std::size_t i = 0; i < names.size(); ++i) cut.solid.facets[i].name = std::move(names[i]);

    if (cut.contracted_edges > 0) {
        cut.details.push_back(fmt::format(
            "joined meets that miss: {} edges shorter than {:g} of the width; corners lie up to "
            "{:.2g} of the width off their planes",
            cut.contracted_edges, how.meet_tolerance, planarity(cut.solid) / width));
    }
    for (const std::string& place : cut.repeated_planes) {
        cut.notes.push_back(fmt::format("repeated plane left out: {}", place));
    }
    for (const std::string& place : cut.unused_planes) {
        cut.notes.push_back(fmt::format("plane that bounds nothing left out: {}", place));
    }
}

}  // namespace culet
