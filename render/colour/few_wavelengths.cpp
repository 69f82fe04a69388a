#include "render/colour/few_wavelengths.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>

#include "render/colour/difference_near.h"
#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double k_step = 0.25, k_longest = 5;  // of single paths, in widths
constexpr std::array k_spread{0.25, 0.5, 1.0, 2.0, 4.0};
// Weights. Paths along one principal ray are rare in a picture; most light has gone along all of
// them.
constexpr double k_of_one_ray = 0.1, k_of_primaries = 3;
// Regularisation: what the colours do not determine stays near its value at the wavelengths.
constexpr double k_near_shares = 0.1, k_near_absorption = 0.01;
constexpr double k_least_per_width = 1e-3;
constexpr int k_most_steps = 60;
constexpr double k_least_gain = 1e-5;

MatrixXd shares_of(const WavelengthSet& set) {
    MatrixXd shares(3, set.size());
    for (Index i = 0; i < shares.cols(); ++i) {
        const VectorXd one = VectorXd::Unit(shares.cols(), i);
        shares.col(i) = Vector3d(set.rgb_of(one.data()).data());
    }
    return shares;
}

// In steps of 5 nm, like the finest pictures.
const WavelengthSet& whole_spectrum() {
    static const WavelengthSet set = [] {
        std::vector<double> nm;
        for (int i = 410; i <= 690; i += 5) nm.push_back(i);
        return WavelengthSet(nm);
    }();
    return set;
}

// Light after a path of one length, or of lengths spread exponentially about it.
struct Way {
    Index ray;  // -1: all rays mixed
    double mm;
    bool spread;
    double weight;
    Vector3d colour;
    Matrix3d metric, of_primaries;

    // exp(-K mm), or its mean over the lengths; the slope is with respect to log K.
    double transmitted(double absorption, double* slope = nullptr) const {
        const double depth = absorption * mm, part = spread ? 1 / (1 + depth) : std::exp(-depth);
        if (slope != nullptr) *slope = -depth * part * (spread ? part : 1);
        return part;
    }
    VectorXd transmitted(const MatrixXd& absorption) const {
        const Index rays = absorption.rows();
        VectorXd sum = VectorXd::Zero(absorption.cols());
        for (Index r = 0; r < rays; ++r) {
            for (Index i = 0; (ray < 0 || ray == r) && i < sum.size(); ++i)
                sum[i] += transmitted(absorption(r, i)) / static_cast<double>(ray < 0 ? rays : 1);
        }
        return sum;
    }
};

// The unknowns are the logarithms of absorptions, ray by ray, and the weights of all wavelengths
// but the last, colour by colour.
class Fit {
public:
    Fit(const MatrixXd& fine_absorption, const WavelengthSet& few, const MatrixXd& start,
        double width)
        : nodes_(few.size()),
          rays_(start.rows()),
          shares_(shares_of(few)),
          start_(start.cwiseMax(k_least_per_width / width).array().log()),
          primaries_(nodes_ == 3) {
        const MatrixXd fine = shares_of(whole_spectrum());
        MatrixXd primaries = MatrixXd::Zero(fine.cols(), 3);
        for (Index p = 0; primaries_ && p < 3; ++p)
            primaries.col(p) = Eigen::Map<const VectorXd>(
                whole_spectrum().primaries()[static_cast<std::size_t>(p)].data(), fine.cols());
        const auto add = [&](Index ray, double widths, bool spread) {
            const double weight = ray < 0 || rays_ == 1 ? 1 : k_of_one_ray;
            Way way{ray, widths * width, spread, weight, {}, {}, {}};
            const VectorXd seen = way.transmitted(fine_absorption);
            way.colour = fine * seen;
            const DifferenceNear near =
                difference_near(way.colour[0], way.colour[1], way.colour[2]);
            for (Index row = 0; row < 3; ++row)
                way.metric.row(row) = weight * Vector3d(near[static_cast<std::size_t>(row)].data());
            way.of_primaries = fine * seen.asDiagonal() * primaries;
            ways_.push_back(way);
        };
        for (double widths = k_step; widths <= k_longest; widths += k_step) {
            for (Index ray = rays_ > 1 ? -1 : 0; ray < rays_; ++ray) add(ray, widths, false);
        }
        for (const double widths : k_spread) add(-1, widths, true);
    }

    VectorXd first() const {
        VectorXd x(rays_ * nodes_ + 3 * (nodes_ - 1));
        for (Index r = 0; r < rays_; ++r) x.segment(r * nodes_, nodes_) = start_.row(r).transpose();
        for (Index c = 0; c < 3; ++c)
            x.segment(share_at(c, 0), nodes_ - 1) = shares_.row(c).head(nodes_ - 1).transpose();
        return x;
    }
    MatrixXd absorption(const VectorXd& x) const {
        MatrixXd of(rays_, nodes_);
        for (Index r = 0; r < rays_; ++r)
            of.row(r) = x.segment(r * nodes_, nodes_).array().exp().transpose();
        return of;
    }
    MatrixXd shares(const VectorXd& x) const {
        MatrixXd of(3, nodes_);
        for (Index c = 0; c < 3; ++c) {
            of.row(c).head(nodes_ - 1) = x.segment(share_at(c, 0), nodes_ - 1).transpose();
            of(c, nodes_ - 1) = 1 - of.row(c).head(nodes_ - 1).sum();
        }
        return of;
    }

    // Residuals, and their Jacobian.
    VectorXd residuals(const VectorXd& x, MatrixXd& jacobian) const {
        const Index each = primaries_ ? 12 : 3, all = static_cast<Index>(ways_.size());
        const MatrixXd K = absorption(x), M = shares(x);
        // Light of each primary at the wavelengths: three wavelengths determine it.
        const MatrixXd light = primaries_ ? MatrixXd(inverse3(M)) : MatrixXd();
        VectorXd rows = VectorXd::Zero(each * all + x.size());
        jacobian = MatrixXd::Zero(rows.size(), x.size());
        for (Index w = 0; w < all; ++w) {
            const Way& way = ways_[static_cast<std::size_t>(w)];
            const VectorXd seen = way.transmitted(K);
            rows.segment(each * w, 3) = way.metric * (M * seen - way.colour);
            fill(jacobian.middleRows(each * w, 3), way, K, M, seen, VectorXd::Ones(nodes_),
                 way.metric, nullptr);
            for (Index p = 0; primaries_ && p < 3; ++p) {
                const Index row = each * w + 3 * (p + 1);
                const double weight = way.weight * k_of_primaries;
                const VectorXd lit = light.col(p);
                rows.segment(row, 3) =
                    weight * (M * seen.cwiseProduct(lit) - way.of_primaries.col(p));
                fill(jacobian.middleRows(row, 3), way, K, M, seen, lit,
                     weight * Matrix3d::Identity(), &light);
            }
        }
        const VectorXd moved = x - first();
        for (Index k = 0; k < x.size(); ++k) {
            const double near = k < rays_ * nodes_ ? k_near_absorption : k_near_shares;
            rows[each * all + k] = near * moved[k];
            jacobian(each * all + k, k) = near;
        }
        return rows;
    }

private:
    Index share_at(Index colour, Index node) const {
        return rays_ * nodes_ + colour * (nodes_ - 1) + node;
    }
    // Jacobian of scale M (seen . lit), where `lit` is 1 or a column of `light`, the inverse of M.
    void fill(Eigen::Ref<MatrixXd> jacobian, const Way& way, const MatrixXd& K, const MatrixXd& M,
              const VectorXd& seen, const VectorXd& lit, const Matrix3d& scale,
              const MatrixXd* light) const {
        const double part = way.ray < 0 ? 1.0 / static_cast<double>(rays_) : 1;
        for (Index r = 0; r < rays_; ++r) {
            for (Index i = 0; (way.ray < 0 || way.ray == r) && i < nodes_; ++i) {
                double slope = 0;
                way.transmitted(K(r, i), &slope);
                jacobian.col(r * nodes_ + i) = part * slope * lit[i] * (scale * M.col(i));
            }
        }
        const Index last = nodes_ - 1;
        for (Index c = 0; c < 3; ++c) {
            // d(M^-1) = -M^-1 dM M^-1.
            const Vector3d turned = light != nullptr
                                        ? Vector3d(scale * (M * seen.cwiseProduct(light->col(c))))
                                        : Vector3d(Vector3d::Zero());
            for (Index i = 0; i < last; ++i)
                jacobian.col(share_at(c, i)) =
                    (seen[i] * lit[i] - seen[last] * lit[last]) * scale.col(c) -
                    (lit[i] - lit[last]) * turned;
        }
    }

    Index nodes_, rays_;
    MatrixXd shares_, start_;
    bool primaries_;
    std::vector<Way> ways_;
};

// Levenberg-Marquardt from x; returns the remaining sum of squares.
double least_squares(const Fit& fit, VectorXd& x) {
    MatrixXd jacobian, tried_jacobian;
    VectorXd residuals = fit.residuals(x, jacobian);
    double damping = 1e-3;
    for (int step = 0; step < k_most_steps && damping < 1e9;) {
        MatrixXd normal = transpose_times(jacobian, jacobian);
        normal.diagonal() *= 1 + damping;
        const VectorXd tried = x - Cholesky(normal).solve_one(jacobian.transpose() * residuals);
        const VectorXd left = fit.residuals(tried, tried_jacobian);
        const double before = residuals.squaredNorm(), after = left.squaredNorm();
        if (!(after < before)) {
            damping *= 5;
            continue;
        }
        x = tried;
        residuals = left;
        std::swap(jacobian, tried_jacobian);
        damping *= 0.2;
        ++step;
        if (before - after < k_least_gain * before) break;
    }
    return residuals.squaredNorm();
}

FewWavelengths fitted(const std::vector<Spectrum>& absorption, const std::vector<double>& nm,
                      double width) {
    const std::vector<double>& fine = whole_spectrum().wavelengths_nm();
    const auto rays = static_cast<Index>(absorption.size());
    const auto of_rays = [&](const std::vector<double>& at) {
        MatrixXd values(rays, static_cast<Index>(at.size()));
        for (Index r = 0; r < rays; ++r) {
            for (Index i = 0; i < values.cols(); ++i)
                values(r, i) =
                    absorption[static_cast<std::size_t>(r)].at(at[static_cast<std::size_t>(i)]);
        }
        return values;
    };
    const MatrixXd of_fine = of_rays(fine), at_nodes = of_rays(nm);
    // Mean over the fine wavelengths nearest to each wavelength.
    MatrixXd means = at_nodes;
    VectorXd counts = VectorXd::Ones(means.cols());
    for (std::size_t f = 0; f < fine.size(); ++f) {
        const Index nearest =
            std::min_element(
                nm.begin(), nm.end(),
                [&](double a, double b) { return std::abs(a - fine[f]) < std::abs(b - fine[f]); }) -
            nm.begin();
        means.col(nearest) += of_fine.col(static_cast<Index>(f));
        counts[nearest] += 1;
    }
    means = means * counts.cwiseInverse().asDiagonal();
    // The two starts may lead to different local minima: take the lower.
    FewWavelengths result;
    double least = std::numeric_limits<double>::infinity();
    for (const MatrixXd& start : {means, at_nodes}) {
        const Fit fit(of_fine, WavelengthSet(nm), start, width);
        VectorXd x = fit.first();
        const double left = least_squares(fit, x);
        if (!(left < least)) continue;
        least = left;
        result = {};
        const MatrixXd K = fit.absorption(x), M = fit.shares(x);
        for (Index i = 0; i < M.cols(); ++i)
            result.rgb_weight.push_back({M(0, i), M(1, i), M(2, i)});
        for (Index r = 0; r < rays; ++r) {
            std::vector<double>& of_ray = result.absorption_per_mm.emplace_back();
            for (Index i = 0; i < K.cols(); ++i) of_ray.push_back(K(r, i));
        }
    }
    return result;
}

}  // namespace

const FewWavelengths& fit_wavelengths(const std::vector<Spectrum>& absorption_per_mm,
                                      const std::vector<double>& wavelengths_nm, double width_mm) {
    constexpr double k_steps = 4;  // steps per octave
    const double width = std::exp2(std::round(k_steps * std::log2(width_mm)) / k_steps);
    std::vector<double> key{width};
    key.insert(key.end(), wavelengths_nm.begin(), wavelengths_nm.end());
    for (const Spectrum& spectrum : absorption_per_mm) {
        for (const std::vector<double>* of : {&spectrum.wavelengths_nm(), &spectrum.values()}) {
            key.push_back(static_cast<double>(of->size()));
            key.insert(key.end(), of->begin(), of->end());
        }
    }
    static std::mutex mutex;
    static std::map<std::vector<double>, FewWavelengths> found;
    const std::lock_guard<std::mutex> lock(mutex);
    const auto at = found.find(key);
    if (at != found.end()) return at->second;
    return found.emplace(key, fitted(absorption_per_mm, wavelengths_nm, width)).first->second;
}

}  // namespace culet
