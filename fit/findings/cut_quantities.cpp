#include "fit/findings/cut_quantities.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>

#include "fit/findings/plan_view.h"
#include "stone/design/tiers.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

constexpr double k_round = 1.05;

class Cut {
public:
    Cut(const FitModel& model, const Shape& shape, const Outline& outline)
        : model_(model), shape_(shape), outline_(outline), plan(shape, outline) {
        const int up = table_facet(model.stone().solid, model.stone().up);
        if (up >= 0) table = outline.loops[std::size_t(up)];
    }

    Quantity height_of(int corner) const { return plan.along(corner, {0, 0, 1}); }

    template <class Corners>
    Quantity mean_height(const Corners& corners) const {
        Quantity q;
        for (const int c : corners) q.add(height_of(c), 1 / double(corners.size()));
        return q;
    }

    int extreme(double sign) const {
        const std::vector<int>& corners = plan.corners();
        return *std::max_element(corners.begin(), corners.end(), [&](int a, int b) {
            return sign * plan.place(a).z < sign * plan.place(b).z;
        });
    }

    // The table where it is the top: level facets' corners are all the highest at once.
    Quantity top() const {
        const int highest = extreme(1);
        const bool is_table = std::find(table.begin(), table.end(), highest) != table.end();
        return is_table ? mean_height(table) : height_of(highest);
    }

    // Corners where the girdle (or, without one, the other side) meets this side.
    std::set<int> rim(bool crown) const {
        std::set<int> girdle, side, other;
        for (std::size_t f = 0; f < outline_.loops.size(); ++f) {
            const std::vector<int>& loop = outline_.loops[f];
            const bool is_above = (shape_.normals[f].z > 0) == crown;
            (model_.frame().is_girdle(int(f)) ? girdle
             : is_above                       ? side
                                              : other)
                .insert(loop.begin(), loop.end());
        }
        const std::set<int>& against = girdle.empty() ? other : girdle;
        std::set<int> both;
        std::set_intersection(side.begin(), side.end(), against.begin(), against.end(),
                              std::inserter(both, both.begin()));
        return both;
    }

    Quantity mean_angle(const std::vector<int>& facets) const {
        Quantity q;
        for (const int f : facets) q.add(tilt_from_up(f)(shape_), 1 / double(facets.size()));
        return q;
    }

private:
    const FitModel& model_;
    const Shape& shape_;
    const Outline& outline_;

public:
    const PlanView plan;
    std::vector<int> table;  // its corners; none where it is not there
};

// Mains that were drawn alike: by tiers, those of one angle together (0.02 degrees, as designs are
// written, or what a rough drawing scatters by).
std::vector<std::vector<int>> mains_drawn_alike(const Stone& stone, bool crown) {
    constexpr double k_same = radians(0.02), k_surely = 2;
    const std::vector<int> mains = main_facets(stone.solid, stone.up, crown);
    std::vector<FacetTier> groups;
    for (FacetTier& tier : tiers_of(stone.solid, stone.up)) {
        std::erase_if(tier.facets, [&](int f) {
            return std::find(mains.begin(), mains.end(), f) == mains.end();
        });
        if (tier.facets.empty()) continue;
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const FacetTier& other) {
            return std::abs(tier.inclination - other.inclination) <
                   std::max(k_same, k_surely * std::hypot(tier.scatter, other.scatter));
        });
        if (same == groups.end()) {
            groups.push_back(std::move(tier));
        } else {
            same->facets.insert(same->facets.end(), tier.facets.begin(), tier.facets.end());
        }
    }
    std::vector<std::vector<int>> all;
    for (FacetTier& group : groups) all.push_back(std::move(group.facets));
    return all;
}

}  // namespace

std::vector<CutQuantity> cut_quantities(const FitModel& model, const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline) {
    const Stone& stone = model.stone();
    const Cut cut(model, shape, *outline);
    const PlanView& plan = cut.plan;
    if (plan.hull().size() < 3) return {};
    std::vector<CutQuantity> all;
    const auto length_in_unit = [&](const char* name, const Quantity& q) {
        all.push_back({name, std::string(name_of(stone.unit)), q, model.frame().scale()});
    };
    const auto per_cent = [&](const char* name, const Quantity& q) {
        all.push_back({name, "%", q, 100});
    };
    const PlanView::Jaws jaws = plan.narrowest();
    const Quantity width = plan.extent(jaws, plan.hull(), true),
                   length = plan.extent(jaws, plan.hull(), false),
                   diameter = 1 / std::numbers::pi * plan.perimeter();
    const bool is_round = std::max(length.value, diameter.value) < k_round * width.value;
    const Quantity& across = is_round ? diameter : width;
    if (is_round) length_in_unit("diameter", diameter);
    length_in_unit("width", width);
    length_in_unit("length", length);
    length_in_unit("caliper min", width);
    length_in_unit("caliper max", plan.widest());
    length_in_unit("caliper mean", diameter);
    all.push_back({"length/width", "", length / width, 1});
    const Quantity top = cut.top(), bottom = cut.height_of(cut.extreme(-1));
    length_in_unit("depth", top - bottom);
    per_cent("total depth", (top - bottom) / across);
    if (cut.table.size() >= 3) {
        per_cent(
            "table",
            (is_round ? plan.mean_across(cut.table) : plan.extent(jaws, cut.table, true)) / across);
    }
    const std::set<int> upper = cut.rim(true), lower = cut.rim(false);
    if (!upper.empty() && !lower.empty()) {
        const Quantity high = cut.mean_height(upper), low = cut.mean_height(lower);
        per_cent("crown height", (top - high) / across);
        per_cent("girdle thickness", (high - low) / across);
        per_cent("pavilion depth", (low - bottom) / across);
    }
    for (const bool crown : {true, false}) {
        const auto alike = mains_drawn_alike(stone, crown);
        for (const std::vector<int>& facets : alike) {
            std::string name = crown ? "crown angle" : "pavilion angle";
            for (const int f : facets) {
                if (alike.size() > 1) name += " " + stone.solid.facets[std::size_t(f)].name;
            }
            all.push_back({name, "deg", cut.mean_angle(facets), degrees(1)});
        }
    }
    const Quantity inside = enclosed_volume(outline)(shape);
    const double mm3 = std::pow(model.frame().scale() * mm_per(stone.unit), 3);
    all.push_back({"volume", "mm3", inside, mm3});
    if (const auto density = stone.material.density_g_cm3) {
        all.push_back({"weight", "ct", inside, carat(mm3, *density)});
    }
    return all;
}

}  // namespace culet
