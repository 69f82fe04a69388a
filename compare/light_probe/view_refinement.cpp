#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>
#include <numbers>
#include <opencv2/core.hpp>

#include "compare/light_probe/even_directions.h"
#include "compare/light_probe/light_merge.h"
#include "compare/light_probe/view_agreement.h"
#include "compare/light_probe/view_alignment.h"
#include "compare/pose/stone_view.h"
#include "render/colour/colour.h"

namespace culet {

namespace {

constexpr std::size_t k_pixels = 1500;  // predicted in each picture
constexpr std::size_t k_trials = 4;
// The root mean square of six normal errors exceeds this in one of 350 cases (chi-square over
// 19.9).
constexpr double k_doubtful_moves = 1.82;
constexpr int k_most_doubts = 4;

// ---- direction by direction ----

ViewSolution by_direction(const ViewPair& pair, const ViewSolution& start, double sigma_px) {
    std::vector<ViewCorrespondence> correspondences;
    const glm::dmat3 back = glm::transpose(pair.rotation(start.at));
    for (const Vec3& d : even_directions(6000)) {
        const double a = pair.first.quality(d), b = pair.second.quality(back * d);
        if (a < 1e-2 || b < 1e-2) continue;
        correspondences.push_back({std::sqrt(a * b), d});
    }
    const Photo &one = *pair.first.picture, &two = *pair.second.picture;
    const cv::Mat first = stops_of(one, sigma_px);
    const cv::Mat second = stops_of(two, sigma_px);
    const ViewResiduals residuals = [&](const ViewParameters& p) {
        std::vector<double> r(correspondences.size(), k_unseen);
        const MirrorBall a = pair.ball(p, false), b = pair.ball(p, true);
        const glm::dmat3 second_from_first = glm::transpose(pair.rotation(p));
        tbb::parallel_for(std::size_t{0}, r.size(), [&](std::size_t i) {
            const auto in_a = a.place_of(correspondences[i].direction);
            const auto in_b = b.place_of(second_from_first * correspondences[i].direction);
            if (in_a && in_b) r[i] = stops_at(second, *in_b) + p[10] - stops_at(first, *in_a);
        });
        return r;
    };
    return solve_views(pair, correspondences, residuals, start);
}

// ---- each picture predicted from the other ----

// A sharpened map from one view alone, in its camera's frame, and the ball assumed for it.
struct OwnMap {
    EnvironmentMap map;
    MirrorBall ball;
    double floor = 0;
    glm::dmat3 map_from_camera{1.0};
};

OwnMap own_map(const BallView& view, const MirrorBall& ball, int width,
               const glm::dmat3& map_from_camera) {
    BallView alone = view;
    alone.ball = ball;
    alone.world_from_camera = map_from_camera;
    return {merge_views({alone}, {1.0}, width, 6).map, ball, floor_of(*view.picture),
            map_from_camera};
}

struct Pixel {
    PixelPlace place;
    double taken = 0;  // stops above the floor
    double weight = 0;
    Vec3 direction{0};  // in the camera's frame
};

// Pixels of one view whose directions the other shows well, spread evenly: one of k_trials disjoint
// sets.
std::vector<Pixel> pixels_seen_by_both(const BallView& own, const MirrorBall& ball, double floor,
                                       const BallView& other, const glm::dmat3& other_from_own,
                                       std::size_t trial) {
    std::vector<Pixel> pixels;
    const Photo& picture = *own.picture;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const PixelPlace place{static_cast<double>(x), static_cast<double>(y)};
            const auto d = ball.direction_of(place);
            if (!d) continue;
            const std::size_t i = static_cast<std::size_t>(y) * picture.width + x;
            const double a = own.quality(*d), b = other.quality(other_from_own * *d);
            const bool over = !picture.saturated.empty() && picture.saturated[i] > 0;
            if (a < 2e-2 || b < 2e-2 || over) continue;
            pixels.push_back(
                {place, std::log2(luminance(&picture.rgb[3 * i]) + floor), std::sqrt(a * b), *d});
        }
    }
    // Every k-th pixel, with k odd because rows may have even lengths.
    const std::size_t stride = std::max(pixels.size() / k_pixels, k_trials) | 1;
    std::vector<Pixel> kept;
    for (std::size_t i = trial * stride / k_trials; i < pixels.size(); i += stride)
        kept.push_back(pixels[i]);
    return kept;
}

// Stops above the floor that `pixel` would show if the other view's map were the light.
double predicted(const Pixel& pixel, int steps, const MirrorBall& own,
                 const glm::dmat3& other_from_own, const MirrorBall& other, const OwnMap& map) {
    const BallCircle &now = other.circle(), &then = map.ball.circle();
    const bool same_ball = now.x == then.x && now.y == then.y && now.radius == then.radius &&
                           other.distance() == map.ball.distance();
    double sum = 0;
    for (int k = 0; k < steps * steps; ++k) {
        const auto d = own.direction_of({pixel.place.x - 0.5 + (k % steps + 0.5) / steps,
                                         pixel.place.y - 0.5 + (k / steps + 0.5) / steps});
        if (!d) return k_unseen;
        Vec3 in_map = other_from_own * *d;
        if (!same_ball) {
            // The other ball's geometry has changed since its map was made: go through the pixel
            // that shows the direction now.
            const auto place = other.place_of(in_map);
            const auto moved = place ? map.ball.direction_of(*place) : std::nullopt;
            if (!moved) return k_unseen;
            in_map = *moved;
        }
        sum += luminance(map.map.at(map.map_from_camera * in_map));
    }
    return std::log2(sum / (steps * steps) + map.floor);
}

ViewSolution by_prediction(const ViewPair& pair, const ViewSolution& start, int width,
                           std::size_t trial) {
    // Each trial's texel grid has another orientation.
    const glm::dmat3 grid = rotation_by(static_cast<double>(trial) * Vec3(0.71, 0.53, 0.37));
    const OwnMap first_map = own_map(pair.first, pair.ball(start.at, false), width, grid);
    const OwnMap second_map = own_map(pair.second, pair.ball(start.at, true), width, grid);
    const glm::dmat3 now = pair.rotation(start.at);
    const std::vector<Pixel> in_first = pixels_seen_by_both(
        pair.first, first_map.ball, first_map.floor, pair.second, glm::transpose(now), trial);
    const std::vector<Pixel> in_second =
        pixels_seen_by_both(pair.second, second_map.ball, second_map.floor, pair.first, now, trial);
    std::vector<ViewCorrespondence> correspondences;
    for (const Pixel& pixel : in_first) correspondences.push_back({pixel.weight, pixel.direction});
    for (const Pixel& pixel : in_second)
        correspondences.push_back({pixel.weight, now * pixel.direction});
    const double texel = std::sqrt(2.0) * std::numbers::pi / width;
    const double size = std::sqrt(first_map.ball.solid_angle_per_pixel());
    const int steps = std::clamp(static_cast<int>(std::ceil(size / texel)), 2, 3);
    const ViewResiduals residuals = [&](const ViewParameters& p) {
        std::vector<double> r(correspondences.size(), k_unseen);
        const MirrorBall a = pair.ball(p, false), b = pair.ball(p, true);
        const glm::dmat3 first_from_second = pair.rotation(p);
        const glm::dmat3 second_from_first = glm::transpose(first_from_second);
        tbb::parallel_for(std::size_t{0}, r.size(), [&](std::size_t i) {
            if (i < in_first.size()) {
                const double v = predicted(in_first[i], steps, a, second_from_first, b, second_map);
                if (v < k_unseen) r[i] = v + p[10] - in_first[i].taken;
            } else {
                const Pixel& pixel = in_second[i - in_first.size()];
                const double v = predicted(pixel, steps, b, first_from_second, a, first_map);
                if (v < k_unseen) r[i] = pixel.taken + p[10] - v;
            }
        });
        return r;
    };
    return solve_views(pair, correspondences, residuals, start);
}

// Root mean square shift of the outlines in sigmas.
double outline_moves(const ViewPair& pair, const ViewParameters& p) {
    double squares = 0, count = 0;
    for (int k = 3; k < 9; ++k) {
        const double sigma = (k < 6 ? pair.first_prior : pair.second_prior).circle_sigma_px;
        if (!(sigma > 0)) continue;
        squares += (p[k] / sigma) * (p[k] / sigma);
        ++count;
    }
    return count > 0 ? std::sqrt(squares / count) : 0;
}

}  // namespace

ViewAlignment align_views(const BallView& first, const ViewPrior& first_prior,
                          const BallView& second, const ViewPrior& second_prior,
                          const RoughTurn& rough) {
    // In camera frames, independent of the views' world frames.
    BallView a = first, b = second;
    a.world_from_camera = b.world_from_camera = glm::dmat3(1.0);
    ViewPair pair{a, b, first_prior, second_prior, rough.first_from_second, false};
    pair.find_distance = (first_prior.focal_px <= 0 && first_prior.distance <= 0) ||
                         (second_prior.focal_px <= 0 && second_prior.distance <= 0);
    ViewSolution solution;
    solution.at[9] = 1 / k_unknown_distance;
    const double radius = std::min(first_prior.circle.radius, second_prior.circle.radius);
    for (const double sigma_px : {radius / 60, std::max(radius / 200, 1.0)})
        solution = by_direction(pair, solution, sigma_px);
    const int width =
        std::clamp(1 << static_cast<int>(std::log2(std::numbers::pi * radius)), 128, 1024);
    solution = by_prediction(pair, solution, width, 0);
    // Outlines that moved by more than their sigmas get larger ones (Birge 1932): light behind a
    // ball may shift its outline.
    for (int round = 0; round < k_most_doubts; ++round) {
        const double moved = outline_moves(pair, solution.at);
        if (!(moved > k_doubtful_moves)) break;
        pair.first_prior.circle_sigma_px *= moved;
        pair.second_prior.circle_sigma_px *= moved;
        solution = by_prediction(pair, solution, width, 0);
    }
    // Disjoint sets of pixels and different texel grids: their differences are sampling errors,
    // which each solution's own sigma does not contain.
    const ViewSolution common = solution;
    std::vector<ViewSolution> trials;
    ViewParameters mean = ViewParameters::Zero();
    for (std::size_t trial = 0; trial < k_trials; ++trial) {
        trials.push_back(by_prediction(pair, common, width, trial));
        mean += trials.back().at / k_trials;
    }
    double scatter = 0, within = 0;
    for (const ViewSolution& t : trials) {
        scatter += (t.at - mean).head<3>().squaredNorm() / (3 * (k_trials - 1));
        within += t.sigma * t.sigma / k_trials;
    }
    solution = trials[0];
    solution.at = mean;
    solution.sigma = std::sqrt(scatter + within);
    return {pair.rotation(solution.at),
            correlation_of(pair, solution.at),
            rough.rival,
            gain_of(pair, solution.at),
            solution.residual,
            solution.sigma,
            pair.ball(solution.at, false),
            pair.ball(solution.at, true),
            rough.ambiguous()};
}

}  // namespace culet
