#include "fit/findings/cut_quantities.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <set>

#include "stone/design/tiers.h"
#include "stone/numbers/units.h"
#include "stone/solid/caliper.h"

namespace culet {

namespace {

// Half diameters: step of central differences. Rounding leaves 1e-9 of a slope; shorter edges have
// no slope.
constexpr double k_step = 1e-7;

using Corners = std::vector<int>;  // of the outline

// The corners that determine a cut's size. While they stay the same, its lengths are smooth.
struct Cut {
    Corners hull;                         // in plan, counter-clockwise
    std::array<int, 2> jaw{};             // ends of the hull's edge at one jaw of the least width
    int opposite = -1;                    // the corner at the other jaw
    std::array<int, 2> ends{}, widest{};  // of the length; of the largest width
    Corners table;
    std::array<int, 2> table_ends{};    // along the least width
    Corners top, bottom, upper, lower;  // the girdle's upper and lower edge
    bool is_round = false;
};

struct Along {
    Vec3 edge, across;  // in plan; `across` points inwards
};
Along along(const Cut& cut, const std::vector<Vec3>& at) {
    const Vec3 step = at[std::size_t(cut.jaw[1])] - at[std::size_t(cut.jaw[0])];
    const Vec3 edge = Vec3{step.x, step.y, 0} / std::hypot(step.x, step.y);
    return {edge, {-edge.y, edge.x, 0}};
}

int farthest(const Corners& corners, const std::vector<Vec3>& at, const Vec3& direction) {
    return *std::max_element(corners.begin(), corners.end(), [&](int a, int b) {
        return glm::dot(direction, at[std::size_t(a)]) < glm::dot(direction, at[std::size_t(b)]);
    });
}

// Corners at which the girdle (or, without one, the other side) meets this side.
Corners rim(const FitModel& model, const Shape& shape, const Outline& outline, bool crown) {
    std::set<int> girdle, side, other;
    for (std::size_t f = 0; f < outline.loops.size(); ++f) {
        const Corners& loop = outline.loops[f];
        const bool is_above = (shape.normals[f].z > 0) == crown;
        (model.frame().is_girdle(int(f)) ? girdle
         : is_above                      ? side
                                         : other)
            .insert(loop.begin(), loop.end());
    }
    const std::set<int>& against = girdle.empty() ? other : girdle;
    Corners both;
    std::set_intersection(side.begin(), side.end(), against.begin(), against.end(),
                          std::back_inserter(both));
    return both;
}

// Has no hull if the stone has no extent in plan.
Cut cut_of(const FitModel& model, const Shape& shape, const Outline& outline,
           const std::vector<Vec3>& at) {
    std::set<int> known;
    for (const Corners& loop : outline.loops) known.insert(loop.begin(), loop.end());
    const Corners used(known.begin(), known.end());
    Solid plan;
    for (const int c : used) plan.vertices.push_back(at[std::size_t(c)]);
    const CaliperWidths widths = caliper_widths(plan);
    Cut cut;
    if (widths.outline.size() < 3) return cut;
    const auto in_hull = [&](std::size_t i) {
        return used[std::size_t(widths.outline[i % widths.outline.size()])];
    };
    for (std::size_t i = 0; i < widths.outline.size(); ++i) cut.hull.push_back(in_hull(i));
    cut.is_round = widths.round();
    cut.jaw = {in_hull(widths.least_edge), in_hull(widths.least_edge + 1)};
    cut.widest = {in_hull(widths.largest_between[0]), in_hull(widths.largest_between[1])};
    const auto [edge, across] = along(cut, at);
    cut.opposite = farthest(cut.hull, at, across);
    cut.ends = {farthest(cut.hull, at, -edge), farthest(cut.hull, at, edge)};
    const Vec3 up{0, 0, 1};
    cut.top = {farthest(used, at, up)};
    cut.bottom = {farthest(used, at, -up)};
    cut.upper = rim(model, shape, outline, true);
    cut.lower = rim(model, shape, outline, false);
    const int table = table_facet(model.stone().solid, model.stone().up);
    if (table < 0 || outline.loops[std::size_t(table)].size() < 3) return cut;
    cut.table = outline.loops[std::size_t(table)];
    cut.table_ends = {farthest(cut.table, at, -across), farthest(cut.table, at, across)};
    // If the table is level, all its corners are the highest.
    if (std::find(cut.table.begin(), cut.table.end(), cut.top[0]) != cut.table.end()) {
        cut.top = cut.table;
    }
    return cut;
}

double mean_radius(const Corners& loop, const std::vector<Vec3>& at) {
    Vec3 middle(0);
    for (const int c : loop) middle += at[std::size_t(c)] / double(loop.size());
    double mean = 0;
    for (const int c : loop) {
        const Vec3 d = at[std::size_t(c)] - middle;
        mean += std::hypot(d.x, d.y) / double(loop.size());
    }
    return mean;
}

// `at` is in half diameters; `scale` converts to `unit`.
std::vector<CutQuantity> lengths_of(const Cut& cut, const std::vector<Vec3>& at, double scale,
                                    const std::string& unit) {
    const auto between = [&](const std::array<int, 2>& ends) {
        return at[std::size_t(ends[1])] - at[std::size_t(ends[0])];
    };
    const auto height = [&](const Corners& corners) {
        double mean = 0;
        for (const int c : corners) mean += at[std::size_t(c)].z / double(corners.size());
        return mean;
    };
    const auto [edge, across] = along(cut, at);
    const double width = glm::dot(across, between({cut.jaw[0], cut.opposite})),
                 length = glm::dot(edge, between(cut.ends));
    double around = 0;
    for (std::size_t i = 0; i < cut.hull.size(); ++i) {
        const Vec3 side = between({cut.hull[i], cut.hull[(i + 1) % cut.hull.size()]});
        around += std::hypot(side.x, side.y);
    }
    const double diameter = around / std::numbers::pi;
    const Vec3 widest = between(cut.widest);
    const double size = cut.is_round ? diameter : width;
    const double top = height(cut.top), bottom = height(cut.bottom);
    std::vector<CutQuantity> all;
    all.reserve(16);
    const auto put = [&](const char* name, double value) {
        all.push_back({name, unit, {scale * value, {}}});
    };
    const auto per_cent = [&](const char* name, double value) {
        all.push_back({name, "%", {100 * value / size, {}}});
    };
    if (cut.is_round) put("diameter", diameter);
    put("width", width);
    put("length", length);
    put("caliper min", width);
    put("caliper max", std::hypot(widest.x, widest.y));
    put("caliper mean", diameter);
    all.push_back({"length/width", "", {length / width, {}}});
    put("depth", top - bottom);
    per_cent("total depth", top - bottom);
    if (!cut.table.empty()) {
        per_cent("table", cut.is_round ? 2 * mean_radius(cut.table, at)
                                       : glm::dot(across, between(cut.table_ends)));
    }
    if (!cut.upper.empty() && !cut.lower.empty()) {
        const double high = height(cut.upper), low = height(cut.lower);
        per_cent("crown height", top - high);
        per_cent("girdle thickness", high - low);
        per_cent("pavilion depth", low - bottom);
    }
    return all;
}

std::vector<CutQuantity> lengths_of(const FitModel& model, const Shape& shape,
                                    const Outline& outline) {
    std::vector<Vec3> at;
    for (const Corner& c : outline.corners) at.push_back(place_of(shape, c));
    const Cut cut = cut_of(model, shape, outline, at);
    if (cut.hull.empty()) return {};
    const std::string unit(name_of(model.stone().unit));
    std::vector<CutQuantity> all = lengths_of(cut, at, model.frame().scale(), unit);
    std::set<int> decisive;
    for (const Corners* some :
         {&cut.hull, &cut.table, &cut.top, &cut.bottom, &cut.upper, &cut.lower}) {
        decisive.insert(some->begin(), some->end());
    }
    for (const int c : decisive) {
        std::vector<Vec3> slopes(all.size(), Vec3(0));
        for (int k = 0; k < 3; ++k) {
            double& moved = at[std::size_t(c)][k];
            const double here = moved;
            moved = here + k_step;
            const auto ahead = lengths_of(cut, at, model.frame().scale(), unit);
            moved = here - k_step;
            const auto behind = lengths_of(cut, at, model.frame().scale(), unit);
            moved = here;
            for (std::size_t q = 0; q < all.size(); ++q) {
                slopes[q][k] = (ahead[q].quantity.value - behind[q].quantity.value) / (2 * k_step);
            }
        }
        for (std::size_t q = 0; q < all.size(); ++q) {
            if (slopes[q] == Vec3(0)) continue;
            add_corner(all[q].quantity, shape, outline.corners[std::size_t(c)], slopes[q]);
        }
    }
    return all;
}

}  // namespace

std::vector<CutQuantity> cut_quantities(const FitModel& model, const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline) {
    std::vector<CutQuantity> all = lengths_of(model, shape, *outline);
    if (all.empty()) return all;
    const Stone& stone = model.stone();
    for (const bool crown : {true, false}) {
        const std::vector<int> mains = main_facets(stone.solid, stone.up, crown);
        Quantity mean;
        for (const int f : mains) {
            mean.add(tilt_from_up(f)(shape), degrees(1) / double(mains.size()));
        }
        if (!mains.empty()) {
            all.push_back({crown ? "crown angle" : "pavilion angle", "deg", std::move(mean)});
        }
    }
    const Quantity inside = enclosed_volume(outline)(shape);
    const double mm3 = std::pow(model.frame().scale() * mm_per(stone.unit), 3);
    const auto put_size = [&](const char* name, const char* unit, double factor) {
        all.push_back({name, unit, {}});
        all.back().quantity.add(inside, factor);
    };
    put_size("volume", "mm3", mm3);
    if (const auto density = stone.material.density_g_cm3) {
        put_size("weight", "ct", carat(mm3, *density));
    }
    return all;
}

}  // namespace culet
