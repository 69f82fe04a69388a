#include "render/grade/scope_shares.h"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "render/scene/light_presets.h"
#include "stone/units.h"

namespace culet {

namespace {

// Shares by band, and what is left to 1, of what is seen through one facet (-1: all).
struct BandSum {
    BandShares shares{};
    double left = 0;
};

BandSum sum_of(const EyeLight& light, const ScopeBands& bands, int facet) {
    BandSum sum;
    double area = 0;
    std::vector<char> counted(light.fronts.size(), 0);
    const auto add = [&](const Vec3& direction, double share) {
        sum.shares[static_cast<std::size_t>(bands.of(glm::dot(direction, light.towards_eye)))] +=
            share;
    };
    for (std::size_t i = 0; i < light.fronts.size(); ++i) {
        const EyeFront& front = light.fronts[i];
        if (facet >= 0 && front.facet != facet) continue;
        counted[i] = 1;
        area += front.area;
        add(front.reflected, front.area * front.reflectance);
        sum.left += front.residual;
    }
    if (!(area > 0)) return {};
    for (const EyeExit& exit : light.exits) {
        if (exit.weight > 0 && counted[static_cast<std::size_t>(exit.front)] != 0)
            add(exit.direction, exit.area * exit.weight);
    }
    for (double& share : sum.shares) share /= area;
    sum.left /= area;
    return sum;
}

double at(const BandSum& sum, ScopeBand band) {
    return sum.shares[static_cast<std::size_t>(band)];
}

}  // namespace

ScopeBand ScopeBands::of(double cosine) const {
    if (!(cosine > 0)) return ScopeBand::below;
    if (cosine > std::cos(eye)) return ScopeBand::eye;
    if (cosine > std::cos(inner)) return ScopeBand::inner;
    return cosine > std::cos(middle) ? ScopeBand::middle : ScopeBand::rim;
}

ScopeBands aset_bands() {
    return {radians(k_aset_blue_deg), radians(k_aset_red_deg), radians(90)};
}

ScopeBands reflector_bands(bool hearts) {
    const double eye = radians(hearts ? k_hearts_eye_deg : k_scope_eye_deg);
    return {eye, eye, radians(k_scope_rim_deg)};
}

AsetShares aset_shares(const EyeLight& light, int facet) {
    const BandSum sum = sum_of(light, aset_bands(), facet);
    return {at(sum, ScopeBand::inner), at(sum, ScopeBand::middle) + at(sum, ScopeBand::rim),
            at(sum, ScopeBand::eye), at(sum, ScopeBand::below) + sum.left};
}

ScopeShares ideal_scope_shares(const EyeLight& light) {
    const BandSum sum = sum_of(light, reflector_bands(), -1);
    return {at(sum, ScopeBand::inner) + at(sum, ScopeBand::middle),
            at(sum, ScopeBand::eye) + at(sum, ScopeBand::rim) + sum.left,
            at(sum, ScopeBand::below)};
}

double dark_field_share(const EyeLight& light) {
    const double from = std::cos(radians(k_darkfield_from_deg));
    const double to = std::cos(radians(k_darkfield_to_deg));
    double sum = 0;
    for (const EyeExit& exit : light.exits) {
        const double down = -glm::dot(exit.direction, light.towards_eye);
        if (exit.weight > 0 && down <= from && down >= to) sum += exit.area * exit.weight;
    }
    return sum / light.area;
}

}  // namespace culet
