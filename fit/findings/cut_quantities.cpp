#include "fit/findings/cut_quantities.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "fit/findings/plan_view.h"
#include "stone/tiers.h"
#include "stone/units.h"

namespace culet {

namespace {

constexpr double k_round = 1.05;
// The table looks up within this; so does, the other way, a culet facet.
constexpr double k_level_deg = 5;

Quantity ratio(const Quantity& above, const Quantity& below) {
    Quantity q;
    q.add(above, 1 / below.value);
    q.add(below, -above.value / (below.value * below.value));
    q.value = above.value / below.value;
    return q;
}

class Cut {
public:
    Cut(const System& system, const Shape& shape, const Outline& outline)
        : system_(system), shape_(shape), outline_(outline), plan_(shape, outline) {
        find_table();
    }

    const PlanView& plan() const { return plan_; }
    int table() const { return table_; }
    const std::vector<int>& table_corners() const { return outline_.loops[std::size_t(table_)]; }

    Quantity height_of(int corner) const {
        Quantity q{plan_.place(corner).z, {}};
        add_corner(q, shape_, outline_.corners[std::size_t(corner)], {0, 0, 1});
        return q;
    }

    Quantity mean_height(const std::set<int>& corners) const {
        Quantity q;
        for (const int c : corners) q.add(height_of(c), 1 / double(corners.size()));
        return q;
    }

    // The table where it is the top: level facets' corners are all the highest at once.
    Quantity top() const {
        const int highest = extreme(1);
        if (table_ < 0) return height_of(highest);
        const std::vector<int>& loop = table_corners();
        if (std::find(loop.begin(), loop.end(), highest) == loop.end()) return height_of(highest);
        return mean_height(std::set<int>(loop.begin(), loop.end()));
    }

    int extreme(double sign) const {
        const std::vector<int>& corners = plan_.corners();
        return *std::max_element(corners.begin(), corners.end(), [&](int a, int b) {
            return sign * plan_.place(a).z < sign * plan_.place(b).z;
        });
    }

    // Corners where the girdle (or, without one, the other side) meets this side.
    std::set<int> rim(bool crown) const {
        std::set<int> of_girdle, of_side, of_other;
        bool has_girdle = false;
        for (std::size_t f = 0; f < outline_.loops.size(); ++f) {
            const std::vector<int>& loop = outline_.loops[f];
            if (system_.is_girdle(int(f))) {
                has_girdle = has_girdle || !loop.empty();
                of_girdle.insert(loop.begin(), loop.end());
            } else if ((shape_.normals[f].z > 0) == crown) {
                of_side.insert(loop.begin(), loop.end());
            } else {
                of_other.insert(loop.begin(), loop.end());
            }
        }
        const std::set<int>& against = has_girdle ? of_girdle : of_other;
        std::set<int> both;
        std::set_intersection(of_side.begin(), of_side.end(), against.begin(), against.end(),
                              std::inserter(both, both.begin()));
        return both;
    }

    // Facets that reach from the girdle to the table or to the lowest corner, by the mesh's
    // corners, which small edges of meets that come apart do not disturb.
    std::vector<int> mains(bool crown) const {
        const Outline& mesh = *system_.mesh_outline();
        const std::vector<Vec3>& points = system_.mesh_shape().points;
        std::set<int> girdle, end;
        for (std::size_t f = 0; f < mesh.loops.size(); ++f) {
            if (system_.is_girdle(int(f)))
                girdle.insert(mesh.loops[f].begin(), mesh.loops[f].end());
        }
        if (crown && table_ >= 0) {
            end.insert(mesh.loops[std::size_t(table_)].begin(),
                       mesh.loops[std::size_t(table_)].end());
        } else {
            int lowest = 0;
            for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
                if ((crown ? -1 : 1) * points[c].z <
                    (crown ? -1 : 1) * points[std::size_t(lowest)].z) {
                    lowest = int(c);
                }
            }
            end.insert(lowest);
            // A culet facet: all of its corners are the end.
            for (std::size_t f = 0; f < mesh.loops.size(); ++f) {
                const std::vector<int>& loop = mesh.loops[f];
                const bool level = std::abs(shape_.normals[f].z) > std::cos(radians(k_level_deg));
                if (level && std::find(loop.begin(), loop.end(), lowest) != loop.end()) {
                    end.insert(loop.begin(), loop.end());
                }
            }
        }
        std::vector<int> mains, all;
        for (std::size_t f = 0; f < mesh.loops.size(); ++f) {
            const bool level = std::abs(shape_.normals[f].z) > std::cos(radians(k_level_deg));
            if (int(f) == table_ || level || system_.is_girdle(int(f))) continue;
            if ((shape_.normals[f].z > 0) != crown) continue;
            all.push_back(int(f));
            const auto touches = [&](const std::set<int>& corners) {
                return std::any_of(mesh.loops[f].begin(), mesh.loops[f].end(),
                                   [&](int c) { return corners.count(c) > 0; });
            };
            if (touches(end) && touches(girdle)) mains.push_back(int(f));
        }
        return mains.empty() ? all : mains;
    }

    Quantity mean_angle(const std::vector<int>& facets) const {
        Quantity q;
        for (const int f : facets) q.add(tilt_from_up(f)(shape_), 1 / double(facets.size()));
        return q;
    }

private:
    void find_table() {
        const int up = system_.up_facet();
        if (up >= 0 && outline_.loops[std::size_t(up)].size() >= 3) {
            table_ = up;
            return;
        }
        double most = 0;
        for (std::size_t f = 0; f < outline_.loops.size(); ++f) {
            if (outline_.loops[f].size() < 3) continue;
            if (shape_.normals[f].z < std::cos(radians(k_level_deg))) continue;
            std::vector<Corner> loop;
            for (const int c : outline_.loops[f]) loop.push_back(outline_.corners[std::size_t(c)]);
            const double size = enclosed_area(loop)(shape_).value;
            if (size > most) {
                most = size;
                table_ = int(f);
            }
        }
    }

    const System& system_;
    const Shape& shape_;
    const Outline& outline_;
    PlanView plan_;
    int table_ = -1;
};

// Mains that were drawn alike: by tiers, those of one angle together (0.02 degrees, as designs are
// written, or what a rough drawing scatters by).
std::vector<std::vector<int>> drawn_alike(const Stone& stone, const std::vector<int>& mains) {
    constexpr double k_same_deg = 0.02, k_surely = 2;
    struct Group {
        double inclination = 0, scatter = 0;
        std::vector<int> facets;
    };
    std::vector<Group> groups;
    for (const FacetTier& tier : tiers_of(stone.solid, stone.up)) {
        Group own{tier.inclination, tier.scatter, {}};
        for (const int f : mains) {
            if (std::find(tier.facets.begin(), tier.facets.end(), f) != tier.facets.end())
                own.facets.push_back(f);
        }
        if (own.facets.empty()) continue;
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& other) {
            const double limit =
                std::max(radians(k_same_deg), k_surely * std::hypot(own.scatter, other.scatter));
            return std::abs(own.inclination - other.inclination) < limit;
        });
        if (same == groups.end()) {
            groups.push_back(std::move(own));
        } else {
            same->facets.insert(same->facets.end(), own.facets.begin(), own.facets.end());
        }
    }
    std::vector<std::vector<int>> all;
    for (Group& group : groups) all.push_back(std::move(group.facets));
    return all;
}

std::string spaced_names(const Solid& solid, const std::vector<int>& facets) {
    std::string text;
    for (const int f : facets) text += " " + solid.facets[std::size_t(f)].name;
    return text;
}

}  // namespace

std::vector<CutQuantity> cut_quantities(const System& system, const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline) {
    std::vector<CutQuantity> all;
    const Cut cut(system, shape, *outline);
    const PlanView& plan = cut.plan();
    if (plan.hull().size() < 3) return all;
    const std::string unit(name_of(system.stone().unit));
    const auto put = [&](const std::string& name, const std::string& in, const Quantity& q,
                         double factor) {
        all.push_back({name, in, q, factor});
    };
    const PlanView::Jaws jaws = plan.narrowest();
    const Quantity width = plan.width(jaws), length = plan.extent(jaws, plan.hull(), false);
    Quantity diameter;
    diameter.add(plan.perimeter(), 1 / std::numbers::pi);
    const bool round =
        length.value < k_round * width.value && diameter.value < k_round * width.value;
    const Quantity& across = round ? diameter : width;
    if (round) put("diameter", unit, diameter, system.scale());
    put("width", unit, width, system.scale());
    put("length", unit, length, system.scale());
    put("caliper min", unit, width, system.scale());
    put("caliper max", unit, plan.widest(), system.scale());
    put("caliper mean", unit, diameter, system.scale());
    put("length/width", "", ratio(length, width), 1);
    const Quantity top = cut.top(), bottom = cut.height_of(cut.extreme(-1));
    Quantity depth = top;
    depth.add(bottom, -1);
    put("depth", unit, depth, system.scale());
    put("total depth", "%", ratio(depth, across), 100);
    if (cut.table() >= 0) {
        put("table", "%",
            ratio(round ? plan.mean_across(cut.table_corners())
                        : plan.extent(jaws, cut.table_corners(), true),
                  across),
            100);
    }
    const std::set<int> upper = cut.rim(true), lower = cut.rim(false);
    if (!upper.empty() && !lower.empty()) {
        const Quantity high = cut.mean_height(upper), low = cut.mean_height(lower);
        Quantity crown = top, girdle = high, pavilion = low;
        crown.add(high, -1);
        girdle.add(low, -1);
        pavilion.add(bottom, -1);
        put("crown height", "%", ratio(crown, across), 100);
        put("girdle thickness", "%", ratio(girdle, across), 100);
        put("pavilion depth", "%", ratio(pavilion, across), 100);
    }
    for (const bool crown : {true, false}) {
        const std::string name = crown ? "crown angle" : "pavilion angle";
        const auto alike = drawn_alike(system.stone(), cut.mains(crown));
        for (const std::vector<int>& facets : alike) {
            const bool one = alike.size() == 1;
            put(one ? name : name + spaced_names(system.stone().solid, facets), "deg",
                cut.mean_angle(facets), degrees(1));
        }
    }
    const Quantity inside = enclosed_volume(outline)(shape);
    const double mm3 = std::pow(system.scale() * mm_per(system.stone().unit), 3);
    put("volume", "mm3", inside, mm3);
    if (const auto density = system.stone().material.density_g_cm3) {
        put("weight", "ct", inside, carat(mm3, *density));
    }
    return all;
}

}  // namespace culet
