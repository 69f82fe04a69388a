#pragma once
// Finds the pixels at an edge of the path pattern, and compares two pictures elsewhere.

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include "render/geometry/convex_body.h"
#include "render/image/picture.h"
#include "render/reference/light_paths.h"
#include "render/setup/optical_setup.h"

namespace culet {

/// The facets that the path of a pixel's ray meets at one band, in order; empty for a ray that
/// misses.
struct PathFacets {
    std::vector<int> facets;
    void path_exits(const Vec3&, const Vec3&, const NodeWeights&, const PathTrace&) {}
    void remainder(const NodeWeights&) {}
    void absorbed(const NodeWeights&) {}
    void cut(const NodeWeights&) {}
};

/// Pixels away from edges of the path pattern: they and their eight neighbours meet the same facets
/// in the same order on the whole path, at every band of wavelengths (with the mean index in a
/// crystal). Sequences are the reference's in double precision, one ray through each pixel's
/// middle.
inline std::vector<bool> inner_pixels(const Scene& scene) {
    const OpticalSetup setup = make_optical_setup(scene);
    const ConvexBody body(scene.stone.solid);
    const EyeRays eyes(scene.camera);
    const int width = scene.camera.width, height = scene.camera.height;
    std::vector<bool> inner(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                            true);
    std::vector<std::vector<int>> ways(inner.size());
    for (Band band : setup.bands) {
        band.n /= band.n_outside;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                std::vector<int>& way = ways[static_cast<std::size_t>(y * width + x)];
                way.clear();
                const EyeRay ray = eyes.through(x + 0.5, y + 0.5);
                const auto entry = body.entry(ray.origin, ray.direction);
                if (!entry) continue;
                PathLimits limits;
                limits.depth = scene.settings.depth;
                PathFacets sink;
                PathTrace trace;
                LightPaths<PathFacets>(body, band, limits, sink, trace).trace(ray, *entry);
                way.assign(trace.facets.begin(), trace.facets.begin() + trace.length);
            }
        }
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const auto pixel = static_cast<std::size_t>(y * width + x);
                for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v) {
                    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
                        if (ways[static_cast<std::size_t>(v * width + u)] != ways[pixel])
                            inner[pixel] = false;
                    }
                }
                if (ways[pixel].empty()) inner[pixel] = false;
            }
        }
    }
    return inner;
}

/// Root mean square difference of R, G and B over some pixels, relative to their mean in `truth`;
/// and the same over all of the stone's pixels.
struct PixelErrors {
    int inner = 0, stone = 0, not_finite = 0;
    int off = 0;  ///< pixels of the stone that differ by more than a hundredth of the mean
    double inner_rms = 0, whole_rms = 0, inner_worst = 0;
};
inline PixelErrors errors_of(const Picture& picture, const Picture& truth,
                             const std::vector<bool>& inner) {
    PixelErrors errors;
    double inner_squares = 0, inner_sum = 0, whole_squares = 0, whole_sum = 0, worst = 0;
    std::vector<double> differences;  // the largest of each pixel
    for (std::size_t i = 0; i < truth.pixels(); ++i) {
        if (!(truth.coverage[i] > 0)) continue;
        ++errors.stone;
        if (inner[i]) ++errors.inner;
        double& largest = differences.emplace_back(0.0);
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
            const double exact = static_cast<double>(truth.rgb[c]),
                         off = static_cast<double>(picture.rgb[c]) - exact;
            if (!std::isfinite(off)) ++errors.not_finite;
            largest = std::max(largest, std::abs(off));
            whole_squares += off * off;
            whole_sum += exact;
            if (!inner[i]) continue;
            inner_squares += off * off;
            inner_sum += exact;
            worst = std::max(worst, std::abs(off));
        }
    }
    const double whole = 3.0 * errors.stone, some = 3.0 * errors.inner;
    if (errors.stone > 0) errors.whole_rms = std::sqrt(whole_squares * whole) / whole_sum;
    if (errors.inner > 0) {
        errors.inner_rms = std::sqrt(inner_squares * some) / inner_sum;
        errors.inner_worst = worst * some / inner_sum;
    }
    for (const double off : differences) errors.off += !(off * whole <= 0.01 * whole_sum);
    return errors;
}
inline std::ostream& operator<<(std::ostream& out, const PixelErrors& e) {
    return out << "RMSE " << e.inner_rms << " of the mean over " << e.inner << " of " << e.stone
               << " pixels, worst " << e.inner_worst << "; over all pixels " << e.whole_rms << ", "
               << e.off << " off by a hundredth";
}

}  // namespace culet
