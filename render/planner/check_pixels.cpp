#include "render/planner/check_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "render/beams/frame_renderer.h"
#include "render/colour/colour_error.h"
#include "render/planner/light_edge_scan.h"
#include "render/planner/policy.h"
#include "render/planner/wavelengths.h"
#include "render/reference/surroundings.h"

namespace culet {

namespace {

// Coverage from which a pixel counts as the stone's.
constexpr float k_filled = 0.5f;

// Maps the fractional part of number * multiple / 2^32 to 0 .. side - 1.
int place_in(int side, std::uint32_t number, std::uint32_t multiple) {
    return static_cast<int>(static_cast<std::uint64_t>(side) * (number * multiple) >> 32);
}
// R2, the golden ratio in two dimensions (Roberts 2018): no grid of facets resonates with it.
constexpr std::uint32_t k_along = 0xC13FA9A9, k_down = 0x91E10DA6;

double brightest_light(const Scene& scene) {
    return surroundings_of(scene, WavelengthSet(even_wavelengths(3)))->max_radiance();
}

}  // namespace

Contrast contrast_of(const Picture& picture, int windows, double filled) {
    Contrast found;
    if (picture.coverage.empty()) return found;
    const int width = picture.width / windows, height = picture.height;
    const int side = static_cast<int>(std::sqrt(std::clamp(filled / 65536, 1.0, 1e6)));
    std::uint32_t number = 0;
    for (int top = 0; top < height; top += side) {
        for (int left = 0; left < width; left += side, ++number) {
            const int x = left + place_in(side, number, k_along),
                      y = top + place_in(side, number, k_down);
            if (x >= width || y >= height) continue;
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                static_cast<std::size_t>(x);
            if (picture.coverage[pixel] < k_filled) continue;
            const Rgb here = picture.pixel(x, y);
            double most = 0;
            if (x > 0) most = std::max(most, apart(here, picture.pixel(x - 1, y)));
            if (x + 1 < width) most = std::max(most, apart(here, picture.pixel(x + 1, y)));
            if (y > 0) most = std::max(most, apart(here, picture.pixel(x, y - 1)));
            if (y + 1 < height) most = std::max(most, apart(here, picture.pixel(x, y + 1)));
            const double root = std::isfinite(most) ? std::sqrt(most) : 0, mean = mean_of(here),
                         radiance = std::isfinite(mean) ? std::max(0.0, mean) : 0;
            found.pixels.push_back({x, y, root, radiance});
            found.sum += root;
            found.radiance += radiance;
        }
    }
    return found;
}

namespace {

// Chances of the pixels, 1 on average: some for all, some by the root of the local contrast, and by
// `edges` if there are any. Pixels of little contrast have errors, too, as a picture may lack what
// is there.
std::vector<double> chances_of(const Contrast& contrast, const std::vector<double>& edges) {
    const double count = static_cast<double>(contrast.pixels.size());
    double sum_of_edges = 0;
    for (const double edge : edges) sum_of_edges += edge;
    const double of_edges = sum_of_edges > 0 ? (1 - k_even_share) / 2 : 0,
                 of_contrast = 1 - k_even_share - of_edges,
                 by_edge = sum_of_edges > 0 ? of_edges * count / sum_of_edges : 0,
                 by_root = contrast.sum > 0 ? of_contrast * count / contrast.sum : 0;
    std::vector<double> chances;
    for (std::size_t i = 0; i < contrast.pixels.size(); ++i)
        chances.push_back(k_even_share + by_root * contrast.pixels[i].root +
                          (by_edge > 0 ? by_edge * edges[i] : 0));
    return chances;
}

// Samples the cumulative chances evenly, by multiples of the golden ratio.
void choose_by(const std::vector<double>& chances, const Contrast& contrast, CheckPixels& chosen) {
    const std::size_t size = chances.size();
    std::vector<double> sums;
    sums.reserve(size);
    double total = 0;
    for (const double chance : chances) sums.push_back(total += chance);
    for (std::size_t i = 0; i < std::min(k_most_pixels, size); ++i) {
        const double place =
            total * std::fmod(0.6180339887498949 * (static_cast<double>(i) + 0.5), 1.0);
        const std::size_t at =
            std::min(static_cast<std::size_t>(std::upper_bound(sums.begin(), sums.end(), place) -
                                              sums.begin()),
                     size - 1);
        chosen.pixels.at.emplace_back(contrast.pixels[at].x, contrast.pixels[at].y);
        chosen.weights.push_back(total / static_cast<double>(size) / chances[at]);
    }
}

}  // namespace

CheckPixels choose_check_pixels(const Scene& scene, const Picture& picture, const StonePixels& some,
                                const Progress& progress, FrameRenderer* frames) {
    CheckPixels chosen;
    chosen.pixels.in_picture = some.in_picture;
    chosen.first = k_first_pixels;
    const Contrast contrast =
        contrast_of(picture, scene.camera.optics.two_windows ? 2 : 1, some.in_picture);
    if (contrast.pixels.size() <= k_first_pixels) {
        // A stone of few pixels, or a picture without coverage.
        for (const Contrast::Pixel& pixel : contrast.pixels)
            chosen.pixels.at.emplace_back(pixel.x, pixel.y);
        chosen.all = !contrast.pixels.empty();
        if (!chosen.all) chosen.pixels.at = some.at;
        chosen.weights.assign(chosen.pixels.at.size(), 1.0);
        return chosen;
    }
    std::vector<double> edges;
    // Mean radiance without the excess of the few brightest pixels.
    const double count = static_cast<double>(contrast.pixels.size()),
                 much = k_bright * contrast.radiance / count;
    double radiance = 0;
    for (const Contrast::Pixel& pixel : contrast.pixels) radiance += std::min(pixel.radiance, much);
    const Brightness bright{k_bright * radiance / count, brightest_light(scene)};
    if (radiance > 0 && bright.most > bright.least) {
        chosen.bright = true;
        chosen.sun = bright.sun();
        const LightEdgeScan scan(scene, bright, progress, frames);
        for (const Contrast::Pixel& pixel : contrast.pixels)
            edges.push_back(scan.near(pixel.x, pixel.y));
        // Enough for some pixels to see a light that may be there; more for finer tolerances, where
        // such pixels are rarer.
        chosen.first = static_cast<std::size_t>(
            2 * k_first_pixels * std::clamp(0.03 / scene.settings.tolerance, 1.0, 10.0));
    }
    choose_by(chances_of(contrast, edges), contrast, chosen);
    return chosen;
}

std::vector<std::pair<int, int>> bright_outliers(const Picture& picture, int windows, double share,
                                                 std::size_t most) {
    struct Bright {
        std::size_t pixel = 0;
        double light = 0;
    };
    std::vector<Bright> found;
    const int width = picture.width / windows;
    const auto light_of = [&](std::size_t pixel) {
        const float* rgb = picture.rgb.data() + 3 * pixel;
        const double light = static_cast<double>(std::abs(rgb[0] + rgb[1] + rgb[2]));
        return std::isfinite(light) ? light : 0;
    };
    double sum = 0, count = 0;
    const auto each = [&](const auto& take) {
        for (int y = 0; y < picture.height; ++y) {
            const std::size_t row =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width);
            for (std::size_t pixel = row; pixel < row + static_cast<std::size_t>(width); ++pixel) {
                if (!picture.coverage.empty() && picture.coverage[pixel] >= k_filled)
                    take(pixel, light_of(pixel));
            }
        }
    };
    each([&](std::size_t, double light) {
        sum += light;
        ++count;
    });
    const double least = std::max(share, 30 / count) * sum;
    each([&](std::size_t pixel, double light) {
        if (light > least) found.push_back({pixel, light});
    });
    if (found.size() > most) {
        std::stable_sort(found.begin(), found.end(),
                         [](const Bright& a, const Bright& b) { return a.light > b.light; });
        found.resize(most);
        std::sort(found.begin(), found.end(),
                  [](const Bright& a, const Bright& b) { return a.pixel < b.pixel; });
    }
    std::vector<std::pair<int, int>> at;
    for (const Bright& bright : found) {
        at.emplace_back(static_cast<int>(bright.pixel % static_cast<std::size_t>(picture.width)),
                        static_cast<int>(bright.pixel / static_cast<std::size_t>(picture.width)));
    }
    return at;
}

}  // namespace culet
