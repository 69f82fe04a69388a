#include "render/plan/proof_pixels.h"

#include <algorithm>
#include <cmath>

#include "render/colour_error.h"
#include "render/plan/light_edge_scan.h"
#include "render/plan/planner.h"

namespace culet {

namespace {

constexpr std::size_t k_first_pixels = 48, k_most_pixels = 3072;
// Lights that are so many times as bright as the picture are looked for where the picture lacks
// them, and more pixels are looked at first: of those where a light may be seen, some see it.
constexpr double k_bright = 8;
constexpr std::size_t k_first_pixels_of_bright = 96;
// Every pixel has this share of a mean chance at least: none counts more than two and a half times.
constexpr double k_even_share = 0.4;
// Of the rest, what goes to where a light's edge may be.
constexpr double k_share_of_edges = 0.5;

double brightest_light(const Scene& scene) {
    const WavelengthSet colours(even_wavelengths(3));
    return LightField(scene.lights, colours).max_radiance();
}

}  // namespace

// More often where the picture changes beside a pixel. With the root of that change: pixels of
// little contrast are off as well, because a picture may lack what is there.
ProofPixels choose_proof_pixels(const Scene& scene, const Picture& picture, const StonePixels& some,
                                const Progress& progress, FrameRenderer* frames) {
    ProofPixels chosen;
    chosen.pixels.in_picture = some.in_picture;
    chosen.first = k_first_pixels;
    const int windows = scene.camera.optics.two_windows ? 2 : 1;
    const int width = picture.width / windows, height = picture.height;
    std::vector<std::pair<int, int>> at;
    std::vector<double> contrast;
    at.reserve(picture.pixels());
    contrast.reserve(picture.pixels());
    double sum = 0, radiance = 0;
    for (int y = 0; y < height && !picture.coverage.empty(); ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                static_cast<std::size_t>(x);
            if (picture.coverage[pixel] < 0.5f) continue;
            const Rgb here = picture.pixel(x, y);
            double most = 0;
            for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
                if (x + dx < 0 || x + dx >= width || y + dy < 0 || y + dy >= height) continue;
                most = std::max(most, apart(here, picture.pixel(x + dx, y + dy)));
            }
            if (!std::isfinite(most)) most = 0;
            at.emplace_back(x, y);
            contrast.push_back(std::sqrt(most));
            sum += contrast.back();
            radiance += std::isfinite(mean_of(here)) ? std::max(0.0, mean_of(here)) : 0;
        }
    }
    const double count = static_cast<double>(at.size());
    if (at.size() <= k_first_pixels) {
        // A stone of few pixels, or of none that the picture tells of.
        chosen.pixels.at = at.empty() ? some.at : at;
        chosen.counts.assign(chosen.pixels.at.size(), 1.0);
        chosen.all = !at.empty();
        return chosen;
    }
    std::vector<double> edges(at.size(), 0.0);
    double sum_of_edges = 0;
    if (radiance > 0 && brightest_light(scene) * count > k_bright * radiance) {
        const LightEdgeScan scan(scene, progress, frames);
        for (std::size_t i = 0; i < at.size(); ++i)
            sum_of_edges += edges[i] = scan.near(at[i].first, at[i].second);
        chosen.first = k_first_pixels_of_bright;
    }
    // Chances, and their sums; then the golden ratio's multiples, evenly spread over these.
    std::vector<double> sums, chances;
    sums.reserve(at.size());
    chances.reserve(at.size());
    double total = 0;
    const double of_edges = sum_of_edges > 0 ? k_share_of_edges * (1 - k_even_share) : 0,
                 of_contrast = 1 - k_even_share - of_edges;
    for (std::size_t i = 0; i < at.size(); ++i) {
        chances.push_back(k_even_share + (sum > 0 ? of_contrast * contrast[i] * count / sum : 0) +
                          (sum_of_edges > 0 ? of_edges * edges[i] * count / sum_of_edges : 0));
        total += chances.back();
        sums.push_back(total);
    }
    const std::size_t most = std::min(k_most_pixels, at.size());
    for (std::size_t i = 0; i < most; ++i) {
        const double place =
            total * std::fmod(0.6180339887498949 * (static_cast<double>(i) + 0.5), 1.0);
        const std::size_t pixel =
            std::min(static_cast<std::size_t>(std::upper_bound(sums.begin(), sums.end(), place) -
                                              sums.begin()),
                     at.size() - 1);
        chosen.pixels.at.push_back(at[pixel]);
        chosen.counts.push_back(total / count / chances[pixel]);
    }
    return chosen;
}

}  // namespace culet
