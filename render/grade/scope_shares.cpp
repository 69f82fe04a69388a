#include "render/grade/scope_shares.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "render/scene/light_presets.h"
#include "stone/numbers/units.h"

namespace culet {

namespace {

// Sums by band of the light seen through one facet (-1: all), and the remainder to 1.
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

AsetShares aset_shares(const EyeLight& light, int facet, const ScopeBands& bands) {
    const BandSum sum = sum_of(light, bands, facet);
    return {at(sum, ScopeBand::inner), at(sum, ScopeBand::middle) + at(sum, ScopeBand::rim),
            at(sum, ScopeBand::eye), at(sum, ScopeBand::below) + sum.left};
}

TableReflection table_reflection(const EyeLight& light, int table) {
    constexpr int k_faces = 4;  // the table, two of the pavilion, the table
    TableReflection reflection;
    double table_area = 0, largest = 0;
    for (const EyeFront& front : light.fronts)
        if (front.facet == table) table_area += front.area;
    for (const EyeExit& exit : light.exits) {
        const EyeFront& front = light.fronts[static_cast<std::size_t>(exit.front)];
        if (exit.faces != k_faces || exit.facet != table || front.facet != table) continue;
        const double share = exit.area * exit.weight;
        if (!(share > 0)) continue;
        reflection.share += share;
        if (share <= largest) continue;
        largest = share;
        reflection.elevation = std::asin(glm::dot(exit.direction, light.towards_eye));
    }
    if (table_area > 0) reflection.share /= table_area;
    if (!(largest > 0)) return reflection;
    switch (aset_bands().of(std::sin(reflection.elevation))) {
        case ScopeBand::eye:
            reflection.colour = "blue";
            break;
        case ScopeBand::inner:
            reflection.colour = "red";
            break;
        case ScopeBand::middle:
        case ScopeBand::rim:
            reflection.colour = "green";
            break;
        case ScopeBand::below:
            reflection.colour = "dark";
            break;
    }
    return reflection;
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
