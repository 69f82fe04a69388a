#include "compare/calibration/calibration_plan.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "compare/calibration/facet_tilts.h"
#include "compare/calibration/sensitivity.h"
#include "compare/calibration/stone_samples.h"
#include "stone/solid/checks.h"

namespace culet {

namespace {

// Path weights below which coarser pictures leave paths out.
constexpr std::array k_cuts{0.003, 0.01, 0.03};
constexpr int k_enough_rounds = 4, k_least_rounds = 2;
// Alternatives that are drawn once: the symmetrical stone, two materials, six small errors.
constexpr double k_single_draws = 9;
constexpr double k_nulls = 3, k_null_draws = 3;  // per round: light, pose, both; draws of each
// Measured cost of photographing, aligning and scoring one picture, nanoseconds per pixel.
constexpr double k_scoring_ns = 800;

struct Price {
    double round = 0, single = 0, tilts = 0;
    int rounds_within(double ns, bool with_tilts) const {
        return static_cast<int>((ns - single - (with_tilts ? tilts : 0)) / round);
    }
};

Price price_of(const Scene& model, const DraftRenderer& renderer, bool with_tilts) {
    const double picture = renderer.worked_ns();
    const double pixels = static_cast<double>(model.camera.width) * model.camera.height;
    const double draw = picture + k_scoring_ns * pixels;
    Price price;
    price.round =
        draw * (static_cast<double>(facet_errors_deg().size()) + 0.5 + k_nulls * k_null_draws);
    price.single = k_single_draws * draw;
    if (with_tilts && is_convex(model.stone.solid) && renderer.sketch(sampled_scene(model)))
        price.tilts =
            FacetTilts::sketches_for(model.stone.solid) * (renderer.worked_ns() - picture);
    return price;
}

}  // namespace

CalibrationPlan plan_calibration(const Scene& model, const DraftRenderer& fine, int most_rounds,
                                 double allowed_ns, bool photometric) {
    if (!(allowed_ns > 0)) return {fine.coarser(model, k_cuts.front()), most_rounds, photometric};
    const int enough = std::min(k_enough_rounds, most_rounds);
    for (const double cut : k_cuts) {
        DraftRenderer renderer = fine.coarser(model, cut);
        const Price price = price_of(model, renderer, photometric);
        const int rounds = price.rounds_within(allowed_ns, photometric);
        if (rounds >= enough)
            return {std::move(renderer), std::min(rounds, most_rounds), photometric};
        if (cut != k_cuts.back()) continue;
        // Draws come before tilts, because the regression can do without the tilts.
        const bool tilts = photometric && rounds >= k_least_rounds;
        return {std::move(renderer),
                std::clamp(price.rounds_within(allowed_ns, tilts), k_least_rounds, most_rounds),
                tilts};
    }
    return {fine.coarser(model, k_cuts.back()), k_least_rounds, false};
}

}  // namespace culet
