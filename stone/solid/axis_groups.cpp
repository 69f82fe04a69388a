#include "stone/solid/axis_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>

namespace culet {

namespace {

constexpr double k_full_turn = 2 * std::numbers::pi;

int steps_near(double turn, int order) {
    const int steps = static_cast<int>(std::lround(turn * order / k_full_turn)) % order;
    return steps < 0 ? steps + order : steps;
}

}  // namespace

std::vector<AxisMotion> motions_about_z(const std::vector<Automorphism>& all,
                                        const std::vector<Vec3>& points) {
    using Complex = std::complex<double>;
    Vec3 mean(0);
    for (const Vec3& p : points) mean += p / double(points.size());
    std::vector<AxisMotion> motions;
    for (const Automorphism& map : all) {
        Complex sum = 0;
        for (std::size_t v = 0; v < points.size(); ++v) {
            const Vec3 p = points[v] - mean, q = points[map.vertices[v]] - mean;
            const Complex from(p.x, map.turns_over ? -p.y : p.y), to(q.x, q.y);
            sum += to * std::conj(from);
        }
        AxisMotion motion{map, std::arg(sum), 0};
        const Complex turn = std::polar(1.0, motion.turn);
        double squares = 0;
        for (std::size_t v = 0; v < points.size(); ++v) {
            const Vec3 p = points[v] - mean, q = points[map.vertices[v]] - mean;
            const Complex from(p.x, map.turns_over ? -p.y : p.y), to(q.x, q.y);
            squares += std::norm(to - turn * from) + (p.z - q.z) * (p.z - q.z);
        }
        motion.misfit = std::sqrt(squares / double(points.size()));
        motions.push_back(std::move(motion));
    }
    return motions;
}

std::string AxisGroup::name() const {
    if (order == 1) return mirrors ? "Cs" : "C1";
    return fmt::format("C{}{}", order, mirrors ? "v" : "");
}

AxisGroup largest_group(const std::vector<AxisMotion>& motions, double largest_misfit) {
    AxisGroup group;
    std::vector<int> same(motions.empty() ? 0 : motions.front().map.facets.size());
    for (std::size_t f = 0; f < same.size(); ++f) same[f] = static_cast<int>(f);
    group.elements.push_back({same, 0, false});

    // The turn of highest order by one step; of several the best fit.
    const AxisMotion* generator = nullptr;
    for (const AxisMotion& m : motions) {
        if (m.map.turns_over || m.misfit > largest_misfit) continue;
        const int order = order_of(m.map);
        if (order < 2 || steps_near(m.turn, order) != 1 ||
            std::abs(std::remainder(m.turn - k_full_turn / order, k_full_turn)) >
                0.25 * k_full_turn / order) {
            continue;
        }
        if (order > group.order || (order == group.order && m.misfit < generator->misfit)) {
            group.order = order;
            generator = &m;
        }
    }
    if (generator) {
        AxisGroup::Element power = group.elements.front();
        for (int k = 1; k < group.order; ++k) {
            for (int& f : power.facets) f = generator->map.facets[f];
            power.steps = k;
            group.elements.push_back(power);
        }
    }
    const AxisMotion* mirror = nullptr;
    for (const AxisMotion& m : motions) {
        if (!m.map.turns_over || m.misfit > largest_misfit || order_of(m.map) != 2) continue;
        if (!mirror || m.misfit < mirror->misfit) mirror = &m;
    }
    if (mirror) {
        group.mirrors = true;
        group.plane = 0.5 * mirror->turn;
        for (int k = 0; k < group.order; ++k) {
            AxisGroup::Element product = group.elements[k];
            for (std::size_t f = 0; f < product.facets.size(); ++f) {
                product.facets[f] = group.elements[k].facets[mirror->map.facets[f]];
            }
            product.mirrored = true;
            group.elements.push_back(std::move(product));
        }
    }
    return group;
}

std::vector<AxisGroup> subgroups_of(const AxisGroup& group) {
    std::vector<AxisGroup> all;
    for (int order = group.order; order >= 1; --order) {
        if (group.order % order != 0) continue;
        const int stride = group.order / order;
        const auto turns = [&] {
            AxisGroup sub;
            sub.order = order;
            for (const AxisGroup::Element& e : group.elements) {
                if (e.mirrored || e.steps % stride != 0) continue;
                sub.elements.push_back({e.facets, e.steps / stride, false});
            }
            return sub;
        };
        for (int first = 0; group.mirrors && first < stride; ++first) {
            AxisGroup sub = turns();
            sub.mirrors = true;
            sub.plane = group.plane + 0.5 * first * k_full_turn / group.order;
            for (const AxisGroup::Element& e : group.elements) {
                if (!e.mirrored || e.steps % stride != first) continue;
                sub.elements.push_back({e.facets, e.steps / stride, true});
            }
            all.push_back(std::move(sub));
        }
        if (order > 1) all.push_back(turns());
    }
    std::stable_sort(all.begin(), all.end(), [](const AxisGroup& a, const AxisGroup& b) {
        return a.elements.size() > b.elements.size();
    });
    return all;
}

std::vector<FacetOrbit> orbits_of(const AxisGroup& group, std::size_t facets) {
    std::vector<FacetOrbit> orbits;
    std::vector<bool> seen(facets, false);
    for (std::size_t f = 0; f < facets; ++f) {
        if (seen[f]) continue;
        FacetOrbit orbit;
        for (const AxisGroup::Element& e : group.elements) {
            const int image = e.facets[f];
            if (e.mirrored && image == static_cast<int>(f) && orbit.own_mirror < 0) {
                orbit.own_mirror = static_cast<int>(&e - group.elements.data());
                orbit.mirror = e;
            }
            if (seen[image]) continue;
            seen[image] = true;
            orbit.facets.push_back(image);
            orbit.from_first.push_back(e);
        }
        orbit.stays = orbit.facets.size() == 1 && group.order > 1;
        orbits.push_back(std::move(orbit));
    }
    return orbits;
}

}  // namespace culet
