#include "fit/symmetry_contrasts.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <set>

namespace culet {

namespace {

Vec3 about_axis(const Vec3& v, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x - s * v.y, s * v.x + c * v.y, v.z};
}

}  // namespace

std::vector<Formula> turn_contrasts(const Shape& mesh, const Outline& outline,
                                    const std::vector<int>& orbit, double angle, int centre) {
    const std::size_t count = orbit.size();
    // All facets turned back to the first: the mean of their normals and of their middles.
    Vec3 normal(0), middle(0);
    for (std::size_t k = 0; k < count; ++k) {
        const double back = -angle * double(k);
        normal += about_axis(mesh.normals[std::size_t(orbit[k])], back);
        const std::vector<int>& loop = outline.loops[std::size_t(orbit[k])];
        for (const int c : loop) {
            middle += about_axis(place_of(mesh, outline.corners[std::size_t(c)]), back) /
                      double(loop.size() * count);
        }
    }
    const std::array<Vec3, 2> across =
        tangents(glm::length(normal) > 0 ? glm::normalize(normal) : Vec3{0, 0, 1});
    std::vector<Formula> formulas;
    for (std::size_t k = 1; k < count; ++k) {
        // Helmert: the sum of the first k less k times the next.
        const double length = std::sqrt(double(k * (k + 1)));
        std::array<std::vector<std::pair<double, Formula>>, 3> terms;
        for (std::size_t i = 0; i <= k; ++i) {
            const double weight = (i < k ? 1.0 : -double(k)) / length;
            const double turn = angle * double(i);
            for (std::size_t d = 0; d < 2; ++d) {
                terms[d].emplace_back(weight, turned_component(orbit[i], -turn, across[d]));
            }
            terms[2].emplace_back(weight,
                                  offset_from_axis(orbit[i], about_axis(middle, turn), centre));
        }
        for (auto& one : terms) formulas.push_back(weighted_sum(std::move(one)));
    }
    return formulas;
}

std::vector<std::vector<int>> orbits_of_pairs(const std::vector<std::pair<int, int>>& pairs) {
    std::map<int, int> image;
    for (const auto& [f, g] : pairs) image.emplace(f, g);
    std::set<int> seen;
    std::vector<std::vector<int>> orbits;
    for (const auto& [f, g] : pairs) {
        if (f == g || seen.count(f) > 0) continue;
        std::vector<int> orbit;
        for (int at = f; seen.insert(at).second;) {
            orbit.push_back(at);
            const auto next = image.find(at);
            if (next == image.end()) break;
            at = next->second;
        }
        orbits.push_back(std::move(orbit));
    }
    return orbits;
}

}  // namespace culet
