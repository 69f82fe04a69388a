#include "compare/light_probe/light_merge.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "compare/light_probe/map_holes.h"
#include "render/colour/colour.h"
#include "render/scene/environment_layout.h"
#include "stone/progress/check_stop.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// A view of lower quality is used only where no other sees more, and counts as not covered.
constexpr double k_seen = 1e-4;
// Exponent of each correction: over-relaxation of Richardson and Lucy's small steps (Meinel 1986).
constexpr double k_overrelaxation = 1.6;

// Expected difference of two views, sqrt(2) standard deviations, in stops. NaN where fewer than two
// see the texel.
float stops_apart(const std::vector<std::vector<float>>& levels, std::size_t texel, double floor) {
    double n = 0, sum = 0, squares = 0;
    for (const std::vector<float>& view : levels) {
        if (view[texel] < 0) continue;
        const double stops = std::log2(view[texel] + floor);
        ++n;
        sum += stops;
        squares += stops * stops;
    }
    if (n < 2) return std::numeric_limits<float>::quiet_NaN();
    const double variance = std::max(squares - sum * sum / n, 0.0) / (n - 1);
    return static_cast<float>(std::sqrt(2 * variance));
}

// Rows of a view's picture that the ball covers.
struct Rows {
    int from, to, left, right;
};
Rows rows_of(const BallView& view) {
    const BallCircle& c = view.ball.circle();
    return {std::max(0, static_cast<int>(std::floor(c.y - c.radius))),
            std::min(view.picture->height, static_cast<int>(std::ceil(c.y + c.radius)) + 1),
            std::max(0, static_cast<int>(std::floor(c.x - c.radius))),
            std::min(view.picture->width, static_cast<int>(std::ceil(c.x + c.radius)) + 1)};
}

// Number of bands of rows. They are summed in order, so that the result does not depend on threads;
// each needs its own map.
int bands_for(int width) {
    return width <= 1024 ? 16 : width <= 2048 ? 8 : 2;
}

struct Correction {
    std::vector<float> up, total;  // for each texel: weighted ratios (3) and weights (1)
};

// Where in the map the parts of the ball's pixels look, computed once for all passes.
struct PixelParts {
    Rows rows{};
    int parts = 1;  // of each pixel
    std::vector<float> column, row;
    std::vector<float> quality;  // of each pixel; 0: not used

    PixelParts(const BallView& view, int width) : rows(rows_of(view)) {
        const double texel = std::sqrt(2.0) * std::numbers::pi / width;
        const double pixel = std::sqrt(view.ball.solid_angle_per_pixel());
        const int steps = std::clamp(static_cast<int>(std::ceil(2 * pixel / texel)), 1, 4);
        parts = steps * steps;
        const int across = rows.right - rows.left, down = rows.to - rows.from;
        quality.assign(static_cast<std::size_t>(across) * down, 0);
        column.resize(quality.size() * static_cast<std::size_t>(parts));
        row.resize(column.size());
        tbb::parallel_for(0, down, [&](int j) {
            check_stop();
            for (int i = 0; i < across; ++i) {
                const std::size_t at = static_cast<std::size_t>(j) * across + i;
                double sum = 0;
                for (int k = 0; k < parts; ++k) {
                    const double x = rows.left + i - 0.5 + (k % steps + 0.5) / steps;
                    const double y = rows.from + j - 0.5 + (k / steps + 0.5) / steps;
                    const auto d = view.ball.direction_of({x, y});
                    if (!d) {
                        sum = 0;
                        break;
                    }
                    sum += view.quality(*d) / parts;
                    const MapPlace place =
                        lat_long_place(view.world_from_camera * *d, width, width / 2);
                    column[at * parts + k] = static_cast<float>(place.column - 0.5);
                    row[at * parts + k] =
                        static_cast<float>(std::clamp(place.row - 0.5, 0.0, width / 2 - 1.0));
                }
                quality[at] = sum < 1e-3 ? 0 : static_cast<float>(sum);
            }
        });
    }
};

// One pass for one view: compares the map's picture in the ball with the photograph.
void add_corrections(const EnvironmentMap& map, const BallView& view, const PixelParts& pixels,
                     double gain, std::vector<Correction>& bands) {
    const Rows& rows = pixels.rows;
    const int across = rows.right - rows.left, down = rows.to - rows.from;
    const int band_count = static_cast<int>(bands.size());
    tbb::parallel_for(0, band_count, [&](int band) {
        Correction& sum = bands[static_cast<std::size_t>(band)];
        std::array<std::size_t, 64> texel{};
        std::array<float, 64> share{};
        for (int j = down * band / band_count; j < down * (band + 1) / band_count; ++j) {
            check_stop();
            for (int i = 0; i < across; ++i) {
                const std::size_t at = static_cast<std::size_t>(j) * across + i;
                const float quality = pixels.quality[at];
                if (quality <= 0) continue;
                std::array<float, 3> predicted{};
                std::size_t used = 0;
                for (int k = 0; k < pixels.parts; ++k) {
                    // As in EnvironmentMap::at.
                    const float column = pixels.column[at * pixels.parts + k];
                    const float row = pixels.row[at * pixels.parts + k];
                    const int x0 = static_cast<int>(std::floor(column));
                    const int y0 = static_cast<int>(row);
                    const float u = column - static_cast<float>(x0);
                    const float v = row - static_cast<float>(y0);
                    for (int corner = 0; corner < 4; ++corner) {
                        const int x = (x0 + corner % 2 + map.width) % map.width;
                        const int y = std::min(y0 + corner / 2, map.height - 1);
                        texel[used] = static_cast<std::size_t>(y) * map.width + x;
                        share[used] = (corner % 2 ? u : 1 - u) * (corner / 2 ? v : 1 - v) /
                                      static_cast<float>(pixels.parts);
                        for (std::size_t c = 0; c < 3; ++c)
                            predicted[c] += share[used] * map.rgb[3 * texel[used] + c];
                        ++used;
                    }
                }
                const std::size_t pixel =
                    static_cast<std::size_t>(rows.from + j) * view.picture->width + rows.left + i;
                const bool over =
                    !view.picture->saturated.empty() && view.picture->saturated[pixel] > 0;
                std::array<float, 3> ratio{};
                for (std::size_t c = 0; c < 3; ++c) {
                    const auto taken = static_cast<float>(gain * view.picture->rgb[3 * pixel + c]);
                    ratio[c] = predicted[c] > 0 ? taken / predicted[c] : 1;
                    // An over-exposed pixel is a lower bound.
                    if (over) ratio[c] = std::max(ratio[c], 1.0f);
                    ratio[c] = std::clamp(ratio[c], 0.5f, 2.0f);
                }
                for (std::size_t k = 0; k < used; ++k) {
                    const float w = quality * share[k];
                    sum.total[texel[k]] += w;
                    for (std::size_t c = 0; c < 3; ++c) sum.up[3 * texel[k] + c] += w * ratio[c];
                }
            }
        }
    });
}

void sharpen(EnvironmentMap& map, const std::vector<BallView>& views,
             const std::vector<PixelParts>& pixels, const std::vector<double>& gains) {
    const std::size_t texels = map.rgb.size() / 3;
    std::vector<double> up(3 * texels), total(texels);
    for (std::size_t v = 0; v < views.size(); ++v) {
        std::vector<Correction> bands(static_cast<std::size_t>(bands_for(map.width)));
        for (Correction& band : bands) {
            band.up.assign(3 * texels, 0);
            band.total.assign(texels, 0);
        }
        add_corrections(map, views[v], pixels[v], gains[v], bands);
        for (const Correction& band : bands) {
            for (std::size_t i = 0; i < texels; ++i) {
                if (band.total[i] <= 0) continue;
                total[i] += band.total[i];
                for (std::size_t c = 0; c < 3; ++c) up[3 * i + c] += band.up[3 * i + c];
            }
        }
    }
    for (std::size_t i = 0; i < texels; ++i) {
        if (total[i] <= 0) continue;
        for (std::size_t c = 0; c < 3; ++c)
            map.rgb[3 * i + c] *=
                static_cast<float>(std::pow(up[3 * i + c] / total[i], k_overrelaxation));
    }
}

}  // namespace

MergedLight merge_views(const std::vector<BallView>& views, const std::vector<double>& gains,
                        int width, int passes, const Progress& progress) {
    MergedLight merged;
    merged.map.width = width;
    merged.map.height = width / 2;
    const std::size_t texels = static_cast<std::size_t>(width) * (width / 2);
    merged.map.rgb.assign(3 * texels, 0);
    merged.coverage.assign(texels, 0);
    merged.disagreement.assign(texels, std::numeric_limits<float>::quiet_NaN());
    std::vector<double> sum(3 * texels, 0), weight(texels, 0);
    // A view's luminance; negative where it is too near the rim to compare.
    std::vector<std::vector<float>> levels(views.size(), std::vector<float>(texels, -1));
    double mean = 0;
    const double steps = static_cast<double>(views.size()) + passes;
    const auto report = [&](double done) {
        if (progress && !progress(done / steps)) throw Interrupted();
    };
    for (std::size_t v = 0; v < views.size(); ++v) {
        report(static_cast<double>(v));
        const ViewMap map = view_map(views[v], width);
        for (std::size_t i = 0; i < texels; ++i) {
            const double q = map.quality[i];
            if (q <= 0) continue;
            weight[i] += q;
            for (std::size_t c = 0; c < 3; ++c) sum[3 * i + c] += q * gains[v] * map.rgb[3 * i + c];
            merged.coverage[i] =
                1 - (1 - merged.coverage[i]) * (1 - static_cast<float>(q > k_seen ? q : 0));
            if (q >= 0.01) levels[v][i] = static_cast<float>(gains[v] * luminance(&map.rgb[3 * i]));
        }
    }
    for (std::size_t i = 0; i < texels; ++i) {
        if (weight[i] <= 0) continue;
        for (std::size_t c = 0; c < 3; ++c)
            merged.map.rgb[3 * i + c] = static_cast<float>(sum[3 * i + c] / weight[i]);
        mean += luminance(&merged.map.rgb[3 * i]) / static_cast<double>(texels);
    }
    if (mean > 0) {
        for (std::size_t i = 0; i < texels; ++i)
            merged.disagreement[i] = stops_apart(levels, i, 1e-3 * mean);
    }
    merged.filled_sr = fill_holes(merged.map, weight);
    std::vector<PixelParts> pixels;
    if (passes > 0)
        for (const BallView& view : views) pixels.emplace_back(view, width);
    for (int pass = 0; pass < passes; ++pass) {
        report(static_cast<double>(views.size()) + pass);
        sharpen(merged.map, views, pixels, gains);
    }
    return merged;
}

MergedLight coarsened(const MergedLight& light, int factor) {
    const EnvironmentMap& fine = light.map;
    MergedLight result;
    result.filled_sr = light.filled_sr;
    result.map.width = fine.width / factor;
    result.map.height = fine.height / factor;
    for (int y = 0; y < result.map.height; ++y) {
        for (int x = 0; x < result.map.width; ++x) {
            std::array<double, 3> rgb{};
            double omega = 0, coverage = 0, stops = 0, known = 0;
            for (int j = factor * y; j < factor * (y + 1); ++j) {
                const double w = lat_long_solid_angle(j, fine.width, fine.height);
                for (int i = factor * x; i < factor * (x + 1); ++i) {
                    const std::size_t at = static_cast<std::size_t>(j) * fine.width + i;
                    omega += w;
                    for (std::size_t c = 0; c < 3; ++c) rgb[c] += w * fine.rgb[3 * at + c];
                    coverage += w * light.coverage[at];
                    if (!std::isfinite(light.disagreement[at])) continue;
                    stops += w * light.disagreement[at];
                    known += w;
                }
            }
            for (const double v : rgb) result.map.rgb.push_back(static_cast<float>(v / omega));
            result.coverage.push_back(static_cast<float>(coverage / omega));
            result.disagreement.push_back(known > 0 ? static_cast<float>(stops / known)
                                                    : std::numeric_limits<float>::quiet_NaN());
        }
    }
    return result;
}

}  // namespace culet
