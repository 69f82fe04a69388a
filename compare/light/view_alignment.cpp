#include "compare/light/view_alignment.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "render/environment_layout.h"
#include "stone/units.h"

namespace culet {

namespace {

constexpr double k_pi = std::numbers::pi;
constexpr double k_unknown_distance = 30;  // a start where the distance is found

std::vector<Vec3> even_directions(int count) {
    std::vector<Vec3> result;
    const double golden = k_pi * (3 - std::sqrt(5.0));
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2.0 * i + 1) / count, r = std::sqrt(1 - z * z);
        result.emplace_back(r * std::cos(golden * i), r * std::sin(golden * i), z);
    }
    return result;
}

// Alexa 2022, Super-Fibonacci Spirals: psi solves psi^4 = psi + 4.
std::vector<glm::dmat3> even_rotations(int count) {
    constexpr double k_phi = std::numbers::sqrt2, k_psi = 1.533751168755204288118041;
    std::vector<glm::dmat3> result;
    for (int i = 0; i < count; ++i) {
        const double s = i + 0.5, t = s / count;
        const double alpha = 2 * k_pi * s / k_phi, beta = 2 * k_pi * s / k_psi;
        const double r = std::sqrt(t), big = std::sqrt(1 - t);
        result.push_back(glm::mat3_cast(glm::dquat(big * std::cos(beta), r * std::sin(alpha),
                                                   r * std::cos(alpha), big * std::sin(beta))));
    }
    return result;
}

glm::dmat3 turn(const Vec3& rotation) {
    const double angle = glm::length(rotation);
    if (angle < 1e-15) return glm::dmat3(1.0);
    return glm::mat3_cast(glm::angleAxis(angle, rotation / angle));
}

double angle_between(const glm::dmat3& a, const glm::dmat3& b) {
    const glm::dmat3 d = glm::transpose(a) * b;
    return std::acos(std::clamp((d[0][0] + d[1][1] + d[2][2] - 1) / 2, -1.0, 1.0));
}

double luminance_of(const float* rgb) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

// Log-luminance of a view in its camera's frame, low-passed, as a lat-long map of its own.
struct SmoothMap {
    int width = 0, height = 0;
    std::vector<float> value, weight;

    void at(const Vec3& d, float& v, float& w) const {
        const MapPlace place = lat_long_place(d, width, height);
        const int x = std::min(static_cast<int>(place.column), width - 1);
        const int y = std::min(static_cast<int>(place.row), height - 1);
        const std::size_t i = static_cast<std::size_t>(y) * width + x;
        v = value[i];
        w = weight[i];
    }
};

// Normalised convolution with a Gaussian over the sphere, cut at 2.5 sigma.
SmoothMap smoothed(const ViewMap& map, double sigma, int width) {
    SmoothMap result{width, width / 2, {}, {}};
    const std::size_t texels = static_cast<std::size_t>(width) * (width / 2);
    result.value.resize(texels);
    result.weight.resize(texels);
    std::vector<Vec3> direction;
    std::vector<float> value, weight, row_of;
    double mean = 0;
    for (std::size_t i = 0; i < map.quality.size(); ++i) mean += luminance_of(&map.rgb[3 * i]);
    mean = std::max(mean / static_cast<double>(map.quality.size()), 1e-30);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * map.width + x;
            direction.push_back(lat_long_direction(x + 0.5, y + 0.5, map.width, map.height));
            value.push_back(
                static_cast<float>(std::log2(luminance_of(&map.rgb[3 * i]) / mean + 1e-3)));
            weight.push_back(static_cast<float>(std::sqrt(map.quality[i]) *
                                                lat_long_solid_angle(y, map.width, map.height)));
        }
    }
    const double reach = 2.5 * sigma, least_cosine = std::cos(reach);
    tbb::parallel_for(0, result.height, [&](int y) {
        for (int x = 0; x < width; ++x) {
            const Vec3 d = lat_long_direction(x + 0.5, y + 0.5, result.width, result.height);
            const double polar = (y + 0.5) * k_pi / result.height;
            const int from = std::max(0, static_cast<int>((polar - reach) / k_pi * map.height));
            const int to = std::min(map.height - 1,
                                    static_cast<int>((polar + reach) / k_pi * map.height));
            double sum = 0, total = 0, bell = 0;
            for (int j = from; j <= to; ++j) {
                for (int i = 0; i < map.width; ++i) {
                    const std::size_t k = static_cast<std::size_t>(j) * map.width + i;
                    const double cosine = glm::dot(d, direction[k]);
                    if (cosine < least_cosine) continue;
                    const double g = std::exp((cosine - 1) / (sigma * sigma));
                    sum += g * weight[k] * value[k];
                    total += g * weight[k];
                    bell += g * lat_long_solid_angle(j, map.width, map.height);
                }
            }
            const std::size_t at = static_cast<std::size_t>(y) * width + x;
            result.value[at] = total > 0 ? static_cast<float>(sum / total) : 0;
            result.weight[at] = bell > 0 ? static_cast<float>(total / bell) : 0;
        }
    });
    return result;
}

struct SmoothPoints {
    std::vector<Vec3> direction;
    std::vector<float> value, weight;
};
SmoothPoints points_of(const SmoothMap& map, int count) {
    SmoothPoints points;
    for (const Vec3& d : even_directions(count)) {
        float v = 0, w = 0;
        map.at(d, v, w);
        if (w < 0.05f) continue;
        points.direction.push_back(d);
        points.value.push_back(v);
        points.weight.push_back(w);
    }
    return points;
}

// Weighted correlation; too small an overlap is no evidence.
double correlation(const SmoothPoints& first, const SmoothMap& second,
                   const glm::dmat3& first_from_second, double least_weight) {
    const glm::dmat3 second_from_first = glm::transpose(first_from_second);
    double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    for (std::size_t i = 0; i < first.direction.size(); ++i) {
        float v = 0, w = 0;
        second.at(second_from_first * first.direction[i], v, w);
        const double k = static_cast<double>(w) * first.weight[i], a = first.value[i], b = v;
        n += k;
        sa += k * a;
        sb += k * b;
        saa += k * a * a;
        sbb += k * b * b;
        sab += k * a * b;
    }
    if (n <= 0) return -1;
    const double va = saa - sa * sa / n, vb = sbb - sb * sb / n;
    if (va <= 1e-9 * n || vb <= 1e-9 * n) return 0;
    const double r = (sab - sa * sb / n) / std::sqrt(va * vb);
    return n < least_weight ? r * n / least_weight : r;
}

struct Candidate {
    glm::dmat3 rotation{1.0};
    double score = -1;
};

// Up the hill along six directions, with shrinking steps.
Candidate climbed(const SmoothPoints& points, const SmoothMap& map, Candidate at, double step,
                  double least_step, double least_weight) {
    at.score = correlation(points, map, at.rotation, least_weight);
    while (step > least_step) {
        Candidate best = at;
        for (int k = 0; k < 6; ++k) {
            Vec3 axis(0);
            axis[k / 2] = k % 2 == 0 ? step : -step;
            const glm::dmat3 tried = turn(axis) * at.rotation;
            const double score = correlation(points, map, tried, least_weight);
            if (score > best.score) best = {tried, score};
        }
        if (best.score > at.score) {
            at = best;
        } else {
            step /= 2;
        }
    }
    return at;
}

std::vector<Candidate> distinct(std::vector<Candidate> list, double apart, std::size_t most) {
    std::sort(list.begin(), list.end(),
              [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    std::vector<Candidate> kept;
    for (const Candidate& c : list) {
        const bool near = std::any_of(kept.begin(), kept.end(), [&](const Candidate& k) {
            return angle_between(k.rotation, c.rotation) < apart;
        });
        if (!near) kept.push_back(c);
        if (kept.size() == most) break;
    }
    return kept;
}

struct CoarseResult {
    Candidate best;
    double rival = -1;
};

CoarseResult over_all_rotations(const ViewMap& first, const ViewMap& second) {
    // Half as much common weight as two views at right angles have is asked for.
    const auto asked = [](const SmoothPoints& points, const SmoothMap& map) {
        double weight = 0;
        for (int k = 0; k < 2; ++k) {
            const glm::dmat3 quarter = turn({0, k == 0 ? k_pi / 2 : -k_pi / 2, 0});
            double sum = 0;
            for (std::size_t i = 0; i < points.direction.size(); ++i) {
                float v = 0, w = 0;
                map.at(glm::transpose(quarter) * points.direction[i], v, w);
                sum += static_cast<double>(w) * points.weight[i];
            }
            weight = std::max(weight, sum);
        }
        return weight / 2;
    };
    const SmoothMap coarse = smoothed(second, radians(6), 96);
    const SmoothPoints few = points_of(smoothed(first, radians(6), 96), 600);
    const double coarse_weight = asked(few, coarse);
    const std::vector<glm::dmat3> rotations = even_rotations(24000);  // about 9 degrees apart
    std::vector<Candidate> all(rotations.size());
    tbb::parallel_for(std::size_t{0}, rotations.size(), [&](std::size_t i) {
        all[i] = {rotations[i], correlation(few, coarse, rotations[i], coarse_weight)};
    });
    // The usual turns, which win where nothing speaks against them.
    for (const double degrees : {90.0, -90.0})
        all.push_back({turn({0, radians(degrees), 0}),
                       correlation(few, coarse, turn({0, radians(degrees), 0}), coarse_weight)});
    std::vector<Candidate> best = distinct(all, radians(12), 24);
    tbb::parallel_for(std::size_t{0}, best.size(), [&](std::size_t i) {
        best[i] = climbed(few, coarse, best[i], radians(5), radians(1), coarse_weight);
    });
    best = distinct(best, radians(6), 8);
    const SmoothMap fine = smoothed(second, radians(1.5), 256);
    const SmoothPoints many = points_of(smoothed(first, radians(1.5), 256), 6000);
    const double fine_weight = asked(many, fine);
    tbb::parallel_for(std::size_t{0}, best.size(), [&](std::size_t i) {
        best[i] = climbed(many, fine, best[i], radians(2), radians(0.2), fine_weight);
    });
    best = distinct(best, radians(6), 8);
    return {best.front(), best.size() > 1 ? best[1].score : -1.0};
}

// ---- the fine part: least squares on the pictures themselves ----

// Parameters: a small rotation (3), the outlines' x, y, radius (2 x 3), 1 / distance, log2 gain.
constexpr int k_parameters = 11;
using Parameters = Eigen::Matrix<double, k_parameters, 1>;

cv::Mat log_luminance(const Photo& picture, double sigma_px) {
    cv::Mat plane(picture.height, picture.width, CV_32F);
    double mean = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * picture.width + x;
            plane.at<float>(y, x) = static_cast<float>(luminance_of(&picture.rgb[3 * i]));
            mean += plane.at<float>(y, x);
        }
    }
    mean = std::max(mean / static_cast<double>(plane.total()), 1e-30);
    if (sigma_px > 0.3) cv::GaussianBlur(plane, plane, {}, sigma_px, sigma_px, cv::BORDER_REPLICATE);
    for (int y = 0; y < plane.rows; ++y) {
        float* row = plane.ptr<float>(y);
        for (int x = 0; x < plane.cols; ++x)
            row[x] = static_cast<float>(std::log2(row[x] + 1e-3 * mean));
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

struct FineProblem {
    const BallView &first, &second;
    ViewPrior first_prior, second_prior;
    glm::dmat3 start{1.0};
    std::vector<Vec3> directions;  // in the first camera's frame
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

constexpr double k_unseen = 1e9;

std::vector<double> seen(const FineProblem& problem, const Parameters& p, bool is_second,
                         const cv::Mat& plane) {
    std::vector<double> values(problem.directions.size(), k_unseen);
    const MirrorBall ball = problem.ball(p, is_second);
    const glm::dmat3 second_from_first = glm::transpose(problem.rotation(p));
    tbb::parallel_for(std::size_t{0}, values.size(), [&](std::size_t i) {
        const Vec3 d =
            is_second ? second_from_first * problem.directions[i] : problem.directions[i];
        if (const auto place = ball.place_of(d)) values[i] = bilinear(plane, *place);
    });
    return values;
}

struct FineResult {
    Parameters at = Parameters::Zero();
    double residual = 0, correlation = 0, sigma = 0;
};

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

FineResult least_squares(const FineProblem& problem, FineResult result, double sigma_px) {
    const cv::Mat first = log_luminance(*problem.first.picture, sigma_px);
    const cv::Mat second = log_luminance(*problem.second.picture, sigma_px);
    const std::size_t n = problem.directions.size();
    // Weights stay as they are at the start of the level.
    std::vector<double> weight(n);
    {
        const glm::dmat3 back = glm::transpose(problem.rotation(result.at));
        for (std::size_t i = 0; i < n; ++i) {
            const double a = problem.first.quality(problem.directions[i]);
            const double b = problem.second.quality(back * problem.directions[i]);
            weight[i] = a > 1e-3 && b > 1e-3 ? std::sqrt(a * b) : 0;
        }
    }
    Parameters step_size, prior = Parameters::Zero();
    const auto sigma_of = [](const ViewPrior& view) { return view.circle_sigma_px; };
    for (int k = 0; k < k_parameters; ++k) {
        if (k < 3) step_size[k] = 1e-4;
        if (k >= 3 && k < 9) {
            const double sigma = sigma_of(k < 6 ? problem.first_prior : problem.second_prior);
            step_size[k] = sigma > 0 ? 0.05 : 0;
            prior[k] = sigma > 0 ? 1 / (sigma * sigma) : 0;
        }
    }
    step_size[9] = problem.find_distance ? 1e-3 : 0;
    prior[9] = 1 / (0.05 * 0.05);
    step_size[10] = 1;  // linear, known
    Parameters middle = Parameters::Zero();
    middle[9] = 1 / k_unknown_distance;

    // Residual: second + log2 gain - first, all in stops.
    const auto residuals = [&](const std::vector<double>& a, const std::vector<double>& b,
                               double gain) {
        std::vector<double> r(n, k_unseen);
        for (std::size_t i = 0; i < n; ++i)
            if (weight[i] > 0 && a[i] < k_unseen && b[i] < k_unseen) r[i] = b[i] + gain - a[i];
        return r;
    };
    // The spread of residuals where the pictures have structure: walls of one colour agree
    // whatever the turn, and would make every edge an outlier.
    const auto scale_of = [&](const std::vector<double>& r, const std::vector<double>& moved) {
        std::vector<std::pair<double, double>> by_structure;
        for (std::size_t i = 0; i < n; ++i) {
            if (r[i] < k_unseen && moved[i] < k_unseen)
                by_structure.emplace_back(std::abs(moved[i] - r[i]), std::abs(r[i]));
        }
        const std::size_t kept = by_structure.size() / 5;
        if (kept < 20) return 1.0;
        std::nth_element(by_structure.begin(), by_structure.begin() + static_cast<long>(kept),
                         by_structure.end(), std::greater<>());
        std::vector<double> sizes;
        for (std::size_t i = 0; i < kept; ++i) sizes.push_back(by_structure[i].second);
        return std::max(1.4826 * median(std::move(sizes)), 1e-3);
    };
    const auto prior_cost = [&](const Parameters& p) {
        double cost = 0;
        for (int k = 0; k < k_parameters; ++k)
            cost += prior[k] * (p[k] - middle[k]) * (p[k] - middle[k]);
        return cost;
    };
    // Cauchy's loss at twice the scale: photographers, lamps that moved.
    const auto cost_of = [&](const std::vector<double>& r, double scale, const Parameters& p) {
        double cost = prior_cost(p);
        for (std::size_t i = 0; i < n; ++i) {
            const double v = r[i] < k_unseen ? r[i] : 4 * scale;  // losing overlap gains nothing
            const double x = v / (2 * scale);
            if (weight[i] > 0) cost += weight[i] * 4 * std::log1p(x * x);
        }
        return cost;
    };

    std::vector<double> a = seen(problem, result.at, false, first);
    std::vector<double> b = seen(problem, result.at, true, second);
    std::vector<double> r = residuals(a, b, 0);
    {
        std::vector<double> known;
        for (const double v : r)
            if (v < k_unseen) known.push_back(v);
        result.at[10] = -median(std::move(known));
        r = residuals(a, b, result.at[10]);
    }
    const auto turned_a_little = [&] {
        Parameters p = result.at;
        for (int k = 0; k < 3; ++k) p[k] += 1e-3;
        return residuals(a, seen(problem, p, true, second), p[10]);
    };
    double damping = 1e-3, scale = scale_of(r, turned_a_little());
    double cost = cost_of(r, scale, result.at);
    for (int iteration = 0; iteration < 15; ++iteration) {
        std::array<std::vector<double>, k_parameters> moved;
        for (int k = 0; k < 10; ++k) {
            if (step_size[k] == 0) continue;
            Parameters p = result.at;
            p[k] += step_size[k];
            const bool touches_first = (k >= 3 && k < 6) || k == 9;
            const bool touches_second = !(k >= 3 && k < 6);
            moved[k] = residuals(touches_first ? seen(problem, p, false, first) : a,
                                 touches_second ? seen(problem, p, true, second) : b, p[10]);
        }
        Eigen::Matrix<double, k_parameters, k_parameters> normal;
        normal.setZero();
        Parameters gradient = Parameters::Zero();
        for (std::size_t i = 0; i < n; ++i) {
            if (r[i] >= k_unseen) continue;
            Parameters row = Parameters::Zero();
            bool whole = true;
            for (int k = 0; k < 10; ++k) {
                if (step_size[k] == 0) continue;
                if (moved[k][i] >= k_unseen) {
                    whole = false;
                    break;
                }
                row[k] = (moved[k][i] - r[i]) / step_size[k];
            }
            if (!whole) continue;
            row[10] = 1;
            const double x = r[i] / (2 * scale);
            const double w = weight[i] / (scale * scale) / (1 + x * x);
            normal.noalias() += w * row * row.transpose();
            gradient += w * r[i] * row;
        }
        for (int k = 0; k < k_parameters; ++k) {
            normal(k, k) += prior[k];
            gradient[k] += prior[k] * (result.at[k] - middle[k]);
            if (step_size[k] == 0) normal(k, k) += 1e30;
        }
        bool better = false;
        Parameters moved_by = Parameters::Zero();
        for (int attempt = 0; attempt < 6 && !better; ++attempt) {
            auto damped = normal;
            for (int k = 0; k < k_parameters; ++k) damped(k, k) *= 1 + damping;
            moved_by = -damped.ldlt().solve(gradient);
            if (!moved_by.allFinite()) break;
            Parameters p = result.at + moved_by;
            p[9] = std::clamp(p[9], 1e-6, 0.5);
            const auto a2 = seen(problem, p, false, first), b2 = seen(problem, p, true, second);
            const auto r2 = residuals(a2, b2, p[10]);
            const double tried = cost_of(r2, scale, p);
            if (tried < cost) {
                better = true;
                result.at = p;
                a = a2;
                b = b2;
                r = r2;
                damping = std::max(damping / 5, 1e-9);
            } else {
                damping *= 8;
            }
        }
        const Eigen::Matrix3d turned = normal.inverse().template topLeftCorner<3, 3>();
        result.sigma = std::sqrt(std::max(turned.trace() / 3, 0.0));
        if (!better) break;
        scale = scale_of(r, turned_a_little());
        cost = cost_of(r, scale, result.at);
        if (moved_by.head<3>().norm() < 1e-7 && moved_by.segment<6>(3).norm() < 1e-3) break;
    }
    std::vector<double> sizes;
    double sw = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (r[i] >= k_unseen) continue;
        sizes.push_back(std::abs(r[i]));
        const double w = weight[i];
        sw += w;
        sa += w * a[i];
        sb += w * b[i];
        saa += w * a[i] * a[i];
        sbb += w * b[i] * b[i];
        sab += w * a[i] * b[i];
    }
    result.residual = median(std::move(sizes));
    const double va = sw * saa - sa * sa, vb = sw * sbb - sb * sb;
    result.correlation = va > 0 && vb > 0 ? (sw * sab - sa * sb) / std::sqrt(va * vb) : 0;
    return result;
}

}  // namespace

MirrorBall ball_of(const ViewPrior& prior, double otherwise) {
    if (prior.focal_px > 0)
        return MirrorBall::with_focal_length(prior.circle, prior.principal, prior.focal_px);
    return MirrorBall::at_distance(prior.circle, prior.principal,
                                   prior.distance > 0 ? prior.distance : otherwise);
}

ViewAlignment align_views(const BallView& first, const ViewPrior& first_prior,
                          const BallView& second, const ViewPrior& second_prior,
                          const std::optional<glm::dmat3>& turned) {
    // In camera frames, whatever the views' own worlds are.
    BallView a = first, b = second;
    a.world_from_camera = b.world_from_camera = glm::dmat3(1.0);
    CoarseResult coarse{{turned.value_or(glm::dmat3(1.0)), 1}, -1};
    if (!turned) coarse = over_all_rotations(view_map(a, 256), view_map(b, 256));

    FineProblem problem{a, b, first_prior, second_prior, coarse.best.rotation, {}, false};
    problem.find_distance = (first_prior.focal_px <= 0 && first_prior.distance <= 0) ||
                            (second_prior.focal_px <= 0 && second_prior.distance <= 0);
    for (const Vec3& d : even_directions(24000)) {
        if (a.quality(d) > 1e-3 &&
            b.quality(glm::transpose(coarse.best.rotation) * d) > 1e-3)
            problem.directions.push_back(d);
    }
    FineResult fine;
    fine.at[9] = 1 / k_unknown_distance;
    const double radius = std::min(first_prior.circle.radius, second_prior.circle.radius);
    for (const double sigma_px : {radius / 60, radius / 200, 0.7})
        fine = least_squares(problem, fine, sigma_px);

    ViewAlignment result{problem.rotation(fine.at), fine.correlation, coarse.rival,
                         std::exp2(fine.at[10]), fine.residual, fine.sigma,
                         problem.ball(fine.at, false), problem.ball(fine.at, true), false};
    // Beside chance: a rotation that is far off must be clearly worse, and the best must be good.
    result.ambiguous =
        !turned && (coarse.best.score < 0.5 || coarse.rival > coarse.best.score - 0.05);
    return result;
}

}  // namespace culet
