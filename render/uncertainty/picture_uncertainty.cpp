#include "render/uncertainty/picture_uncertainty.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "render/beams/frame_renderer.h"
#include "render/colour/colour.h"
#include "render/render.h"
#include "stone/text/errors.h"
#include "stone/upright.h"

namespace culet {

namespace {

// R, G, B and luminance of every pixel: running mean and sum of squares (Welford 1962), and all
// luminances.
class PixelSums {
public:
    explicit PixelSums(std::size_t pixels) : mean_(4 * pixels), squares_(4 * pixels) {}

    void add(const Picture& picture) {
        ++count_;
        kept_.emplace_back(picture.pixels());
        for (std::size_t p = 0; p < picture.pixels(); ++p) {
            const float* rgb = picture.rgb.data() + 3 * p;
            const std::array<double, 3> c{double(rgb[0]), double(rgb[1]), double(rgb[2])};
            const std::array<double, 4> values{c[0], c[1], c[2], luminance({c[0], c[1], c[2]})};
            kept_.back()[p] = static_cast<float>(values[3]);
            for (std::size_t k = 0; k < 4; ++k) {
                const std::size_t at = 4 * p + k;
                const double step = values[k] - mean_[at];
                mean_[at] += step / count_;
                squares_[at] += step * (values[k] - mean_[at]);
            }
        }
    }
    int count() const { return count_; }
    float mean(std::size_t p, std::size_t k) const { return static_cast<float>(mean_[4 * p + k]); }
    float sigma(std::size_t p, std::size_t k) const {
        return static_cast<float>(std::sqrt(squares_[4 * p + k] / (count_ - 1)));
    }
    std::array<float, 4> bands(std::size_t p) const {
        std::vector<float> sorted;
        for (const std::vector<float>& picture : kept_) sorted.push_back(picture[p]);
        std::sort(sorted.begin(), sorted.end());
        std::array<float, 4> levels;
        for (std::size_t k = 0; k < levels.size(); ++k) levels[k] = level(sorted, k_band_levels[k]);
        return levels;
    }

private:
    // Another sample of the same distribution lies below the k-th of n sorted ones with probability
    // k / (n + 1), whatever the distribution.
    static float level(const std::vector<float>& sorted, double probability) {
        const double n = static_cast<double>(sorted.size());
        const double rank = std::clamp(probability * (n + 1) - 1, 0.0, n - 1);
        const auto below = static_cast<std::size_t>(rank);
        const auto above = std::min(below + 1, sorted.size() - 1);
        const float part = static_cast<float>(rank - static_cast<double>(below));
        return sorted[below] + part * (sorted[above] - sorted[below]);
    }

    std::vector<double> mean_, squares_;
    std::vector<std::vector<float>> kept_;
    int count_ = 0;
};

// Draws with the plan's settings by beams, without checking again against the reference.
ScenePlan by_beams(const Scene& scene, ScenePlan plan) {
    if (!drawn_by_beams(plan.settings)) plan.settings.engine = k_beam_engine;
    plan.settings.check = Check::none;
    plan.settings.meter = nullptr;
    Scene settled = scene;
    settled.settings = plan.settings;
    const std::string refusal = refused_by_beams(settled);
    if (!refusal.empty())
        throw InputError(
            "the uncertainty of a picture is drawn by the engine beams, which cannot draw "
            "this scene: " +
            refusal);
    return plan;
}

}  // namespace

PictureUncertainty picture_uncertainty(const Scene& scene, const ScenePlan& plan,
                                       const StoneUncertainty& uncertainty, int draws,
                                       const Progress& progress) {
    check(draws >= 2, "a standard deviation needs two draws");
    if (!scene.stone.convex)
        throw InputError("only convex stones are drawn from their uncertainty");
    const std::size_t pixels = static_cast<std::size_t>(scene.camera.width) *
                               static_cast<std::size_t>(scene.camera.height);
    const std::size_t most = k_most_kept / std::max<std::size_t>(pixels, 1);
    if (static_cast<std::size_t>(draws) > most)
        throw InputError(fmt::format(
            "{} draws of {} x {} pixels do not fit in memory: --draws {}, or a smaller picture",
            draws, scene.camera.width, scene.camera.height, most));
    const ScenePlan beams = by_beams(scene, plan);
    const Vec3 up = up_of(scene.stone);
    const Stone upright = standing_upright(scene.stone);
    StoneDraws stones(upright.solid, uncertainty, scene.settings.seed);
    PixelSums sums(pixels);
    PictureUncertainty result;
    result.correlated = uncertainty.correlated();
    for (int draw = 0; draw < draws; ++draw) {
        const auto part = [&](double done) { return !progress || progress((draw + done) / draws); };
        if (!part(0)) throw Interrupted();
        std::optional<Solid> drawn = stones.next();
        if (!drawn) {
            ++result.left_out;
            continue;
        }
        Scene one = scene;
        one.stone.solid = turned_back(std::move(*drawn), up);
        sums.add(render_as_planned(one, beams, part).picture);
    }
    result.draws = sums.count();
    if (result.draws < 2)
        throw InputError(
            fmt::format("only {} of {} random stones are closed: the fit does not determine the "
                        "stone, take more readings",
                        result.draws, draws));
    for (std::size_t p = 0; p < pixels; ++p) {
        for (std::size_t c = 0; c < 3; ++c) {
            result.mean.push_back(sums.mean(p, c));
            result.sigma.push_back(sums.sigma(p, c));
        }
        result.sigma_luminance.push_back(sums.sigma(p, 3));
        const std::array<float, 4> bands = sums.bands(p);
        result.bands.insert(result.bands.end(), bands.begin(), bands.end());
    }
    return result;
}

void add_layers(const PictureUncertainty& uncertainty, Picture& picture) {
    constexpr std::array<const char*, 3> k_channels{"R", "G", "B"};
    const std::size_t pixels = picture.pixels();
    const auto add = [&](const char* layer, const std::vector<float>& values) {
        for (std::size_t c = 0; c < 3; ++c) {
            std::vector<float> plane(pixels);
            for (std::size_t p = 0; p < pixels; ++p) plane[p] = values[3 * p + c];
            picture.planes.push_back({fmt::format("{}.{}", layer, k_channels[c]), plane});
        }
    };
    add("mean", uncertainty.mean);
    add("sigma", uncertainty.sigma);
    picture.planes.push_back({"sigma.Y", uncertainty.sigma_luminance});
    for (std::size_t k = 0; k < k_band_channels.size(); ++k) {
        std::vector<float> plane(pixels);
        for (std::size_t p = 0; p < pixels; ++p) plane[p] = uncertainty.bands[4 * p + k];
        picture.planes.push_back({k_band_channels[k], plane});
    }
}

}  // namespace culet
