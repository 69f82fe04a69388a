#include "render/setup/a_priori.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/setup/probe_wavelengths.h"

namespace culet {

bool same_light_everywhere(const Lights& lights) {
    return !lights.environment && lights.sources.empty() && !lights.polarisation;
}

IndexSpans index_spans(const Scene& scene) {
    const Material& material = scene.stone.material;
    const int rays = ray_count(material.optic);
    IndexSpans spans;
    double low = 1e300, high = 0;
    for (int ray = 0; ray < rays; ++ray) {
        const double n = material.index[ray].at(k_d_line_nm) / scene.immersion;
        low = std::min(low, n);
        high = std::max(high, n);
        double least = 1e300, most = 0;
        for (const double nm : even_nodes(k_probes)) {
            const double there = material.index[ray].at(nm) / scene.immersion;
            least = std::min(least, there);
            most = std::max(most, there);
        }
        spans.dispersion = std::max(spans.dispersion, most - least);
    }
    spans.birefringence = high - low;
    spans.mean = 0.5 * (low + high);
    return spans;
}

double exit_deviation(double span, double index) {
    return index > 1 ? span * index / std::sqrt((index - 1) * (index + 1)) : span;
}

double pixel_on_stone(const Scene& scene) {
    const Camera& camera = scene.camera;
    if (camera.orthographic_width) return *camera.orthographic_width / camera.width;
    return 2 * std::tan(camera.fov / 2) / camera.height *
           glm::length(camera.position - centroid(scene.stone.solid));
}

double images_apart(const Scene& scene, double index, double birefringence) {
    const double angle = birefringence * (1 / index + 1 / std::sqrt((index - 1) * (index + 1)));
    return angle * diameter(scene.stone.solid) / pixel_on_stone(scene);
}

double images_apart(const Scene& scene) {
    const IndexSpans spans = index_spans(scene);
    return images_apart(scene, std::max(spans.mean, 1.0 + 1e-6), spans.birefringence);
}

double aperture_blur(const Scene& scene) {
    const Camera& camera = scene.camera;
    if (!(camera.aperture_radius > 0 && camera.focus_distance > 0)) return 0;
    const Vec3 forward = glm::normalize(camera.look_at - camera.position);
    double blur = 0;
    for (const Vec3& corner : scene.stone.solid.vertices) {
        const double z = glm::dot(corner - camera.position, forward);
        blur = std::max(blur, 2 * camera.aperture_radius * std::abs(z - camera.focus_distance) /
                                  camera.focus_distance);
    }
    return blur / pixel_on_stone(scene);
}

double absorbed_across(const Scene& scene) {
    const Material& material = scene.stone.material;
    double strongest = 0;
    for (int ray = 0; ray < ray_count(material.optic); ++ray)
        strongest = std::max(strongest, material.absorption_per_mm[ray].max());
    return 1 - std::exp(-strongest * diameter(scene.stone.solid) * mm_per(scene.stone.unit));
}

double retardation_in_waves(const Scene& scene) {
    return index_spans(scene).birefringence * scene.immersion * diameter(scene.stone.solid) *
           mm_per(scene.stone.unit) / (k_d_line_nm * 1e-6);
}

double absorbance_apart(const Scene& scene) {
    const Material& material = scene.stone.material;
    double apart = 0;
    for (int ray = 1; ray < ray_count(material.optic); ++ray) {
        for (const double nm : even_nodes(k_probes)) {
            for (int other = 0; other < ray; ++other)
                apart = std::max(apart, std::abs(material.absorption_per_mm[ray].at(nm) -
                                                 material.absorption_per_mm[other].at(nm)));
        }
    }
    return apart * diameter(scene.stone.solid) * mm_per(scene.stone.unit) / std::numbers::ln10;
}

}  // namespace culet
