#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "render/path.h"
#include "render/scene.h"
#include "stone/least_rotation.h"
#include "stone/perpendicular.h"

namespace culet {

Rgb EnvironmentMap::at(const Vec3& direction) const {
    // Top row +z; the middle column +x; azimuth grows to the left as seen from inside, which is to
    // smaller columns.
    const double azimuth = std::atan2(direction.y, direction.x);
    const double polar = std::acos(std::clamp(direction.z, -1.0, 1.0));
    const double column = (0.5 - azimuth / (2 * std::numbers::pi)) * width - 0.5;
    const double row = std::clamp(polar / std::numbers::pi * height - 0.5, 0.0, height - 1.0);
    const double x0 = std::floor(column), y0 = std::floor(row);
    const double u = column - x0, v = row - y0;
    const auto texel = [&](double x, double y) {
        const int i = ((static_cast<int>(x) % width) + width) % width;
        const int j = std::min(static_cast<int>(y), height - 1);
        return rgb.data() + 3 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(i));
    };
    const float *a = texel(x0, y0), *b = texel(x0 + 1, y0), *c = texel(x0, y0 + 1),
                *d = texel(x0 + 1, y0 + 1);
    Rgb result;
    for (int k = 0; k < 3; ++k) {
        result[k] = (1 - v) * ((1 - u) * a[k] + u * b[k]) + v * ((1 - u) * c[k] + u * d[k]);
    }
    return result;
}

std::vector<double> radiance_of(const LightColour& colour, const WavelengthSet& wavelengths) {
    if (const double* number = std::get_if<double>(&colour.value)) {
        return std::vector<double>(wavelengths.wavelengths_nm().size(), *number);
    }
    if (const Rgb* rgb = std::get_if<Rgb>(&colour.value)) return wavelengths.spectrum_of(*rgb);
    return wavelengths.illuminant_relative(std::get<std::string>(colour.value).c_str());
}

CapCosines cosines_of(const CapLight& cap) {
    // Whole discs and half spaces include their limits: a cap of 180 degrees is everywhere.
    return {cap.from <= 0 ? 2.0 : std::cos(cap.from),
            cap.to >= std::numbers::pi ? -2.0 : std::cos(cap.to)};
}

namespace {

// Distance along a ray to a sphere, or infinity; from inside, to the far side: a dome shines
// inwards.
double distance_to(const SphereLight& sphere, const Vec3& origin, const Vec3& direction) {
    const Vec3 to = sphere.center - origin;
    const double along = glm::dot(to, direction);
    const Vec3 beside = to - along * direction;
    const double half_squared = sphere.radius * sphere.radius - glm::dot(beside, beside);
    if (half_squared < 0) return std::numeric_limits<double>::infinity();
    const double half = std::sqrt(half_squared);
    const double distance = along - half > 0 ? along - half : along + half;
    return distance > 0 ? distance : std::numeric_limits<double>::infinity();
}

// The lit side only: from behind, a plane is not there.
double distance_to(const PlaneLight& plane, const Vec3& origin, const Vec3& direction) {
    const double towards = glm::dot(direction, plane.normal);
    const double height = glm::dot(origin - plane.point, plane.normal);
    if (!(towards < 0) || !(height > 0)) return std::numeric_limits<double>::infinity();
    const double distance = -height / towards;
    if (plane.u && plane.v) {
        // The two half-extents need not be at right angles: coordinates in their own frame.
        const Vec3 at = origin + distance * direction - plane.point;
        const double uu = glm::dot(*plane.u, *plane.u), vv = glm::dot(*plane.v, *plane.v);
        const double uv = glm::dot(*plane.u, *plane.v), au = glm::dot(at, *plane.u),
                     av = glm::dot(at, *plane.v);
        const double determinant = uu * vv - uv * uv;
        const double s = (au * vv - av * uv) / determinant, t = (av * uu - au * uv) / determinant;
        if (std::abs(s) > 1 || std::abs(t) > 1) return std::numeric_limits<double>::infinity();
    }
    return distance;
}

}  // namespace

Vec3 LinearPolarisation::of_ray(const Vec3& direction) const {
    if (!normal) {
        const Vec3 across = vibration - glm::dot(vibration, direction) * direction;
        const double length = glm::length(across);
        return length > 0 ? across / length : perpendicular_to(direction);
    }
    const Vec3 from = glm::dot(*normal, direction) < 0 ? -*normal : *normal;
    // A sheet's direction lies in it: what a scene's rounding left along the normal is dropped.
    const Vec3 in_sheet = glm::normalize(vibration - glm::dot(vibration, from) * from);
    return turned_with(from, direction, in_sheet);
}

bool polarised(const Lights& lights) {
    const auto any = [](const auto& list) {
        return std::any_of(list.begin(), list.end(), [](const auto& light) {
            return light.radiance.polarisation.has_value();
        });
    };
    return lights.polarisation || any(lights.spheres) || any(lights.lobes) ||
           any(lights.hemispheres) || any(lights.caps) || any(lights.planes);
}

struct LightField::Ready {
    Lights lights;
    std::array<std::vector<double>, 3> primaries;  // where there is an environment
    std::vector<std::vector<double>> spheres, lobes, hemispheres, caps, planes;
    std::vector<CapCosines> cap_cosines;
    double brightest = 0;
    int nodes = 1;

    // Calls visit(radiance at a node, polarisation) for every light that is seen.
    template <class Visit>
    void each_seen(const Vec3& origin, const Vec3& direction, Visit&& visit) const;

    // Nearest near light: spheres count from 0, planes after them; -1 for none.
    int nearest(const Vec3& origin, const Vec3& direction) const {
        double distance = 0;
        return nearest(origin, direction, distance);
    }
    int nearest(const Vec3& origin, const Vec3& direction, double& distance) const {
        int best = -1;
        distance = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < lights.spheres.size(); ++i) {
            const double d = distance_to(lights.spheres[i], origin, direction);
            if (d < distance) {
                distance = d;
                best = static_cast<int>(i);
            }
        }
        for (std::size_t i = 0; i < lights.planes.size(); ++i) {
            const double d = distance_to(lights.planes[i], origin, direction);
            if (d < distance) {
                distance = d;
                best = static_cast<int>(lights.spheres.size() + i);
            }
        }
        return best;
    }
};

LightField::LightField(const Lights& lights, const WavelengthSet& wavelengths) : ready_(new Ready) {
    Ready& r = *ready_;
    r.lights = lights;
    if (lights.environment) r.primaries = wavelengths.primaries();
    r.nodes = wavelengths.size();
    double far = lights.constant, near = 0;
    const auto take = [&](const auto& list, std::vector<std::vector<double>>& nodes, bool is_near) {
        for (const auto& light : list) {
            nodes.push_back(radiance_of(light.radiance, wavelengths));
            const double most = *std::max_element(nodes.back().begin(), nodes.back().end());
            if (is_near) {
                near = std::max(near, most);
            } else {
                far += most;
            }
        }
    };
    take(lights.spheres, r.spheres, true);
    take(lights.planes, r.planes, true);
    take(lights.lobes, r.lobes, false);
    take(lights.hemispheres, r.hemispheres, false);
    take(lights.caps, r.caps, false);
    for (const CapLight& cap : lights.caps) r.cap_cosines.push_back(cosines_of(cap));
    if (lights.environment) {
        float most = 0;
        for (float v : lights.environment->rgb) most = std::max(most, v);
        // A texel's spectrum is at most its brightest channel times the primaries above 0.
        double gain = 0;
        for (int i = 0; i < r.nodes; ++i) {
            double sum = 0;
            for (const auto& primary : r.primaries) sum += std::max(primary[i], 0.0);
            gain = std::max(gain, sum);
        }
        far += most * gain;
    }
    r.brightest = std::max(far, near);
}

LightField::~LightField() = default;
LightField::LightField(LightField&&) noexcept = default;

template <class Visit>
void LightField::Ready::each_seen(const Vec3& origin, const Vec3& direction, Visit&& visit) const {
    const auto pass = [&](const std::vector<double>& nodes_of_light, double factor,
                          const std::optional<LinearPolarisation>& polarisation) {
        visit([&nodes_of_light, factor](int node) { return factor * nodes_of_light[node]; },
              polarisation);
    };
    const int near = nearest(origin, direction);
    if (near >= 0) {
        const int count = static_cast<int>(spheres.size());
        if (near < count) {
            pass(spheres[near], 1, lights.spheres[near].radiance.polarisation);
        } else {
            pass(planes[near - count], 1, lights.planes[near - count].radiance.polarisation);
        }
        return;
    }
    if (lights.constant > 0) visit([this](int) { return lights.constant; }, lights.polarisation);
    if (lights.environment) {
        const Rgb rgb = lights.environment->at(direction);
        visit(
            [this, &rgb](int node) {
                return rgb[1] + (rgb[0] - rgb[1]) * primaries[0][node] +
                       (rgb[2] - rgb[1]) * primaries[2][node];
            },
            lights.polarisation);
    }
    for (std::size_t l = 0; l < lobes.size(); ++l) {
        const LobeLight& lobe = lights.lobes[l];
        const double cosine = glm::dot(direction, lobe.direction);
        if (cosine > 0) pass(lobes[l], std::pow(cosine, lobe.exponent), lobe.radiance.polarisation);
    }
    for (std::size_t l = 0; l < hemispheres.size(); ++l) {
        const HemisphereLight& half = lights.hemispheres[l];
        if (glm::dot(direction, half.direction) > 0)
            pass(hemispheres[l], 1, half.radiance.polarisation);
    }
    for (std::size_t l = 0; l < caps.size(); ++l) {
        const double cosine = glm::dot(direction, lights.caps[l].direction);
        if (cosine <= cap_cosines[l].from && cosine > cap_cosines[l].to)
            pass(caps[l], 1, lights.caps[l].radiance.polarisation);
    }
}

void LightField::add_radiance(const Vec3& origin, const Vec3& direction, double weight, int first,
                              int count, double* radiance) const {
    ready_->each_seen(origin, direction, [&](const auto& at_node, const auto&) {
        for (int i = 0; i < count; ++i) radiance[i] += weight * at_node(first + i);
    });
}

void LightField::add_stokes(const PathEnd& end, int first, int count, double* stokes,
                            int stride) const {
    const Stokes of_unpolarised = stokes_of_unpolarised(end.coherency);
    ready_->each_seen(end.at, end.direction, [&](const auto& at_node, const auto& polarisation) {
        Stokes seen = of_unpolarised;
        if (polarisation) {
            const Vec3 vibration = polarisation->of_ray(end.direction);
            const Stokes linear = stokes_of_linear(end.coherency, glm::dot(vibration, end.u),
                                                   glm::dot(vibration, end.v));
            for (int k = 0; k < 4; ++k)
                seen[k] += polarisation->degree * (linear[k] - of_unpolarised[k]);
        }
        for (int i = 0; i < count; ++i) {
            const double radiance = end.transmitted[i] * at_node(first + i);
            for (int k = 0; k < 4; ++k) stokes[k * stride + first + i] += seen[k] * radiance;
        }
    });
}

void LightField::add_direct_stokes(const EyeRay& ray, const EyeFrame& frame, int nodes,
                                   double* stokes) const {
    PathEnd end{ray.origin, ray.direction, frame.x, frame.y, EyeCoherency::of_eye(), {}};
    end.transmitted.fill(1.0);
    for (int first = 0; first < nodes; first += k_band_nodes)
        add_stokes(end, first, std::min(k_band_nodes, nodes - first), stokes, nodes);
}

double LightField::nearest_distance(const Vec3& origin, const Vec3& direction) const {
    double distance = 0;
    ready_->nearest(origin, direction, distance);
    return distance;
}

std::string LightField::name_at(const Vec3& origin, const Vec3& direction) const {
    const Ready& r = *ready_;
    const int near = r.nearest(origin, direction);
    const int spheres = static_cast<int>(r.spheres.size());
    if (near >= spheres) return "plane " + std::to_string(near - spheres);
    if (near >= 0) return "sphere " + std::to_string(near);
    std::string names;
    const auto name = [&names](const std::string& word) {
        names += (names.empty() ? "" : " + ") + word;
    };
    if (r.lights.environment) name("environment");
    if (r.lights.constant > 0) name("constant");
    const auto lit = [&](const auto& list, const char* word, const auto& meets) {
        for (std::size_t l = 0; l < list.size(); ++l) {
            if (meets(l)) name(word + std::to_string(l));
        }
    };
    lit(r.lobes, "lobe ",
        [&](std::size_t l) { return glm::dot(direction, r.lights.lobes[l].direction) > 0; });
    lit(r.hemispheres, "hemisphere ",
        [&](std::size_t l) { return glm::dot(direction, r.lights.hemispheres[l].direction) > 0; });
    lit(r.caps, "cap ", [&](std::size_t l) {
        const double cosine = glm::dot(direction, r.lights.caps[l].direction);
        return cosine <= r.cap_cosines[l].from && cosine > r.cap_cosines[l].to;
    });
    return names.empty() ? "dark" : names;
}

double LightField::max_radiance() const {
    return ready_->brightest;
}

}  // namespace culet
