#include "fit/model/symmetry_contrasts.h"

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

std::vector<Formula> turn_contrasts(const Shape& mesh, const std::vector<int>& orbit,
                                    double angle) {
    // The mean normal, with all facets turned back to the first.
    Vec3 mean(0);
    for (std::size_t k = 0; k < orbit.size(); ++k) {
        mean += about_axis(mesh.normals[std::size_t(orbit[k])], -angle * double(k));
    }
    const std::array<Vec3, 2> across =
        tangents(glm::length(mean) > 0 ? glm::normalize(mean) : Vec3{0, 0, 1});
    std::vector<Formula> formulas;
    for (std::size_t k = 1; k < orbit.size(); ++k) {
        // Helmert: the sum of the first k minus k times the next.
        const double length = std::sqrt(double(k * (k + 1)));
        for (const Vec3& direction : across) {
            std::vector<std::pair<double, Formula>> terms;
            for (std::size_t i = 0; i <= k; ++i) {
                terms.emplace_back((i < k ? 1.0 : -double(k)) / length,
                                   turned_component(orbit[i], -angle * double(i), direction));
            }
            formulas.push_back(weighted_sum(std::move(terms)));
        }
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
