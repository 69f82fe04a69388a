#include "render/objects/surface.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "render/optics/conductor.h"

namespace culet {

namespace {

// Smallest alpha^2; smoother surfaces count as polished. Squared slopes are 1 - cosine, rounded by
// 2^-52, so three digits remain.
constexpr double k_flattest = 0x1p-42;
constexpr int k_once_cosines = 64, k_once_azimuths = 32, k_once_heights = 128;

// A set of few wavelengths represents some colours by values above `most` or below 0: clamp them.
std::vector<double> nodes_of(const SurfaceColour& colour, const WavelengthSet& wavelengths,
                             double most = std::numeric_limits<double>::infinity()) {
    LightColour light;
    std::visit([&light](const auto& value) { light.value = value; }, colour.value);
    std::vector<double> nodes = radiance_of(light, wavelengths);
    for (double& node : nodes) node = std::clamp(node, 0.0, most);
    return nodes;
}

}  // namespace

ReadySurface::ReadySurface(const SurfaceMaterial& material, const WavelengthSet& wavelengths,
                           double outside) {
    if (const auto* diffuse = std::get_if<DiffuseMaterial>(&material)) {
        colour = nodes_of(diffuse->albedo, wavelengths, 1);
    } else if (const auto* mirror = std::get_if<MirrorMaterial>(&material)) {
        kind = SurfaceKind::mirror;
        colour = nodes_of(mirror->albedo, wavelengths, 1);
    } else if (const auto* glass = std::get_if<DielectricMaterial>(&material)) {
        kind = SurfaceKind::dielectric;
        index = glass->index / outside;
        absorption = nodes_of(glass->absorption, wavelengths);
    } else if (const auto* emitter = std::get_if<EmitterMaterial>(&material)) {
        kind = SurfaceKind::emitter;
        colour = radiance_of(emitter->radiance, wavelengths);
    } else {
        const auto& metal = std::get<MetalMaterial>(material);
        alpha = metal.roughness * metal.roughness;
        kind = alpha * alpha > k_flattest ? SurfaceKind::rough_metal : SurfaceKind::metal;
        if (metal.f0) {
            for (const double r : nodes_of(*metal.f0, wavelengths, 1)) {
                n_.push_back(1);
                k_.push_back(extinction_of_reflectance(r));
            }
        } else {
            n_ = nodes_of(metal.n, wavelengths);
            k_ = nodes_of(metal.k, wavelengths);
            for (double& n : n_) n /= outside;
            for (double& k : k_) k /= outside;
        }
        for (int i = 0; i < wavelengths.size(); ++i)
            normal_reflectance_.push_back(reflectance(i, 1));
        if (kind == SurfaceKind::rough_metal) prepare_reflected_once();
    }
}

MuellerReflection ReadySurface::reflection(int node, double cosine) const {
    const auto i = static_cast<std::size_t>(node);
    if (std::isinf(k_[i])) return {};
    const std::complex<double> m(n_[i], k_[i]), square = m * m;
    // The root whose wave decays into the metal has a positive imaginary part.
    const std::complex<double> q = std::sqrt(square - (1 - cosine) * (1 + cosine));
    const std::complex<double> r_s = (cosine - q) / (cosine + q),
                               r_p = (square * cosine - q) / (square * cosine + q);
    if (!std::isfinite(r_s.real() + r_p.real())) return {};
    const double s = std::norm(r_s), p = std::norm(r_p);
    const std::complex<double> mixed = r_s * std::conj(r_p);
    return {0.5 * (s + p), 0.5 * (s - p), mixed.real(), mixed.imag()};
}

double ReadySurface::reflectance(int node, double cosine) const {
    const auto i = static_cast<std::size_t>(node);
    return conductor_reflectance(n_[i], k_[i], cosine);
}

void ReadySurface::prepare_reflected_once() {
    for (int i = 0; i < k_once_cosines; ++i) {
        // Denser towards grazing light, where it changes most.
        const double root = (i + 0.5) / k_once_cosines, cosine = root * root;
        const Vec3 from{std::sqrt(1 - cosine * cosine), 0, cosine};
        double sum = 0;
        for (int b = 0; b < k_once_heights; ++b) {
            // Denser for steep microfacets, which are few but lose most. v = 1 - w^3.
            const double w = (b + 0.5) / k_once_heights, weight = 3 * w * w;
            for (int a = 0; a < k_once_azimuths; ++a) {
                const Vec3 to =
                    ggx::sample(alpha, from, (a + 0.5) / k_once_azimuths, 1 - w * w * w);
                if (!(to.z > 0)) continue;
                sum += weight * ggx::masking_and_shadowing(alpha, from, to) /
                       ggx::masking(alpha, from);
            }
        }
        reflected_once_.push_back(sum / (k_once_heights * k_once_azimuths));
    }
}

double ReadySurface::reflected_once(double cosine) const {
    const double at = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * k_once_cosines - 0.5;
    const double cell = std::clamp(std::floor(at), 0.0, k_once_cosines - 2.0);
    const auto i = static_cast<std::size_t>(cell);
    return reflected_once_[i] + (reflected_once_[i + 1] - reflected_once_[i]) * (at - cell);
}

namespace ggx {

namespace {

// Smith's Lambda: hidden slopes relative to visible ones.
double hidden(double alpha, const Vec3& direction) {
    const double z = direction.z * direction.z;
    return 0.5 * (std::sqrt(1 + alpha * alpha * (1 - z) / z) - 1);
}

}  // namespace

double density(double alpha, const Vec3& half) {
    const double a2 = alpha * alpha, z = half.z * half.z;
    // 1 + (a^2 - 1) z^2, without cancellation for smooth surfaces.
    const double base = a2 * z + (1 - z);
    return a2 / (std::numbers::pi * base * base);
}

double masking(double alpha, const Vec3& direction) {
    return 1 / (1 + hidden(alpha, direction));
}

double masking_and_shadowing(double alpha, const Vec3& a, const Vec3& b) {
    return 1 / (1 + hidden(alpha, a) + hidden(alpha, b));
}

Vec3 sample(double alpha, const Vec3& from, double u, double v) {
    const Vec3 stretched = glm::normalize(Vec3{alpha * from.x, alpha * from.y, from.z});
    const double phi = 2 * std::numbers::pi * u, z = (1 - v) * (1 + stretched.z) - stretched.z;
    const double r = std::sqrt(std::clamp(1 - z * z, 0.0, 1.0));
    const Vec3 cap = Vec3{r * std::cos(phi), r * std::sin(phi), z} + stretched;
    const Vec3 half = glm::normalize(Vec3{alpha * cap.x, alpha * cap.y, cap.z});
    return glm::normalize(2 * glm::dot(from, half) * half - from);
}

double sample_density(double alpha, const Vec3& from, const Vec3& to) {
    const Vec3 half = glm::normalize(from + to);
    return masking(alpha, from) * density(alpha, half) / (4 * from.z);
}

}  // namespace ggx

}  // namespace culet
