#include "compare/calibration/hypotheses.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "compare/scores/chance.h"

namespace culet {

namespace {

Spectrum raised(const Spectrum& spectrum, double by) {
    std::vector<double> values = spectrum.values();
    for (double& value : values) value += by;
    if (spectrum.wavelengths_nm().empty()) return Spectrum(values.front());
    return Spectrum(spectrum.wavelengths_nm(), values);
}

double mean_index(const Material& material) {
    double sum = 0;
    const int rays = ray_count(material.optic);
    for (int r = 0; r < rays; ++r) {
        // Two of a uniaxial crystal's three axes are ordinary.
        const double weight = material.optic == OpticCharacter::uniaxial && r == 0 ? 2 : 1;
        sum += weight * material.index[static_cast<std::size_t>(r)].at(k_d_line_nm);
    }
    return sum / (material.optic == OpticCharacter::uniaxial ? 3 : rays);
}

}  // namespace

Stone turned_stone(const Stone& stone, const glm::dmat3& by, const Vec3& about) {
    Stone result = stone;
    for (Vec3& vertex : result.solid.vertices) vertex = about + by * (vertex - about);
    for (Facet& facet : result.solid.facets) {
        Plane& plane = facet.plane;
        const Vec3 normal = by * plane.normal;
        plane.offset += glm::dot(normal, about) - glm::dot(plane.normal, about);
        plane.normal = normal;
    }
    for (Vec3& axis : result.crystal.axes) axis = by * axis;
    result.up = by * result.up;
    return result;
}

bool same_light_from_everywhere(const Lights& lights) {
    return !lights.environment && !lights.polarisation && lights.sources.empty();
}

Material with_index_changed(const Material& material, double by) {
    Material result = material;
    for (RefractiveIndex& index : result.index) {
        switch (index.form) {
            case RefractiveIndex::Form::constant:
                index.n += by;
                break;
            case RefractiveIndex::Form::cauchy:
                index.cauchy[0] += by;
                break;
            case RefractiveIndex::Form::sellmeier: {
                // To first order n^2 rises by 2 n dn at every wavelength.
                index.a0 += 2 * index.at(k_d_line_nm) * by + by * by;
                break;
            }
            case RefractiveIndex::Form::table:
                index.table = raised(index.table, by);
                break;
        }
    }
    return result;
}

Material without_dispersion(const Material& material) {
    Material result = material;
    for (int r = 0; r < ray_count(material.optic); ++r) {
        RefractiveIndex& index = result.index[static_cast<std::size_t>(r)];
        RefractiveIndex flat;
        flat.form = RefractiveIndex::Form::constant;
        flat.n = index.at(k_d_line_nm);
        index = flat;
    }
    return result;
}

Material with_absorption_times(const Material& material, double factor) {
    Material result = material;
    for (Spectrum& spectrum : result.absorption_per_mm) spectrum = spectrum.scaled(factor);
    return result;
}

std::vector<Material> neighbouring_materials(const Material& material, int count) {
    constexpr double k_same_index = 0.002;
    const double here = mean_index(material);
    std::vector<Material> others;
    for (const std::string& name : catalogue_names()) {
        Material other = catalogue_material(name);
        if (std::abs(mean_index(other) - here) < k_same_index) continue;
        // A coloured variety has its mineral's indices: one of them is enough.
        const bool known = std::any_of(others.begin(), others.end(), [&](const Material& m) {
            return std::abs(mean_index(m) - mean_index(other)) < k_same_index;
        });
        if (known) continue;
        other.absorption_per_mm = material.absorption_per_mm;
        if (other.optic != material.optic) {
            // Absorption belongs to the rays of one optical class: use the first ray's for all.
            other.absorption_per_mm.fill(material.absorption_per_mm[0]);
        }
        others.push_back(std::move(other));
    }
    std::stable_sort(others.begin(), others.end(), [&](const Material& a, const Material& b) {
        return std::abs(mean_index(a) - here) < std::abs(mean_index(b) - here);
    });
    others.resize(std::min(others.size(), static_cast<std::size_t>(std::max(0, count))));
    return others;
}

}  // namespace culet
