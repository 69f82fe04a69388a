#include "compare/light_probe/view_solver.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "compare/light_probe/even_directions.h"
#include "compare/pose/stone_view.h"
#include "stone/dense_algebra.h"
#include "stone/upper_median.h"

namespace culet {

namespace {

// Patches some 20 degrees across: wider than an edge's error, and enough of them for a scatter.
constexpr int k_patches = 96;
constexpr double k_distance_sigma = 0.05;  // of 1 / distance about that of k_unknown_distance

using Square = Eigen::Matrix<double, k_view_parameters, k_view_parameters>;

// Of nothing 0.
double median(std::vector<double> values) {
    return values.empty() ? 0 : upper_median(std::move(values));
}

std::vector<int> patches_of(const std::vector<ViewWitness>& witnesses) {
    const std::vector<Vec3> middles = even_directions(k_patches);
    std::vector<int> patches;
    for (const ViewWitness& witness : witnesses) {
        int nearest = 0;
        double most = -2;
        for (int k = 0; k < k_patches; ++k) {
            const double cosine = glm::dot(witness.direction, middles[static_cast<std::size_t>(k)]);
            if (cosine <= most) continue;
            most = cosine;
            nearest = k;
        }
        patches.push_back(nearest);
    }
    return patches;
}

/// What all witnesses say about the parameters, counted as independent ones.
struct Evidence {
    Square normal = Square::Zero();   ///< of the reweighted squares
    Square bend = Square::Zero();     ///< of the loss itself, which outliers bend the other way
    Square scatter = Square::Zero();  ///< of the patches' pulls
    ViewParameters pull = ViewParameters::Zero();
    int patches = 0;  ///< that hold any
};

class Solver {
public:
    Solver(const ViewPair& pair, const std::vector<ViewWitness>& witnesses,
           const ViewResiduals& residuals)
        : residuals_(residuals), patches_(patches_of(witnesses)) {
        for (const ViewWitness& witness : witnesses) weights_.push_back(witness.weight);
        middle_[9] = 1 / k_unknown_distance;
        for (int k = 0; k < 9; ++k) {
            if (k < 3) {
                step_[k] = 1e-4;
                continue;
            }
            const double sigma = (k < 6 ? pair.first_prior : pair.second_prior).circle_sigma_px;
            step_[k] = sigma > 0 ? 0.05 : 0;
            prior_(k, k) = sigma > 0 ? 1 / (sigma * sigma) : 0;
        }
        step_[9] = pair.find_distance ? 1e-3 : 0;
        prior_(9, 9) = 1 / (k_distance_sigma * k_distance_sigma);
        step_[10] = 1;  // linear: its column is known
    }

    ViewSolution solve(ViewSolution result) {
        // Gain first, by the median.
        std::vector<double> r = residuals_(result.at), known;
        for (std::size_t i = 0; i < r.size(); ++i)
            if (r[i] < k_unseen && weights_[i] > 0) known.push_back(r[i]);
        const double all = static_cast<double>(known.size());
        if (result.witnesses > 0) share_ = std::min(1.0, result.witnesses / std::max(all, 1.0));
        result.at[10] -= median(std::move(known));
        r = residuals_(result.at);
        double damping = 1e-3, scale = scale_of(r, result.at), cost = cost_of(r, scale, result.at);
        for (int iteration = 0; iteration < 12; ++iteration) {
            const Evidence evidence = evidence_of(r, scale, result.at);
            const Square normal = share_ * evidence.normal + prior_ + held();
            const ViewParameters gradient = share_ * evidence.pull + prior_ * (result.at - middle_);
            ViewParameters moved = ViewParameters::Zero();
            bool better = false;
            for (int attempt = 0; attempt < 5 && !better; ++attempt) {
                Square damped = normal;
                damped.diagonal() *= 1 + damping;
                moved = -PivotedCholesky(damped).solve_one(gradient);
                if (!moved.allFinite()) break;
                ViewParameters p = result.at + moved;
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
            if (!better) break;
            scale = scale_of(r, result.at);
            cost = cost_of(r, scale, result.at);
            if (moved.head<3>().norm() < 1e-6 && moved.segment<6>(3).norm() < 2e-3) break;
        }
        tell_certainty(evidence_of(r, scale, result.at), all, result);
        std::vector<double> sizes;
        for (std::size_t i = 0; i < r.size(); ++i)
            if (r[i] < k_unseen && weights_[i] > 0) sizes.push_back(std::abs(r[i]));
        result.residual = median(std::move(sizes));
        return result;
    }

private:
    // The spread of residuals where the pictures have structure: walls of one colour agree
    // whatever the turn, and would make every edge an outlier.
    double scale_of(const std::vector<double>& r, ViewParameters p) const {
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
    double cost_of(const std::vector<double>& r, double scale, const ViewParameters& p) const {
        double cost = 0;
        for (std::size_t i = 0; i < r.size(); ++i) {
            if (weights_[i] <= 0) continue;
            const double v = r[i] < k_unseen ? r[i] : 4 * scale;  // losing overlap gains nothing
            const double x = v / (2 * scale);
            cost += weights_[i] * 4 * std::log1p(x * x);
        }
        return share_ * cost + (p - middle_).dot(prior_ * (p - middle_));
    }

    Evidence evidence_of(const std::vector<double>& r, double scale,
                         const ViewParameters& at) const {
        std::array<std::vector<double>, k_view_parameters> moved;
        for (int k = 0; k < 10; ++k) {
            if (step_[k] == 0) continue;
            ViewParameters p = at;
            p[k] += step_[k];
            moved[static_cast<std::size_t>(k)] = residuals_(p);
        }
        Evidence evidence;
        std::array<ViewParameters, k_patches> pulls;
        std::array<bool, k_patches> holds{};
        pulls.fill(ViewParameters::Zero());
        for (std::size_t i = 0; i < r.size(); ++i) {
            if (r[i] >= k_unseen || weights_[i] <= 0) continue;
            ViewParameters row = ViewParameters::Zero();
            bool whole = true;
            for (int k = 0; k < 10 && whole; ++k) {
                if (step_[k] == 0) continue;
                const double to = moved[static_cast<std::size_t>(k)][i];
                whole = to < k_unseen;
                row[k] = (to - r[i]) / step_[k];
            }
            if (!whole) continue;
            row[10] = 1;
            const double x = r[i] / (2 * scale), squeezed = 1 / (1 + x * x);
            const double w = weights_[i] / (scale * scale) * squeezed;
            evidence.normal.noalias() += w * row * row.transpose();
            evidence.bend.noalias() += w * squeezed * (1 - x * x) * row * row.transpose();
            const auto patch = static_cast<std::size_t>(patches_[i]);
            pulls[patch] += w * r[i] * row;
            holds[patch] = true;
        }
        for (const ViewParameters& pull : pulls) evidence.pull += pull;
        evidence.patches = static_cast<int>(std::count(holds.begin(), holds.end(), true));
        const ViewParameters mean = evidence.pull / std::max(1, evidence.patches);
        for (std::size_t k = 0; k < pulls.size(); ++k) {
            if (!holds[k]) continue;
            const ViewParameters off = pulls[k] - mean;
            evidence.scatter.noalias() += off * off.transpose();
        }
        return evidence;
    }

    void tell_certainty(const Evidence& evidence, double all, ViewSolution& result) const {
        const double unknowns = static_cast<double>((step_.array() != 0).count());
        const double freedom = evidence.patches - unknowns;
        if (!(freedom > 0)) {
            // Too few patches to tell a scatter: nothing is known of the turn.
            result.sigma = std::numeric_limits<double>::infinity();
            return;
        }
        const Square scatter = evidence.scatter * (evidence.patches / freedom);
        // Of independent witnesses both would be one.
        const Square flat = inverse_of(evidence.normal + prior_ / share_ + held());
        const double repeated =
            std::max(1.0, (flat * scatter).trace() / (flat * evidence.normal).trace());
        result.witnesses = all / repeated;
        const double share = 1 / repeated;
        Square bend = share * evidence.bend + prior_ + held();
        if (PivotedCholesky(bend).pivots().minCoeff() <= 0)
            bend = share * evidence.normal + prior_ + held();
        const Square back = inverse_of(bend);
        const Square covariance = back * (share * share * scatter + prior_) * back;
        result.sigma = std::sqrt(std::max(covariance.topLeftCorner<3, 3>().trace() / 3, 0.0));
    }

    Square held() const {
        Square held = Square::Zero();
        for (int k = 0; k < k_view_parameters; ++k)
            if (step_[k] == 0) held(k, k) = 1e30;
        return held;
    }

    const ViewResiduals& residuals_;
    std::vector<double> weights_;
    std::vector<int> patches_;
    double share_ = 1;  // of the witnesses that are independent
    ViewParameters step_ = ViewParameters::Zero(), middle_ = ViewParameters::Zero();
    Square prior_ = Square::Zero();
};

}  // namespace

glm::dmat3 ViewPair::rotation(const ViewParameters& p) const {
    return rotation_by({p[0], p[1], p[2]}) * start;
}

MirrorBall ViewPair::ball(const ViewParameters& p, bool is_second) const {
    ViewPrior prior = is_second ? second_prior : first_prior;
    const int at = is_second ? 6 : 3;
    prior.circle.x += p[at];
    prior.circle.y += p[at + 1];
    prior.circle.radius += p[at + 2];
    return ball_of(prior, 1 / std::max(p[9], 1e-6));
}

ViewSolution solve_views(const ViewPair& pair, const std::vector<ViewWitness>& witnesses,
                         const ViewResiduals& residuals, ViewSolution start) {
    return Solver(pair, witnesses, residuals).solve(std::move(start));
}

}  // namespace culet
