#include "compare/light/view_refinement.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "compare/light/even_directions.h"
#include "compare/light/light_merge.h"
#include "render/colour.h"
#include "render/environment_layout.h"

namespace culet {

namespace {

constexpr double k_pi = std::numbers::pi;
constexpr double k_unknown_distance = 30;  // a start where the distance is found
constexpr double k_unseen = 1e9;
constexpr std::size_t k_pixels = 1500;  // of each picture that are predicted
constexpr double k_floor = 2e-3;        // of the mean luminance, below which stops say nothing

// Parameters: a small rotation (3), the outlines' x, y, radius (2 x 3), 1 / distance, log2 gain.
constexpr int k_parameters = 11;
using Parameters = Eigen::Matrix<double, k_parameters, 1>;
/// Differences in stops, second plus gain less first; k_unseen where a side sees nothing.
using Residuals = std::function<std::vector<double>(const Parameters&)>;

glm::dmat3 turn(const Vec3& rotation) {
    const double angle = glm::length(rotation);
    if (angle < 1e-15) return glm::dmat3(1.0);
    return glm::mat3_cast(glm::angleAxis(angle, rotation / angle));
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

struct Problem {
    const BallView &first, &second;
    ViewPrior first_prior, second_prior;
    glm::dmat3 start{1.0};
    bool find_distance = false;

    glm::dmat3 rotation(const Parameters& p) const { return turn({p[0], p[1], p[2]}) * start; }
    MirrorBall ball(const Parameters& p, bool is_second) const {
        ViewPrior prior = is_second ? second_prior : first_prior;
        const int at = is_second ? 6 : 3;
        prior.circle.x += p[at];
        prior.circle.y += p[at + 1];
        prior.circle.radius += p[at + 2];
        return ball_of(prior, 1 / std::max(p[9], 1e-6));
    }
};

struct Solution {
    Parameters at = Parameters::Zero();
    double residual = 0, sigma = 0;
};

class LeastSquares {
public:
    LeastSquares(const Problem& problem, Residuals residuals, std::vector<double> weights)
        : residuals_(std::move(residuals)), weights_(std::move(weights)) {
        middle_[9] = 1 / k_unknown_distance;
        for (int k = 0; k < 9; ++k) {
            if (k < 3) {
                step_[k] = 1e-4;
                continue;
            }
            const double sigma =
                (k < 6 ? problem.first_prior : problem.second_prior).circle_sigma_px;
            step_[k] = sigma > 0 ? 0.05 : 0;
            prior_[k] = sigma > 0 ? 1 / (sigma * sigma) : 0;
        }
        step_[9] = problem.find_distance ? 1e-3 : 0;
        prior_[9] = 1 / (0.05 * 0.05);
        step_[10] = 1;  // linear: its column is known
    }

    Solution solve(Solution result) const {
        // Gain first, by the median.
        std::vector<double> r = residuals_(result.at), known;
        for (std::size_t i = 0; i < r.size(); ++i)
            if (r[i] < k_unseen && weights_[i] > 0) known.push_back(r[i]);
        result.at[10] -= median(std::move(known));
        r = residuals_(result.at);
        double damping = 1e-3, scale = scale_of(r, result.at), cost = cost_of(r, scale, result.at);
        for (int iteration = 0; iteration < 12; ++iteration) {
            Eigen::Matrix<double, k_parameters, k_parameters> normal;
            Parameters gradient, moved = Parameters::Zero();
            normal_equations(r, scale, result.at, normal, gradient);
            bool better = false;
            for (int attempt = 0; attempt < 5 && !better; ++attempt) {
                auto damped = normal;
                for (int k = 0; k < k_parameters; ++k) damped(k, k) *= 1 + damping;
                moved = -damped.ldlt().solve(gradient);
                if (!moved.allFinite()) break;
                Parameters p = result.at + moved;
                p[9] = std::clamp(p[9], 1e-6, 0.5);
                std::vector<double> tried = residuals_(p);
                if (cost_of(tried, scale, p) < cost) {
                    better = true;
                    result.at = p;
                    r = std::move(tried);
                    damping = std::max(damping / 5, 1e-9);
                } else {
                    damping *= 8;
                }
            }
            const Eigen::Matrix3d turned = normal.inverse().topLeftCorner<3, 3>();
            result.sigma = std::sqrt(std::max(turned.trace() / 3, 0.0));
            if (!better) break;
            scale = scale_of(r, result.at);
            cost = cost_of(r, scale, result.at);
            if (moved.head<3>().norm() < 1e-6 && moved.segment<6>(3).norm() < 2e-3) break;
        }
        std::vector<double> sizes;
        for (std::size_t i = 0; i < r.size(); ++i)
            if (r[i] < k_unseen && weights_[i] > 0) sizes.push_back(std::abs(r[i]));
        result.residual = median(std::move(sizes));
        return result;
    }

private:
    // The spread of residuals where the pictures have structure: walls of one colour agree
    // whatever the turn, and would make every edge an outlier.
    double scale_of(const std::vector<double>& r, Parameters p) const {
        for (int k = 0; k < 3; ++k) p[k] += 1e-3;
        const std::vector<double> moved = residuals_(p);
        std::vector<std::pair<double, double>> by_structure;
        for (std::size_t i = 0; i < r.size(); ++i) {
            if (r[i] < k_unseen && moved[i] < k_unseen && weights_[i] > 0)
                by_structure.emplace_back(std::abs(moved[i] - r[i]), std::abs(r[i]));
        }
        const std::size_t kept = by_structure.size() / 5;
        if (kept < 20) return 1.0;
        std::nth_element(by_structure.begin(),
                         by_structure.begin() + static_cast<std::ptrdiff_t>(kept),
                         by_structure.end(), std::greater<>());
        std::vector<double> sizes;
        for (std::size_t i = 0; i < kept; ++i) sizes.push_back(by_structure[i].second);
        return std::max(1.4826 * median(std::move(sizes)), 1e-3);
    }

    // Cauchy's loss at twice the scale: photographers, lamps that moved.
    double cost_of(const std::vector<double>& r, double scale, const Parameters& p) const {
        double cost = 0;
        for (int k = 0; k < k_parameters; ++k)
            cost += prior_[k] * (p[k] - middle_[k]) * (p[k] - middle_[k]);
        for (std::size_t i = 0; i < r.size(); ++i) {
            if (weights_[i] <= 0) continue;
            const double v = r[i] < k_unseen ? r[i] : 4 * scale;  // losing overlap gains nothing
            const double x = v / (2 * scale);
            cost += weights_[i] * 4 * std::log1p(x * x);
        }
        return cost;
    }

    void normal_equations(const std::vector<double>& r, double scale, const Parameters& at,
                          Eigen::Matrix<double, k_parameters, k_parameters>& normal,
                          Parameters& gradient) const {
        std::array<std::vector<double>, k_parameters> moved;
        for (int k = 0; k < 10; ++k) {
            if (step_[k] == 0) continue;
            Parameters p = at;
            p[k] += step_[k];
            moved[static_cast<std::size_t>(k)] = residuals_(p);
        }
        normal.setZero();
        gradient.setZero();
        for (std::size_t i = 0; i < r.size(); ++i) {
            if (r[i] >= k_unseen || weights_[i] <= 0) continue;
            Parameters row = Parameters::Zero();
            bool whole = true;
            for (int k = 0; k < 10 && whole; ++k) {
                if (step_[k] == 0) continue;
                const double to = moved[static_cast<std::size_t>(k)][i];
                whole = to < k_unseen;
                row[k] = (to - r[i]) / step_[k];
            }
            if (!whole) continue;
            row[10] = 1;
            const double x = r[i] / (2 * scale);
            const double w = weights_[i] / (scale * scale) / (1 + x * x);
            normal.noalias() += w * row * row.transpose();
            gradient += w * r[i] * row;
        }
        for (int k = 0; k < k_parameters; ++k) {
            normal(k, k) += prior_[k];
            gradient[k] += prior_[k] * (at[k] - middle_[k]);
            if (step_[k] == 0) normal(k, k) += 1e30;
        }
    }

    Residuals residuals_;
    std::vector<double> weights_;
    Parameters step_ = Parameters::Zero(), prior_ = Parameters::Zero(),
               middle_ = Parameters::Zero();
};

// ---- direction by direction ----

double mean_luminance(const Photo& picture) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) sum += luminance(&picture.rgb[i]);
    return std::max(sum / static_cast<double>(picture.rgb.size() / 3), 1e-30);
}

// In stops above the floor of its picture; linear light is blurred, not stops.
cv::Mat log_luminance(const Photo& picture, double floor, double sigma_px) {
    cv::Mat plane(picture.height, picture.width, CV_32F);
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * picture.width + x;
            plane.at<float>(y, x) = static_cast<float>(luminance(&picture.rgb[3 * i]));
        }
    }
    if (sigma_px > 0) cv::GaussianBlur(plane, plane, {}, sigma_px, sigma_px, cv::BORDER_REPLICATE);
    for (int y = 0; y < plane.rows; ++y) {
        float* row = plane.ptr<float>(y);
        for (int x = 0; x < plane.cols; ++x) row[x] = static_cast<float>(std::log2(row[x] + floor));
    }
    return plane;
}

double bilinear(const cv::Mat& plane, const PixelPlace& place) {
    const double x = std::clamp(place.x, 0.0, plane.cols - 1.001);
    const double y = std::clamp(place.y, 0.0, plane.rows - 1.001);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const double u = x - x0, v = y - y0;
    const float *a = plane.ptr<float>(y0) + x0, *b = plane.ptr<float>(y0 + 1) + x0;
    return (1 - v) * ((1 - u) * a[0] + u * a[1]) + v * ((1 - u) * b[0] + u * b[1]);
}

Solution by_direction(const Problem& problem, const Solution& start, double sigma_px) {
    std::vector<Vec3> directions;
    std::vector<double> weights;
    const glm::dmat3 back = glm::transpose(problem.rotation(start.at));
    for (const Vec3& d : even_directions(6000)) {
        const double a = problem.first.quality(d), b = problem.second.quality(back * d);
        if (a < 1e-2 || b < 1e-2) continue;
        directions.push_back(d);
        weights.push_back(std::sqrt(a * b));
    }
    const Photo &one = *problem.first.picture, &two = *problem.second.picture;
    const cv::Mat first = log_luminance(one, k_floor * mean_luminance(one), sigma_px);
    const cv::Mat second = log_luminance(two, k_floor * mean_luminance(two), sigma_px);
    const Residuals residuals = [&](const Parameters& p) {
        std::vector<double> r(directions.size(), k_unseen);
        const MirrorBall a = problem.ball(p, false), b = problem.ball(p, true);
        const glm::dmat3 second_from_first = glm::transpose(problem.rotation(p));
        tbb::parallel_for(std::size_t{0}, r.size(), [&](std::size_t i) {
            const auto in_a = a.place_of(directions[i]);
            const auto in_b = b.place_of(second_from_first * directions[i]);
            if (in_a && in_b) r[i] = bilinear(second, *in_b) + p[10] - bilinear(first, *in_a);
        });
        return r;
    };
    return LeastSquares(problem, residuals, weights).solve(start);
}

// ---- each picture predicted from the other ----

// What one view alone knows, sharpened, in its camera's frame; the ball as it was taken to be.
struct OwnMap {
    EnvironmentMap map;
    MirrorBall ball;
    double floor = 0;
};

OwnMap own_map(const BallView& view, const MirrorBall& ball, int width) {
    BallView alone = view;
    alone.ball = ball;
    alone.world_from_camera = glm::dmat3(1.0);
    return {merge_views({alone}, {1.0}, width, 6).map, ball,
            k_floor * mean_luminance(*view.picture)};
}

double luminance_at(const EnvironmentMap& map, const Vec3& direction) {
    const Rgb rgb = map.at(direction);
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

struct Pixel {
    PixelPlace place;
    double taken = 0;  // stops above the floor
    double weight = 0;
};

// Pixels of one view whose directions the other shows well, spread evenly.
std::vector<Pixel> pixels_seen_by_both(const BallView& own, const MirrorBall& ball, double floor,
                                       const BallView& other, const glm::dmat3& other_from_own,
                                       std::size_t most) {
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
                {place, std::log2(luminance(&picture.rgb[3 * i]) + floor), std::sqrt(a * b)});
        }
    }
    // Every k-th, with k odd against rows of even length.
    const std::size_t stride = (pixels.size() / most) | 1;
    std::vector<Pixel> kept;
    for (std::size_t i = stride / 2; i < pixels.size(); i += stride) kept.push_back(pixels[i]);
    return kept;
}

// Stops above the floor that `pixel` of a ball would show if the other view's map were the light.
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
            // The other ball is taken for another one by now: the pixel that shows the direction,
            // and where the map has what that pixel showed.
            const auto place = other.place_of(in_map);
            const auto moved = place ? map.ball.direction_of(*place) : std::nullopt;
            if (!moved) return k_unseen;
            in_map = *moved;
        }
        sum += luminance_at(map.map, in_map);
    }
    return std::log2(sum / (steps * steps) + map.floor);
}

Solution by_prediction(const Problem& problem, const Solution& start, int width) {
    const OwnMap first_map = own_map(problem.first, problem.ball(start.at, false), width);
    const OwnMap second_map = own_map(problem.second, problem.ball(start.at, true), width);
    const glm::dmat3 now = problem.rotation(start.at);
    const std::vector<Pixel> in_first =
        pixels_seen_by_both(problem.first, first_map.ball, first_map.floor, problem.second,
                            glm::transpose(now), k_pixels);
    const std::vector<Pixel> in_second = pixels_seen_by_both(
        problem.second, second_map.ball, second_map.floor, problem.first, now, k_pixels);
    std::vector<double> weights;
    for (const Pixel& pixel : in_first) weights.push_back(pixel.weight);
    for (const Pixel& pixel : in_second) weights.push_back(pixel.weight);
    const double texel = std::sqrt(2.0) * k_pi / width;
    const double size = std::sqrt(first_map.ball.solid_angle_per_pixel());
    const int steps = std::clamp(static_cast<int>(std::ceil(size / texel)), 2, 3);
    const Residuals residuals = [&](const Parameters& p) {
        std::vector<double> r(weights.size(), k_unseen);
        const MirrorBall a = problem.ball(p, false), b = problem.ball(p, true);
        const glm::dmat3 first_from_second = problem.rotation(p);
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
    return LeastSquares(problem, residuals, weights).solve(start);
}

// Of stops, over what both show well.
double correlation_of(const Problem& problem, const Parameters& p) {
    const MirrorBall a = problem.ball(p, false), b = problem.ball(p, true);
    const glm::dmat3 back = glm::transpose(problem.rotation(p));
    const Photo &one = *problem.first.picture, &two = *problem.second.picture;
    const cv::Mat first = log_luminance(one, k_floor * mean_luminance(one), 1);
    const cv::Mat second = log_luminance(two, k_floor * mean_luminance(two), 1);
    double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    for (const Vec3& d : even_directions(16000)) {
        const double qa = problem.first.quality(d), qb = problem.second.quality(back * d);
        if (qa < 1e-2 || qb < 1e-2) continue;
        const auto in_a = a.place_of(d), in_b = b.place_of(back * d);
        if (!in_a || !in_b) continue;
        const double w = std::sqrt(qa * qb), u = bilinear(first, *in_a),
                     v = bilinear(second, *in_b);
        n += w;
        sa += w * u;
        sb += w * v;
        saa += w * u * u;
        sbb += w * v * v;
        sab += w * u * v;
    }
    const double va = n * saa - sa * sa, vb = n * sbb - sb * sb;
    return va > 0 && vb > 0 ? (n * sab - sa * sb) / std::sqrt(va * vb) : 0;
}

// First over second, from linear light: the median over blocks of directions of the ratio of what
// they hold. Sums of light do not care about blur, which shifts medians of stops.
double gain_of(const Problem& problem, const Parameters& p) {
    constexpr int k_width = 256, k_block = 8;
    BallView a = problem.first, b = problem.second;
    a.ball = problem.ball(p, false);
    b.ball = problem.ball(p, true);
    b.world_from_camera = problem.rotation(p);
    const ViewMap first = view_map(a, k_width), second = view_map(b, k_width);
    std::vector<std::pair<double, double>> ratios;  // stops, weight
    double all = 0;
    for (int y = 0; y < first.height; y += k_block) {
        for (int x = 0; x < k_width; x += k_block) {
            double one = 0, two = 0, weight = 0;
            for (int k = 0; k < k_block * k_block; ++k) {
                const int row = y + k / k_block;
                const std::size_t i = static_cast<std::size_t>(row) * k_width + x + k % k_block;
                if (first.quality[i] < 1e-2f || second.quality[i] < 1e-2f || first.over[i] > 0 ||
                    second.over[i] > 0)
                    continue;
                const double w = std::sqrt(first.quality[i] * second.quality[i]) *
                                 lat_long_solid_angle(row, k_width, first.height);
                one += w * luminance(&first.rgb[3 * i]);
                two += w * luminance(&second.rgb[3 * i]);
                weight += w;
            }
            if (one <= 0 || two <= 0) continue;
            ratios.emplace_back(std::log2(one / two), weight);
            all += weight;
        }
    }
    std::sort(ratios.begin(), ratios.end());
    double sum = 0;
    for (const auto& [stops, weight] : ratios) {
        sum += weight;
        if (sum >= all / 2) return std::exp2(stops);
    }
    return std::exp2(p[10]);
}

}  // namespace

RefinedViews refine_views(const BallView& first, const ViewPrior& first_prior,
                          const BallView& second, const ViewPrior& second_prior,
                          const glm::dmat3& first_from_second) {
    Problem problem{first, second, first_prior, second_prior, first_from_second, false};
    problem.find_distance = (first_prior.focal_px <= 0 && first_prior.distance <= 0) ||
                            (second_prior.focal_px <= 0 && second_prior.distance <= 0);
    Solution solution;
    solution.at[9] = 1 / k_unknown_distance;
    const double radius = std::min(first_prior.circle.radius, second_prior.circle.radius);
    for (const double sigma_px : {radius / 60, std::max(radius / 200, 1.0)})
        solution = by_direction(problem, solution, sigma_px);
    const int width = std::clamp(1 << static_cast<int>(std::log2(k_pi * radius)), 128, 1024);
    for (int round = 0; round < 2; ++round) solution = by_prediction(problem, solution, width);
    return {problem.rotation(solution.at),
            problem.ball(solution.at, false),
            problem.ball(solution.at, true),
            gain_of(problem, solution.at),
            solution.residual,
            correlation_of(problem, solution.at),
            solution.sigma};
}

}  // namespace culet
