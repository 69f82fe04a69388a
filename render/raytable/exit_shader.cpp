#include "render/raytable/exit_shader.h"

#include <algorithm>
#include <cmath>

#include "render/raytable/octahedral_codes.h"
#include "render/reference/light_field.h"

namespace culet {

namespace {

Vec3 vector_of(const std::array<double, 3>& v) {
    return {v[0], v[1], v[2]};
}

// Mean of the corners of the facets' frames.
Vec3 middle_of(const RayTable& table) {
    Vec3 sum(0);
    for (const FacetFrame& frame : table.parts().frames) sum += vector_of(frame.corner);
    return sum / static_cast<double>(table.header().facets);
}

// Absorption per step of each path length, at the nodes of a band.
ExitAbsorption absorption_of(const Band& band, const RayTableHeader& header) {
    ExitAbsorption absorption;
    for (std::uint32_t k = 0; band.absorbs && k < header.lengths; ++k) {
        for (int node = 0; node < band.count; ++node) {
            absorption[k].push_back(
                static_cast<float>(band.absorption[k][node] * header.length_step));
        }
    }
    return absorption;
}

// Drops the path lengths if nothing is absorbed.
ExitRun with_lengths_if(bool absorbs, ExitRun run) {
    if (!absorbs) run.length = {};
    return run;
}

class FastShader : public ExitShader {
public:
    FastShader(const Scene& scene, const TableRays& rays, const WavelengthSet& colours,
               const RayTable& table)
        : middle_(middle_of(table)) {
        for (const Band& band : rays.setup.bands) {
            lights_.emplace_back(scene.lights, colours, band, middle_);
            absorption_.push_back(absorption_of(band, table.header()));
        }
        frames_.facets = static_cast<int>(table.header().facets);
        const auto put = [&](std::array<double, 3> FacetFrame::*vector, const Vec3& less) {
            for (int axis = 0; axis < 3; ++axis) {
                for (const FacetFrame& frame : table.parts().frames)
                    frames_.numbers.push_back(
                        static_cast<float>((frame.*vector)[axis] - less[axis]));
            }
        };
        put(&FacetFrame::corner, middle_);
        put(&FacetFrame::u, Vec3(0));
        put(&FacetFrame::v, Vec3(0));
    }

    double exits(std::size_t band, const ExitRun& run, float* radiance, int stride) const override {
        return shade_exits(lights_[band], frames_,
                           with_lengths_if(!absorption_[band][0].empty(), run), absorption_[band],
                           radiance, stride);
    }
    void rays(std::size_t band, const AirRays& rays, float* radiance, int stride) const override {
        shade_rays(lights_[band], rays, radiance, stride);
    }
    void nearest(const AirRays& rays, float* distance) const override {
        nearest_lights(lights_.front(), rays, distance);
    }
    Vec3 middle() const override { return middle_; }

private:
    Vec3 middle_;
    std::vector<ExitLights> lights_;
    std::vector<ExitAbsorption> absorption_;
    ExitFrames frames_;
};

class PlainShader : public ExitShader {
public:
    PlainShader(const TableRays& rays, const Surroundings& surroundings, const RayTable& table)
        : bands_(rays.setup.bands), surroundings_(surroundings), table_(table) {}

    double exits(std::size_t number, const ExitRun& run, float* radiance,
                 int stride) const override {
        const Band& band = bands_[number];
        double weighed = 0;
        for (int i = 0; i < run.count; ++i) {
            const FacetFrame& frame = table_.parts().frames[run.facet[i]];
            const Vec3 at = vector_of(frame.corner) +
                            run.point[0][i] / 65535.0 * vector_of(frame.u) +
                            run.point[1][i] / 65535.0 * vector_of(frame.v);
            NodeWeights seen{};
            surroundings_.add_radiance(
                at, octahedral_direction({run.direction[0][i], run.direction[1][i]}),
                static_cast<double>(run.weight[i]), band.first, band.count, seen.data());
            for (int node = 0; node < band.count; ++node) {
                double exponent = 0;
                for (std::size_t k = 0; band.absorbs && k < 3; ++k) {
                    if (run.length[k] != nullptr)
                        exponent -= band.absorption[k][node] * run.length[k][i];
                }
                const double tau = std::exp(exponent * table_.header().length_step);
                weighed += tau * static_cast<double>(run.weight[i]);
                radiance[node * stride + i] = static_cast<float>(tau * seen[node]);
            }
        }
        return weighed / band.count;
    }
    void rays(std::size_t number, const AirRays& rays, float* radiance, int stride) const override {
        const Band& band = bands_[number];
        for (int i = 0; i < rays.count; ++i) {
            NodeWeights seen{};
            surroundings_.add_radiance(vector(rays.origin, i),
                                       glm::normalize(vector(rays.direction, i)), 1.0, band.first,
                                       band.count, seen.data());
            for (int node = 0; node < band.count; ++node)
                radiance[node * stride + i] = static_cast<float>(seen[node]);
        }
    }
    void nearest(const AirRays& rays, float* distance) const override {
        for (int i = 0; i < rays.count; ++i) {
            distance[i] = static_cast<float>(surroundings_.nearest_distance(
                vector(rays.origin, i), glm::normalize(vector(rays.direction, i))));
        }
    }
    Vec3 middle() const override { return Vec3(0); }

private:
    static Vec3 vector(const std::array<std::vector<float>, 3>& of, int i) {
        const auto at = static_cast<std::size_t>(i);
        return {of[0][at], of[1][at], of[2][at]};
    }

    const std::vector<Band>& bands_;
    const Surroundings& surroundings_;
    const RayTable& table_;
};

}  // namespace

std::unique_ptr<const ExitShader> exit_shader(const Scene& scene, const TableRays& rays,
                                              const WavelengthSet& colours,
                                              const Surroundings& surroundings,
                                              const RayTable& table, ExitPrecision precision) {
    // True if there are only lights around the stone.
    const bool lights_alone = dynamic_cast<const LightField*>(&surroundings) != nullptr;
    if (precision == ExitPrecision::fastest && lights_alone && !ExitLights::too_many(scene.lights))
        return std::make_unique<FastShader>(scene, rays, colours, table);
    return std::make_unique<PlainShader>(rays, surroundings, table);
}

}  // namespace culet
