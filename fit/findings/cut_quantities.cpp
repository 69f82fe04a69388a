#include "fit/findings/cut_quantities.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

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
        : system_(system), shape_(shape), outline_(outline) {
        for (const Corner& c : outline.corners) places_.push_back(place_of(shape, c));
        std::set<int> used;
        for (const std::vector<int>& loop : outline.loops) used.insert(loop.begin(), loop.end());
        corners_.assign(used.begin(), used.end());
        find_table();
        find_hull();
    }

    int table() const { return table_; }

    Quantity height_of(int corner) const {
        Quantity q{places_[std::size_t(corner)].z, {}};
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
        return *std::max_element(corners_.begin(), corners_.end(), [&](int a, int b) {
            return sign * places_[std::size_t(a)].z < sign * places_[std::size_t(b)].z;
        });
    }

    Quantity perimeter() const {
        Quantity q;
        for (std::size_t i = 0; i < hull_.size(); ++i) {
            q.add(plan_distance(hull_[i], hull_[(i + 1) % hull_.size()]), 1);
        }
        return q;
    }

    Quantity plan_distance(int a, int b) const {
        const Vec3 d = flat(places_[std::size_t(b)] - places_[std::size_t(a)]);
        const double length = glm::length(d);
        Quantity q{length, {}};
        if (!(length > 0)) return q;
        put(q, b, d / length);
        put(q, a, -d / length);
        return q;
    }

    // The two corners of the hull that lie furthest apart.
    Quantity widest() const {
        int from = hull_[0], to = hull_[1];
        double most = 0;
        for (std::size_t i = 0; i < hull_.size(); ++i) {
            for (std::size_t j = i + 1; j < hull_.size(); ++j) {
                const double apart = glm::length(
                    flat(places_[std::size_t(hull_[j])] - places_[std::size_t(hull_[i])]));
                // Of equal ones, to rounding, the first.
                if (apart <= most * (1 + 1e-12)) continue;
                most = apart;
                from = hull_[i];
                to = hull_[j];
            }
        }
        return plan_distance(from, to);
    }

    // The hull edge whose opposite jaw stands nearest.
    struct Jaws {
        int from = -1, to = -1, opposite = -1;
        double width = 1e300;
    };
    Jaws narrowest() const {
        Jaws best;
        for (std::size_t i = 0; i < hull_.size(); ++i) {
            Jaws jaws{hull_[i], hull_[(i + 1) % hull_.size()], -1, 0};
            const Vec3 e = along(jaws), inward{-e.y, e.x, 0};
            for (const int c : hull_) {
                const double away =
                    glm::dot(inward, places_[std::size_t(c)] - places_[std::size_t(jaws.from)]);
                if (away > jaws.width || jaws.opposite < 0) {
                    jaws.width = away;
                    jaws.opposite = c;
                }
            }
            if (jaws.width < best.width) best = jaws;
        }
        return best;
    }

    Quantity width(const Jaws& jaws) const {
        const Vec3 e = along(jaws), inward{-e.y, e.x, 0};
        const Vec3 off =
            flat(places_[std::size_t(jaws.opposite)] - places_[std::size_t(jaws.from)]);
        const double t = glm::dot(off, e) / edge_length(jaws);
        Quantity q{glm::dot(inward, off), {}};
        put(q, jaws.opposite, inward);
        put(q, jaws.from, -(1 - t) * inward);
        put(q, jaws.to, -t * inward);
        return q;
    }

    // Extent of corners along the jaws (`across` false) or from jaw to jaw; the directions turn
    // with the edge that one jaw lies on.
    Quantity extent(const Jaws& jaws, const std::vector<int>& corners, bool across) const {
        const Vec3 e = along(jaws), inward{-e.y, e.x, 0};
        const Vec3 direction = across ? inward : e;
        const auto order = [&](int a, int b) {
            return glm::dot(direction, places_[std::size_t(a)]) <
                   glm::dot(direction, places_[std::size_t(b)]);
        };
        const int high = *std::max_element(corners.begin(), corners.end(), order),
                  low = *std::min_element(corners.begin(), corners.end(), order);
        const Vec3 between = flat(places_[std::size_t(high)] - places_[std::size_t(low)]);
        Quantity q{glm::dot(direction, between), {}};
        put(q, high, direction);
        put(q, low, -direction);
        // d(e) = inward (inward . d(to - from)) / length; d(inward) = -e times the same.
        const double turn = across ? -glm::dot(e, between) : glm::dot(inward, between);
        const Vec3 slope = inward * (turn / edge_length(jaws));
        put(q, jaws.to, slope);
        put(q, jaws.from, -slope);
        return q;
    }

    // Mean distance of opposite corners of the table.
    Quantity table_across() const {
        const std::vector<int>& loop = outline_.loops[std::size_t(table_)];
        const std::size_t count = loop.size();
        Quantity q;
        if (count % 2 == 0) {
            for (std::size_t i = 0; i < count / 2; ++i) {
                q.add(plan_distance(loop[i], loop[i + count / 2]), 2 / double(count));
            }
            return q;
        }
        // An odd table's corners face the middle of edges: twice the mean distance from the middle.
        Vec3 middle(0);
        for (const int c : loop) middle += places_[std::size_t(c)] / double(count);
        Vec3 mean_slope(0);
        for (const int c : loop) {
            const Vec3 d = flat(places_[std::size_t(c)] - middle);
            const double length = glm::length(d);
            q.value += 2 * length / double(count);
            if (!(length > 0)) continue;
            put(q, c, 2.0 / double(count) * d / length);
            mean_slope += 2.0 / double(count) * d / length;
        }
        for (const int c : loop) put(q, c, -mean_slope / double(count));
        return q;
    }
    const std::vector<int>& table_corners() const { return outline_.loops[std::size_t(table_)]; }
    const std::vector<int>& hull() const { return hull_; }

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
    static Vec3 flat(const Vec3& v) { return {v.x, v.y, 0}; }
    void put(Quantity& q, int corner, const Vec3& slope) const {
        add_corner(q, shape_, outline_.corners[std::size_t(corner)], slope);
    }
    double edge_length(const Jaws& jaws) const {
        return glm::length(flat(places_[std::size_t(jaws.to)] - places_[std::size_t(jaws.from)]));
    }
    Vec3 along(const Jaws& jaws) const {
        return flat(places_[std::size_t(jaws.to)] - places_[std::size_t(jaws.from)]) /
               edge_length(jaws);
    }

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

    // Andrew's monotone chain in plan, counter-clockwise; corners less than rounding apart count as
    // one.
    void find_hull() {
        std::vector<int> order = corners_;
        const auto at = [&](int c) { return places_[std::size_t(c)]; };
        std::sort(order.begin(), order.end(), [&](int a, int b) {
            return std::make_pair(at(a).x, at(a).y) < std::make_pair(at(b).x, at(b).y);
        });
        const auto left = [&](int a, int b, int c) {
            const Vec3 u = at(b) - at(a), v = at(c) - at(a);
            return u.x * v.y - u.y * v.x > 1e-12;
        };
        std::vector<int> chain;
        for (int pass = 0; pass < 2; ++pass) {
            const std::size_t begin = chain.size();
            for (const int c : order) {
                while (chain.size() >= begin + 2 &&
                       !left(chain[chain.size() - 2], chain.back(), c)) {
                    chain.pop_back();
                }
                chain.push_back(c);
            }
            chain.pop_back();
            std::reverse(order.begin(), order.end());
        }
        hull_ = std::move(chain);
    }

    const System& system_;
    const Shape& shape_;
    const Outline& outline_;
    std::vector<Vec3> places_;
    std::vector<int> corners_, hull_;
    int table_ = -1;
};

}  // namespace

std::vector<CutQuantity> cut_quantities(const System& system, const Shape& shape,
                                        const std::shared_ptr<const Outline>& outline) {
    std::vector<CutQuantity> all;
    const Cut cut(system, shape, *outline);
    if (cut.hull().size() < 3) return all;
    const std::string unit(name_of(system.stone().unit));
    const auto put = [&](const char* name, const std::string& in, const Quantity& q,
                         double factor) {
        all.push_back({name, in, q, factor});
    };
    const Cut::Jaws jaws = cut.narrowest();
    const Quantity width = cut.width(jaws), length = cut.extent(jaws, cut.hull(), false);
    Quantity diameter;
    diameter.add(cut.perimeter(), 1 / std::numbers::pi);
    const bool round =
        length.value < k_round * width.value && diameter.value < k_round * width.value;
    const Quantity& across = round ? diameter : width;
    if (round) put("diameter", unit, diameter, system.scale());
    put("width", unit, width, system.scale());
    put("length", unit, length, system.scale());
    put("caliper min", unit, width, system.scale());
    put("caliper max", unit, cut.widest(), system.scale());
    put("caliper mean", unit, diameter, system.scale());
    put("length/width", "", ratio(length, width), 1);
    const Quantity top = cut.top(), bottom = cut.height_of(cut.extreme(-1));
    Quantity depth = top;
    depth.add(bottom, -1);
    put("depth", unit, depth, system.scale());
    put("total depth", "%", ratio(depth, across), 100);
    if (cut.table() >= 0) {
        put("table", "%",
            ratio(round ? cut.table_across() : cut.extent(jaws, cut.table_corners(), true), across),
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
    const std::vector<int> crown_mains = cut.mains(true), pavilion_mains = cut.mains(false);
    if (!crown_mains.empty()) put("crown angle", "deg", cut.mean_angle(crown_mains), degrees(1));
    if (!pavilion_mains.empty()) {
        put("pavilion angle", "deg", cut.mean_angle(pavilion_mains), degrees(1));
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
