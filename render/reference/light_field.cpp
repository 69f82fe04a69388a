#include "render/reference/light_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <map>

namespace culet {

struct LightField::Ready {
    Lights lights;
    std::array<std::vector<double>, 3> primaries;  // only with an environment
    /// A source's radiance at the nodes, and a cap's cosines.
    struct Source {
        std::vector<double> nodes;
        DiscCosines cosines;
        bool is_near = false;
        int number = 0;  ///< among those of its type
    };
    std::vector<Source> sources;
    double brightest = 0;
    int nodes = 1;

    // Calls visit(radiance at a node, polarisation) for every visible light.
    template <class Visit>
    void each_seen(const Vec3& origin, const Vec3& direction, Visit&& visit) const;

    // Part of a light's radiance that comes from a direction; of near ones, if it is met.
    double share(std::size_t i, const Vec3& direction) const {
        return std::visit(
            [&](const auto& light) -> double {
                using L = std::decay_t<decltype(light)>;
                if constexpr (std::is_same_v<L, DiscLight>) {
                    return share_of(light, sources[i].cosines, direction);
                } else if constexpr (L::k_is_near && !std::is_same_v<L, LampLight>) {
                    return 1;
                } else {
                    return share_of(light, direction);
                }
            },
            lights.sources[i]);
    }
    // The nearest near light; -1 for none.
    int nearest(const Vec3& origin, const Vec3& direction, double& distance) const {
        int best = -1;
        distance = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < sources.size(); ++i) {
            if (!sources[i].is_near) continue;
            const double d = std::visit(
                [&](const auto& light) -> double {
                    if constexpr (std::decay_t<decltype(light)>::k_is_near) {
                        return distance_to(light, origin, direction);
                    } else {
                        return std::numeric_limits<double>::infinity();
                    }
                },
                lights.sources[i]);
            if (d < distance) {
                distance = d;
                best = static_cast<int>(i);
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
    std::map<std::size_t, int> count;  // of each type
    for (const Light& light : lights.sources) {
        Ready::Source& source = r.sources.emplace_back();
        source.nodes = radiance_of(colour_of(light), wavelengths);
        source.is_near = is_near(light);
        source.number = count[light.index()]++;
        if (const auto* cap = std::get_if<DiscLight>(&light)) source.cosines = cosines_of(*cap);
        const double most = *std::max_element(source.nodes.begin(), source.nodes.end());
        if (source.is_near) {
            near = std::max(near, most);
        } else {
            far += most;
        }
    }
    if (lights.environment) {
        float most = 0;
        for (float v : lights.environment->rgb) most = std::max(most, v);
        // A texel's spectrum is at most its brightest channel times the positive parts of the
        // primaries.
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

template <class Visit>
void LightField::Ready::each_seen(const Vec3& origin, const Vec3& direction, Visit&& visit) const {
    const auto pass = [&](std::size_t i, double factor) {
        const std::vector<double>& nodes_of_light = sources[i].nodes;
        visit([&nodes_of_light, factor](int node) { return factor * nodes_of_light[node]; },
              colour_of(lights.sources[i]).polarisation);
    };
    double distance = 0;
    if (const int near = nearest(origin, direction, distance); near >= 0) {
        return pass(std::size_t(near), share(std::size_t(near), direction));
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
    for (std::size_t i = 0; i < sources.size(); ++i) {
        if (sources[i].is_near) continue;
        if (const double factor = share(i, direction); factor > 0) pass(i, factor);
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
    const auto name_of = [&r](std::size_t i) {
        const char* type = std::visit([](const auto& l) { return l.k_name; }, r.lights.sources[i]);
        return fmt::format("{} {}", type, r.sources[i].number);
    };
    double distance = 0;
    const int near = r.nearest(origin, direction, distance);
    if (near >= 0) return name_of(std::size_t(near));
    std::string names;
    const auto name = [&names](const std::string& word) {
        names += (names.empty() ? "" : " + ") + word;
    };
    if (r.lights.environment) name("environment");
    if (r.lights.constant > 0) name("constant");
    for (std::size_t i = 0; i < r.sources.size(); ++i) {
        if (!r.sources[i].is_near && r.share(i, direction) > 0) name(name_of(i));
    }
    return names.empty() ? "dark" : names;
}

double LightField::max_radiance() const {
    return ready_->brightest;
}

}  // namespace culet
