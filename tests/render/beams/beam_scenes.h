#pragma once
// Stones, views and pictures for the tests of beams.

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/beams/beam_shading.h"
#include "render/render.h"
#include "stone/cuts/cuts.h"
#include "tests/render/ray_stones.h"

namespace culet {

/// A round brilliant of diameter 2, centred near the origin, table up.
inline Solid round_brilliant(int mains = 8, double culet_percent = 0) {
    return make_cut(
        "round-brilliant",
        {{"diameter", 2.0}, {"mains", static_cast<double>(mains)}, {"culet", culet_percent}});
}

/// A random stone with a few planes that shave slivers off its corners and edges.
inline Solid stone_with_slivers(std::mt19937_64& random, int planes) {
    const Solid whole = random_stone(random, planes);
    std::vector<NamedPlane> list;
    for (const Facet& facet : whole.facets) list.push_back({facet.name, facet.plane});
    for (std::size_t i = 0; i + 1 < whole.facets.size() && i < 6; ++i) {
        const Facet& facet = whole.facets[i];
        const Vec3 a = whole.vertices[static_cast<std::size_t>(facet.corners[0])],
                   b = whole.vertices[static_cast<std::size_t>(facet.corners[1])];
        // Along an edge, and at a corner.
        Vec3 n = glm::normalize(0.5 * (a + b));
        if (i % 2 == 0) n = glm::normalize(a);
        double highest = -1e300;
        for (const Vec3& corner : whole.vertices) highest = std::max(highest, glm::dot(n, corner));
        list.push_back({"sliver", {n, highest - std::pow(10.0, -3.0 - static_cast<double>(i))}});
    }
    return intersect_half_spaces(list).solid;
}

/// An isotropic, clear stone of index 2.417 in constant light of 1, one wavelength, tolerance 0.
inline Scene plain_scene(const Solid& solid) {
    Scene scene;
    scene.stone.name = "test stone";
    scene.stone.solid = solid;
    scene.stone.material.index[0].n = 2.417;
    scene.camera.width = 96;
    scene.camera.height = 96;
    scene.lights.constant = 1;
    scene.settings.engine = "beams";
    scene.settings.wavelengths_nm = {589.3};
    scene.settings.samples = 1;
    scene.settings.depth = 6;
    scene.settings.tolerance = 0;
    scene.settings.threads = 2;
    return scene;
}

/// Looks at the origin from `distance` along `from`. The field of view holds a sphere of `radius`.
inline void look(Scene& scene, const Vec3& from, double distance, double radius = 1.05) {
    Camera& camera = scene.camera;
    camera.position = distance * glm::normalize(from);
    camera.look_at = Vec3(0);
    camera.up = std::abs(glm::normalize(from).y) > 0.9 ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
    camera.fov = 2 * std::asin(std::min(0.95, radius / distance));
}

inline RenderResult with_engine(Scene scene, const std::string& engine, int samples) {
    scene.settings.engine = engine;
    scene.settings.samples = samples;
    return render(scene);
}

inline double luminance_at(const Picture& picture, std::size_t pixel) {
    return luminance({static_cast<double>(picture.rgb[3 * pixel]),
                      static_cast<double>(picture.rgb[3 * pixel + 1]),
                      static_cast<double>(picture.rgb[3 * pixel + 2])});
}

/// How two pictures differ over the pixels that the second assigns to the stone.
struct Difference {
    int pixels = 0, off = 0, not_finite = 0;  ///< off: differ by more than the tolerance
    double mean = 0;                          ///< |difference| over the mean of the second
    double rms = 0, peak = 0, brightness = 0;
    int worst_x = 0, worst_y = 0;
    double worst = 0, worst_first = 0, worst_second = 0;
    double psnr() const { return 20 * std::log10(peak / rms); }
    double share_off() const { return pixels > 0 ? static_cast<double>(off) / pixels : 0; }
};
inline Difference difference(const Picture& a, const Picture& b, double relative = 1e-4) {
    Difference d;
    double sum = 0, squares = 0, total = 0;
    for (std::size_t i = 0; i < b.pixels(); ++i) d.peak = std::max(d.peak, luminance_at(b, i));
    for (std::size_t i = 0; i < b.pixels(); ++i) {
        if (!std::isfinite(luminance_at(a, i))) ++d.not_finite;
        if (!(b.coverage[i] > 0) && !(a.coverage[i] > 0)) continue;
        ++d.pixels;
        double off = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double x = static_cast<double>(a.rgb[3 * i + c]),
                         y = static_cast<double>(b.rgb[3 * i + c]);
            off = std::max(off, std::abs(x - y));
        }
        const double first = luminance_at(a, i), second = luminance_at(b, i);
        sum += std::abs(first - second);
        squares += (first - second) * (first - second);
        total += second;
        // Relative to the brightest pixel: dark pixels are sums of large terms, whose rounding
        // error they keep.
        if (!(off <= relative * d.peak)) ++d.off;
        if (off > d.worst) {
            d.worst = off;
            d.worst_x = static_cast<int>(i) % b.width;
            d.worst_y = static_cast<int>(i) / b.width;
            d.worst_first = first;
            d.worst_second = second;
        }
    }
    if (d.pixels > 0) {
        d.brightness = total / d.pixels;
        d.mean = sum / total;
        d.rms = std::sqrt(squares / d.pixels);
    }
    return d;
}
inline std::ostream& operator<<(std::ostream& out, const Difference& d) {
    return out << d.off << " of " << d.pixels << " pixels off, mean " << d.mean << ", PSNR "
               << d.psnr() << ", worst " << d.worst << " at (" << d.worst_x << ", " << d.worst_y
               << "): " << d.worst_first << " for " << d.worst_second;
}

}  // namespace culet
