#include "refine/spin/repeated_facets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>

#include "refine/spin/form_axis.h"
#include "stone/design/drawn_symmetry.h"
#include "stone/design/tiers.h"
#include "stone/numbers/units.h"
#include "stone/numbers/upper_median.h"
#include "stone/solid/perpendicular.h"

namespace culet {

namespace {

// Facets of one orbit differ by less, steps of one side by more: a tilt, and an offset in the
// width.
constexpr double k_one_facet = radians(4.0), k_one_offset = 0.02;
constexpr double k_copied_sigma = radians(2.5);  // tilts that are known worse are not copied
// Facets are cut no more alike: radians, and in the width. With 0.05 degrees, left-out frames of a
// real series (docs/spin.md) lie 0.48 pixels off the stone, with 0.15 and 0.3 degrees 0.44.
constexpr double k_least_tilt = radians(0.15), k_least_offset = 2e-4;
constexpr double k_differs = 3.5;  // sigmas: a facet of its own

struct Member {
    int plane = 0;  // in the result
    FormMotion motion;
    bool is_copy = false;
};
using Orbit = std::vector<Member>;

class Repeated {
public:
    Repeated(const Solid& solid, const std::vector<double>& tilt_sigmas,
             const std::vector<bool>& shown, const CutSymmetry& symmetry)
        : width_(width_along(solid, {1, 0, 0})), motions_(motions_of(symmetry)) {
        std::vector<double> areas;
        Vec3 least(HUGE_VAL), most(-HUGE_VAL);
        for (const Vec3& v : solid.vertices) {
            least = glm::min(least, v);
            most = glm::max(most, v);
        }
        for (std::size_t f = 0; f < solid.facets.size(); ++f) {
            if (!shown[f]) continue;
            found_.planes.push_back({solid.facets[f].name, solid.facets[f].plane});
            planes_.push_back(solid.facets[f].plane);
            sigmas_.push_back(tilt_sigmas[f]);
            areas.push_back(area(solid, solid.facets[f]));
        }
        axis_ = axis_of(planes_, areas, symmetry, 0.5 * (least + most), width_);
        order_.resize(planes_.size());
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::stable_sort(order_.begin(), order_.end(),
                         [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
    }

    std::optional<RepeatedFacets> run() {
        find_orbits();
        if (found_.pairs < k_least_pairs) return std::nullopt;
        estimate_sigmas();
        for (Orbit& orbit : orbits_) add_conditions(orbit);
        found_.is_copy.assign(found_.planes.size(), false);
        for (const Orbit& orbit : orbits_) {
            for (const Member& m : orbit) found_.is_copy[std::size_t(m.plane)] = m.is_copy;
        }
        return std::move(found_);
    }

private:
    bool is_one(const Plane& a, const Plane& b) const {
        return angle_between(a.normal, b.normal) < k_one_facet &&
               std::abs(a.offset - b.offset) < k_one_offset * width_;
    }

    // The shown facet at the image that belongs to no other orbit; -1: none.
    int shown_at(const Plane& image, const std::vector<bool>& taken) const {
        int nearest = -1;
        double least = k_one_facet;
        for (std::size_t p = 0; p < planes_.size(); ++p) {
            if (taken[p] || !is_one(planes_[p], image)) continue;
            const double angle = angle_between(planes_[p].normal, image.normal);
            if (angle >= least) continue;
            least = angle;
            nearest = int(p);
        }
        return nearest;
    }

    void find_orbits() {
        std::vector<bool> taken(planes_.size(), false);
        for (const std::size_t first : order_) {
            if (taken[first]) continue;
            taken[first] = true;
            Orbit orbit{{int(first), motions_[0], false}};
            std::vector<Plane> copies;
            for (std::size_t m = 1; m < motions_.size(); ++m) {
                const Plane image = moved(axis_, motions_[m], planes_[first]);
                const auto is_here = [&](const Plane& plane) { return is_one(plane, image); };
                if (std::any_of(orbit.begin(), orbit.end(), [&](const Member& member) {
                        return is_here(found_.planes[std::size_t(member.plane)].plane);
                    }))
                    continue;
                const int other = shown_at(image, taken);
                if (other >= 0) {
                    taken[std::size_t(other)] = true;
                    orbit.push_back({other, motions_[m], false});
                } else if (sigmas_[first] <= k_copied_sigma &&
                           plane_towards(planes_, image.normal, k_one_facet) < 0) {
                    orbit.push_back({int(found_.planes.size()), motions_[m], true});
                    found_.planes.push_back(
                        {fmt::format("{}s{}", found_.planes[first].name, m), image});
                }
            }
            if (orbit.size() < 2) continue;
            const auto own = std::count_if(orbit.begin(), orbit.end(),
                                           [](const Member& m) { return !m.is_copy; });
            if (own > 1) found_.pairs += int(own);
            orbits_.push_back(std::move(orbit));
        }
    }

    // A shown member, taken back to where its orbit's first is.
    Plane taken_back(const Member& member) const {
        FormMotion back = member.motion;
        if (!back.mirrored) back.turn = -back.turn;
        return moved(axis_, back, planes_[std::size_t(member.plane)]);
    }

    // How far a shown member is from the mean of the others, by two tilts and the offset, as if
    // from the mean of all.
    struct Deviation {
        std::array<double, 3> by{};
        double own_sigma = 0;
    };
    std::vector<Deviation> deviations(const Orbit& orbit) const {
        std::vector<Deviation> all;
        std::vector<Plane> back;
        for (const Member& m : orbit)
            if (!m.is_copy) back.push_back(taken_back(m));
        const double n = double(back.size());
        if (back.size() < 2) return {};
        Vec3 normal{0};
        double offset = 0;
        for (const Plane& p : back) {
            normal += p.normal / n;
            offset += p.offset / n;
        }
        const Vec3 t = perpendicular_to(glm::normalize(normal)),
                   u = glm::cross(glm::normalize(normal), t);
        const double scale = std::sqrt(n / (n - 1));
        std::size_t k = 0;
        for (const Member& m : orbit) {
            if (m.is_copy) continue;
            const Plane& p = back[k++];
            all.push_back({{scale * glm::dot(t, p.normal), scale * glm::dot(u, p.normal),
                            scale * (p.offset - offset)},
                           sigmas_[std::size_t(m.plane)]});
        }
        return all;
    }

    // What facets differ by beyond their own uncertainty: for tilts the most likely value, so that
    // facets which are known best tell most; of offsets no uncertainty is known.
    void estimate_sigmas() {
        std::vector<Deviation> all;
        std::vector<double> offsets;
        for (const Orbit& orbit : orbits_) {
            for (const Deviation& d : deviations(orbit)) {
                all.push_back(d);
                offsets.push_back(std::abs(d.by[2]));
            }
        }
        double most = -HUGE_VAL;
        for (double sigma = k_least_tilt; sigma < k_one_facet; sigma *= 1.05) {
            double likelihood = 0;
            for (const Deviation& d : all) {
                const double variance = sigma * sigma + d.own_sigma * d.own_sigma;
                for (const double off : {d.by[0], d.by[1]})
                    likelihood -= 0.5 * std::log(variance) +
                                  2.5 * std::log1p(off * off / (4 * variance));  // Student's t
            }
            if (likelihood <= most) continue;
            most = likelihood;
            found_.tilt_sigma = sigma;
        }
        found_.offset_sigma =
            std::max(k_least_offset * width_, 1.4826 * upper_median(std::move(offsets)));
    }

    void add_conditions(Orbit& orbit) {
        const std::vector<Deviation> off = deviations(orbit);
        Orbit alike;
        std::size_t k = 0;
        for (const Member& m : orbit) {
            if (!m.is_copy && !off.empty()) {
                const Deviation& d = off[k++];
                const double tilt = std::hypot(found_.tilt_sigma, d.own_sigma);
                if (std::hypot(d.by[0], d.by[1]) > k_differs * tilt ||
                    std::abs(d.by[2]) > k_differs * found_.offset_sigma)
                    continue;
            }
            alike.push_back(m);
        }
        // Pairs of n facets with n times the variance are worth the n facets about their mean.
        const double share = std::sqrt(double(alike.size()));
        for (std::size_t i = 0; i < alike.size(); ++i) {
            for (std::size_t j = i + 1; j < alike.size(); ++j) add_pair(alike[i], alike[j], share);
        }
    }

    // Both planes' normals as they are after they were taken back, and their offsets from the axis.
    void add_pair(const Member& one, const Member& other, double share) {
        const Vec3 place{axis_.x, axis_.y, 0};
        for (const Vec3& along : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
            // Motions keep products: along . back(n) = forth(along) . n.
            const Vec3 a = moved(axis_, one.motion, {along, 0}).normal,
                       b = moved(axis_, other.motion, {along, 0}).normal;
            found_.conditions.push_back(
                {{{one.plane, a, 0}, {other.plane, -b, 0}}, 0, share * found_.tilt_sigma});
        }
        found_.conditions.push_back(
            {{{one.plane, -place, 1}, {other.plane, place, -1}}, 0, share * found_.offset_sigma});
    }

    double width_;
    std::vector<FormMotion> motions_;
    std::vector<Plane> planes_;  // that are shown
    std::vector<double> sigmas_;
    std::vector<std::size_t> order_;  // the largest first
    FormAxis axis_;
    std::vector<Orbit> orbits_;
    RepeatedFacets found_;
};

}  // namespace

std::optional<CutSymmetry> symmetry_of(const Solid& cut) {
    const Vec3 up{0, 0, 1};
    const AxisGroup group = drawn_symmetry(cut, up, table_facet(cut, up)).near;
    if (group.is_trivial()) return std::nullopt;
    return CutSymmetry{group.order, group.mirrors};
}

std::optional<RepeatedFacets> repeated_facets(const Solid& solid,
                                              const std::vector<double>& tilt_sigmas,
                                              const std::vector<bool>& shown,
                                              const CutSymmetry& symmetry) {
    return Repeated(solid, tilt_sigmas, shown, symmetry).run();
}

}  // namespace culet
