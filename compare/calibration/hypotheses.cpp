#include "compare/calibration/hypotheses.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "compare/calibration/chance.h"

namespace culet {

namespace {

constexpr double k_sodium_nm = 589.3;

void turn(LinearPolarisation& polarisation, const glm::dmat3& by) {
    polarisation.vibration = by * polarisation.vibration;
    if (polarisation.normal) polarisation.normal = by * *polarisation.normal;
}

void turn(LightColour& colour, const glm::dmat3& by) {
    if (colour.polarisation) turn(*colour.polarisation, by);
}

// The direction that texel (x, y) looks at, see the frame of `EnvironmentMap`.
Vec3 direction_of(const EnvironmentMap& map, int x, int y) {
    const double polar = std::numbers::pi * (y + 0.5) / map.height;
    const double azimuth = 2 * std::numbers::pi * (0.5 - (x + 0.5) / map.width);
    return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
            std::cos(polar)};
}

EnvironmentMap turned_map(const EnvironmentMap& map, const glm::dmat3& by) {
    EnvironmentMap result{map.width, map.height, {}};
    result.rgb.reserve(map.rgb.size());
    const glm::dmat3 back = glm::transpose(by);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const Rgb colour = map.at(back * direction_of(map, x, y));
            for (const double c : colour) result.rgb.push_back(static_cast<float>(c));
        }
    }
    return result;
}

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
        sum += weight * material.index[static_cast<std::size_t>(r)].at(k_sodium_nm);
    }
    return sum / (material.optic == OpticCharacter::uniaxial ? 3 : rays);
}

struct TurnPart {
    const glm::dmat3& by;
    const Vec3& about;
    void point(Vec3& p) const { p = about + by * (p - about); }
    void direction(Vec3& d) const { d = by * d; }
    void extent(std::optional<Vec3>& e) const {
        if (e) *e = by * *e;
    }
    void number(double&) const {}
};

}  // namespace

Lights turned_lights(const Lights& lights, const glm::dmat3& by, const Vec3& about) {
    Lights result = lights;
    if (lights.environment) {
        result.environment =
            std::make_shared<const EnvironmentMap>(turned_map(*lights.environment, by));
    }
    if (result.polarisation) turn(*result.polarisation, by);
    for (Light& light : result.sources) {
        std::visit([&](auto& l) { l.each_part(l, TurnPart{by, about}); }, light);
        turn(colour_of(light), by);
    }
    return result;
}

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
                // To first order n^2 rises by 2 n dn at every wavelength alike.
                index.a0 += 2 * index.at(k_sodium_nm) * by + by * by;
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
        flat.n = index.at(k_sodium_nm);
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
            // Absorption belongs to the rays of a class: the first ray's serves for all.
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
