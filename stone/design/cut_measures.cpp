#include "stone/design/cut_measures.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "stone/design/cut_choice.h"
#include "stone/numbers/units.h"
#include "stone/solid/angles.h"
#include "stone/solid/caliper.h"

namespace culet {

namespace {

const Vec3 k_upwards{0, 0, 1};

int farthest(const CutCorners& corners, const CutPlaces& at, const Vec3& direction) {
    return *std::max_element(corners.begin(), corners.end(), [&](int a, int b) {
        return glm::dot(direction, at[std::size_t(a)]) < glm::dot(direction, at[std::size_t(b)]);
    });
}

// Without those next to another: meets that miss give a table short edges.
CutCorners large_corners(const CutCorners& loop, const CutPlaces& at) {
    constexpr double k_short = 0.2;
    const auto apart = [&](int a, int b) {
        return glm::length(at[std::size_t(a)] - at[std::size_t(b)]);
    };
    double around = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        around += apart(loop[i], loop[(i + 1) % loop.size()]);
    CutCorners large;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        // A regular octagon's edge is an eighth.
        if (apart(loop[i], loop[(i + 1) % loop.size()]) > k_short * around / 8)
            large.push_back(loop[i]);
    }
    return large;
}

// The largest and the least, which are two also where all are equal.
template <class One, class Value>
std::vector<One> extremes(const std::vector<One>& all, const Value& value) {
    if (all.size() < 2) return {};
    std::size_t most = 0, least = 0;
    for (std::size_t i = 1; i < all.size(); ++i) {
        if (value(all[i]) > value(all[most])) most = i;
        if (value(all[i]) < value(all[least])) least = i;
    }
    if (most == least) least = all.size() / 2;
    return {all[most], all[least]};
}

}  // namespace

Vec3 middle_of(const CutCorners& loop, const CutPlaces& at) {
    const Vec3& from = at[std::size_t(loop[0])];
    Vec3 sum(0);
    double area = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3 a = at[std::size_t(loop[i])] - from,
                   b = at[std::size_t(loop[(i + 1) % loop.size()])] - from;
        const double part = a.x * b.y - a.y * b.x;
        area += part;
        sum += part / 3 * (a + b);
    }
    return in_plan(area != 0 ? from + sum / area : from);
}

void CutMeasures::Cut::find_outline(const Solid& solid) {
    std::set<int> known;
    for (const Facet& facet : solid.facets)
        known.insert(facet.corners.begin(), facet.corners.end());
    const CutCorners used(known.begin(), known.end());
    Solid plan;
    for (const int c : used) plan.vertices.push_back(solid.vertices[std::size_t(c)]);
    const CaliperWidths widths = caliper_widths(plan);
    if (widths.outline.size() < 3) return;
    const auto in_hull = [&](std::size_t i) {
        return used[std::size_t(widths.outline[i % widths.outline.size()])];
    };
    for (std::size_t i = 0; i < widths.outline.size(); ++i) hull.push_back(in_hull(i));
    is_round = widths.round();
    jaw = {in_hull(widths.least_edge), in_hull(widths.least_edge + 1)};
    widest = {in_hull(widths.largest_between[0]), in_hull(widths.largest_between[1])};
    const CutPlaces& at = solid.vertices;
    const auto [edge, across] = along(at);
    opposite = farthest(hull, at, across);
    ends = {farthest(hull, at, -edge), farthest(hull, at, edge)};
    top = {farthest(used, at, k_upwards)};
    bottom = {farthest(used, at, -k_upwards)};
}

void CutMeasures::Cut::find_ends(const Solid& solid, const CutRoles& roles) {
    const CutPlaces& at = solid.vertices;
    const Vec3 across = along(at).across;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
        const CutCorners& loop = solid.facets[f].corners;
        if (loop.size() < 3) continue;
        const CutPair widest_here{farthest(loop, at, -across), farthest(loop, at, across)};
        if (roles.parts[f] == StonePart::table) {
            table = loop;
            table_ends = widest_here;
        } else if (roles.parts[f] == StonePart::culet &&
                   std::count(loop.begin(), loop.end(), bottom[0]) > 0) {
            culet = loop;
            culet_ends = widest_here;
        }
    }
    // If the table is level, all its corners are the highest.
    if (std::find(table.begin(), table.end(), top[0]) != table.end()) top = table;
    table = large_corners(table, at);
    culet = large_corners(culet, at);
    const CutCorners& corners = table;
    if (corners.size() % 2 != 0 || !is_round) return;
    std::vector<CutPair> diagonals;
    for (std::size_t i = 0; i < corners.size() / 2; ++i)
        diagonals.push_back({corners[i], corners[i + corners.size() / 2]});
    table_extremes =
        extremes(diagonals, [&](const CutPair& p) { return glm::length(in_plan(between(at, p))); });
}

void CutMeasures::Cut::find_girdle(const Solid& solid, const CutRoles& roles) {
    const CutPlaces& at = solid.vertices;
    const std::set<int> above = rim_of(solid, roles, true), below = rim_of(solid, roles, false);
    upper.assign(above.begin(), above.end());
    lower.assign(below.begin(), below.end());
    stars = star_tips(solid, roles, above);
    halves = half_tips(solid, roles, below);
    flats = girdle_flats(solid, roles);
    const std::vector<Chord> chords = girdle_chords(solid, roles);
    const auto thickness = [&](const Chord& chord) { return chord.length(at); };
    girdle_extremes = extremes(chords, thickness);
    if (!is_round) return;
    const auto at_mains = [&](const CutCorners& rim, const std::vector<int>& mains) {
        CutCorners some;
        for (const int c : rim) {
            for (const int main : mains) {
                const CutCorners& loop = solid.facets[std::size_t(main)].corners;
                if (std::count(loop.begin(), loop.end(), c) == 0) continue;
                some.push_back(c);
                break;
            }
        }
        return some;
    };
    const auto height = [&](int c) { return at[std::size_t(c)].z; };
    crown_at_mains = at_mains(upper, roles.crown_mains);
    pavilion_at_mains = at_mains(lower, roles.pavilion_mains);
    for (const Chord& chord : chords) {
        if (std::count(crown_at_mains.begin(), crown_at_mains.end(), chord.corner) > 0)
            girdle_at_mains.push_back(chord);
    }
    crown_extremes = extremes(crown_at_mains, height);
    pavilion_extremes = extremes(pavilion_at_mains, height);
    girdle_variation = extremes(girdle_at_mains, thickness);
}

void CutMeasures::Cut::find_offsets(const CutPlaces& at) {
    const auto towards = [](const Vec3& step, Vec3& direction) {
        if (glm::length(step) > 0) direction = glm::normalize(step);
    };
    const Vec3 outline = middle_of(hull, at), end = middle_of(low(), at);
    towards(end - outline, culet_off);
    if (table.empty()) return;
    towards(middle_of(table, at) - outline, table_off);
    towards(end - middle_of(table, at), table_to_culet);
}

void CutMeasures::Cut::find_decisive() {
    std::set<int> all;
    for (const CutCorners* some : {&hull, &table, &culet, &top, &bottom, &upper, &lower})
        all.insert(some->begin(), some->end());
    for (const GirdleFlat& flat : flats) all.insert(flat.corners.begin(), flat.corners.end());
    for (const StarTip& star : stars) all.insert(star.tip);
    for (const HalfTip& half : halves) all.insert(half.tip);
    decisive.assign(all.begin(), all.end());
}

void CutMeasures::Cut::find_angles(const Solid& solid, const CutRoles& roles) {
    for (const bool crown : {true, false}) {
        const std::vector<int>& mains = crown ? roles.crown_mains : roles.pavilion_mains;
        const std::string name = crown ? "crown angle" : "pavilion angle";
        if (mains.empty()) continue;
        Angle mean{name, {}};
        for (const int f : mains) mean.of.emplace_back(f, degrees(1) / double(mains.size()));
        angles.push_back(std::move(mean));
        const std::vector<int> extreme = extremes(mains, [&](int f) {
            return inclination(solid.facets[std::size_t(f)].plane.normal, k_upwards);
        });
        if (extreme.empty()) continue;
        angles.push_back({name + " min", {{extreme[1], degrees(1)}}});
        angles.push_back({name + " max", {{extreme[0], degrees(1)}}});
        if (is_round)
            angles.push_back(
                {name + " variation", {{extreme[0], degrees(1)}, {extreme[1], -degrees(1)}}});
    }
}

CutRoles cut_roles(const Solid& solid, const Vec3& up) {
    CutRoles roles;
    const int table = table_facet(solid, up);
    for (std::size_t f = 0; f < solid.facets.size(); ++f)
        roles.parts.push_back(part_of(solid, int(f), table, up));
    roles.crown_mains = main_facets(solid, up, true);
    roles.pavilion_mains = main_facets(solid, up, false);
    return roles;
}

CutMeasures::CutMeasures(const Solid& solid, const CutRoles& roles) {
    auto cut = std::make_unique<Cut>();
    cut->find_outline(solid);
    if (!cut->hull.empty()) {
        cut->find_ends(solid, roles);
        cut->find_girdle(solid, roles);
        cut->find_offsets(solid.vertices);
        cut->find_decisive();
        cut->find_angles(solid, roles);
    }
    cut_ = std::move(cut);
}

CutMeasures::~CutMeasures() = default;
CutMeasures::CutMeasures(CutMeasures&&) noexcept = default;

const std::vector<int>& CutMeasures::decisive() const {
    return cut_->decisive;
}

const std::vector<CutMeasures::Angle>& CutMeasures::angles() const {
    return cut_->angles;
}

}  // namespace culet
