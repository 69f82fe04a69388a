#include "render/grade/light_return.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace culet {

namespace {

// Cosine from which a facet counts as facing the eye (GemRay's `facettype`).
constexpr double k_facing = 1e-4;

// Adds the contribution of light that exits along `direction` to every model.
void add(LightReturn& sum, double share, const Vec3& direction, const EyeLight& light,
         double cos_head, const RandomSky& sky) {
    const double d = glm::dot(direction, light.towards_eye);
    if (!(d > 0)) return;
    sum[static_cast<std::size_t>(LightModel::wlr)] += share * d * d;
    if (d > cos_head) return;
    const double sc2 = 2 * d * std::sqrt(std::max(0.0, 1 - d * d));
    sum[static_cast<std::size_t>(LightModel::iso)] += share;
    sum[static_cast<std::size_t>(LightModel::cos)] += share * d;
    sum[static_cast<std::size_t>(LightModel::sc2)] += share * sc2;
    sum[static_cast<std::size_t>(LightModel::random)] +=
        share * sc2 *
        sky.radiance({glm::dot(direction, light.right), glm::dot(direction, light.up), d});
}

}  // namespace

const char* name_of(LightModel model) {
    switch (model) {
        case LightModel::iso:
            return "iso";
        case LightModel::cos:
            return "cos";
        case LightModel::sc2:
            return "sc2";
        case LightModel::random:
            return "random";
        case LightModel::wlr:
            return "wlr";
    }
    return "";
}

ViewReturn light_return(const EyeLight& light, int table, double head, const RandomSky& sky) {
    const double cos_head = std::cos(head);
    std::vector<LightReturn> by_front(light.fronts.size(), LightReturn{});
    for (const EyeExit& exit : light.exits) {
        if (exit.weight > 0)
            add(by_front[static_cast<std::size_t>(exit.front)], exit.area * exit.weight,
                exit.direction, light, cos_head, sky);
    }
    ViewReturn result;
    double table_area = 0;
    for (std::size_t i = 0; i < light.fronts.size(); ++i) {
        const EyeFront& front = light.fronts[i];
        const Vec3 normal = glm::normalize(front.reflected + light.towards_eye);
        if (glm::dot(normal, light.towards_eye) > k_facing) {
            LightReturn outer{};
            add(outer, front.area * front.reflectance, front.reflected, light, cos_head, sky);
            outer[static_cast<std::size_t>(LightModel::wlr)] = 0;
            for (std::size_t m = 0; m < outer.size(); ++m) by_front[i][m] += outer[m];
        }
        for (std::size_t m = 0; m < result.whole.size(); ++m) result.whole[m] += by_front[i][m];
        if (front.facet != table) continue;
        table_area += front.area;
        for (std::size_t m = 0; m < result.table.size(); ++m) result.table[m] += by_front[i][m];
    }
    for (double& value : result.whole) value /= light.area;
    for (double& value : result.table) value = table_area > 0 ? value / table_area : 0;
    return result;
}

WeightedReturn weighted_return(const EyeLight& light) {
    const double weight = light.towards_eye.z * light.towards_eye.z;
    WeightedReturn part{0, weight * light.area};
    for (const EyeExit& exit : light.exits) {
        if (exit.weight > 0 && exit.direction.z > 0)
            part.returned += weight * exit.area * exit.weight;
    }
    return part;
}

LightBalance light_balance(const EyeLight& light, const std::vector<bool>& crown,
                           const BalanceCones& cones) {
    const double cos_head = std::cos(cones.head), cos_view = std::cos(cones.view_cone);
    LightBalance sum;
    for (const EyeFront& front : light.fronts) {
        sum.entry_reflection += front.area * front.reflectance;
        sum.residual += front.residual;
    }
    for (const EyeExit& exit : light.exits) {
        const double share = exit.area * exit.weight;
        if (!crown[static_cast<std::size_t>(exit.facet)]) {
            sum.leak += share;
            continue;
        }
        const double d = glm::dot(exit.direction, light.towards_eye);
        double& part = d > cos_head ? sum.head : d >= cos_view ? sum.useful : sum.other;
        part += share;
    }
    for (double* part :
         {&sum.useful, &sum.head, &sum.other, &sum.leak, &sum.entry_reflection, &sum.residual})
        *part /= light.area;
    return sum;
}

}  // namespace culet
