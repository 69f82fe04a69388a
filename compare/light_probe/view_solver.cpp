#include "compare/light_probe/view_solver.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "compare/light_probe/even_directions.h"
#include "compare/pose/stone_view.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/numbers/upper_median.h"

namespace culet {

namespace {

// Patches of about 20 degrees: wider than an edge's error, and enough of them to estimate a
// scatter.
constexpr int k_patches = 96;
constexpr int k_distance = 9, k_gain = 10;  // indices of the parameters
constexpr double k_distance_sigma = 0.05;   // of 1 / distance about 1 / k_unknown_distance
// Residuals over k_loss scales count only by their logarithm (photographers, moved lamps). Unseen
// ones count as k_lost scales, so that losing overlap gains nothing.
constexpr double k_loss = 2, k_lost = 4;
// Scale and solution depend on each other: alternate until the scale changes by less than
// k_same_scale.
constexpr int k_scale_rounds = 4;
constexpr double k_same_scale = 0.02;

using Square = Eigen::Matrix<double, k_view_parameters, k_view_parameters>;

// 0 if there are none.
double median_or_zero(std::vector<double> values) {
    return values.empty() ? 0 : upper_median(std::move(values));
}

std::vector<Eigen::Index> patches_of(const std::vector<ViewCorrespondence>& correspondences) {
    const std::vector<Vec3> middles = even_directions(k_patches);
    std::vector<Eigen::Index> patches;
    for (const ViewCorrespondence& correspondence : correspondences) {
        const auto nearest =
            std::max_element(middles.begin(), middles.end(), [&](const Vec3& a, const Vec3& b) {
                return glm::dot(correspondence.direction, a) <
                       glm::dot(correspondence.direction, b);
            });
        patches.push_back(nearest - middles.begin());
    }
    return patches;
}

/// All residuals and their derivatives, computed together whenever the solver moves on.
class Differences : public ceres::EvaluationCallback {
public:
    /// `steps`: for finite differences; 0: the parameter is fixed.
    Differences(const ViewResiduals& residuals, const ViewParameters& at,
                const ViewParameters& steps)
        : residuals_(residuals), at_(at), steps_(steps) {
        PrepareForEvaluation(false, true);
    }
    void PrepareForEvaluation(bool with_slopes, bool at_new_place) override {
        if (at_new_place) values_ = residuals_(at_);
        if (!with_slopes) return;
        slopes_ = Eigen::MatrixXd::Zero(k_view_parameters, std::ssize(values_));
        slopes_.row(k_gain).setOnes();  // linear, with a known column
        for (int k = 0; k < k_gain; ++k) {
            if (steps_[k] == 0) continue;
            ViewParameters p = at_;
            p[k] += steps_[k];
            const std::vector<double> moved = residuals_(p);
            for (std::size_t i = 0; i < moved.size(); ++i) {
                const double slope = (moved[i] - values_[i]) / steps_[k];
                slopes_(k, Eigen::Index(i)) = moved[i] < k_unseen ? slope : k_unseen;
            }
        }
        for (std::size_t i = 0; i < values_.size(); ++i) {
            auto slopes = slopes_.col(Eigen::Index(i));
            if (values_[i] >= k_unseen || slopes.maxCoeff() >= k_unseen) slopes.setZero();
        }
    }
    const std::vector<double>& values() const { return values_; }
    /// Zero where a side sees nothing.
    auto slopes(std::size_t i) const { return slopes_.col(Eigen::Index(i)); }

    std::vector<double> known() const {
        std::vector<double> result;
        std::copy_if(values_.begin(), values_.end(), std::back_inserter(result),
                     [](double value) { return value < k_unseen; });
        return result;
    }

    // Scale of the residuals where the pictures have structure: uniform walls agree for any
    // rotation, and would make every edge an outlier.
    double scale() const {
        ViewParameters p = at_;
        for (int k = 0; k < 3; ++k) p[k] += 1e-3;
        const std::vector<double> moved = residuals_(p);
        std::vector<std::pair<double, double>> by_structure;
        for (std::size_t i = 0; i < moved.size(); ++i) {
            if (values_[i] < k_unseen && moved[i] < k_unseen)
                by_structure.emplace_back(std::abs(moved[i] - values_[i]), std::abs(values_[i]));
        }
        const std::ptrdiff_t kept = std::ssize(by_structure) / 5;
        if (kept < 20) return 1.0;
        std::nth_element(by_structure.begin(), by_structure.begin() + kept, by_structure.end(),
                         std::greater<>());
        std::vector<double> sizes;
        for (std::ptrdiff_t i = 0; i < kept; ++i)
            sizes.push_back(by_structure[std::size_t(i)].second);
        return std::max(1.4826 * median_or_zero(std::move(sizes)), 1e-3);
    }

private:
    const ViewResiduals& residuals_;
    const ViewParameters& at_;
    const ViewParameters steps_;
    std::vector<double> values_;
    Eigen::MatrixXd slopes_;
};

class CorrespondenceResidual : public ceres::SizedCostFunction<1, k_view_parameters> {
public:
    CorrespondenceResidual(const Differences& differences, std::size_t correspondence, double scale)
        : differences_(differences), correspondence_(correspondence), scale_(scale) {}
    bool Evaluate(double const* const*, double* residual, double** slopes) const override {
        const double value = differences_.values()[correspondence_];
        residual[0] = value < k_unseen ? value / scale_ : k_lost;
        if (slopes == nullptr || slopes[0] == nullptr) return true;
        for (int k = 0; k < k_view_parameters; ++k)
            slopes[0][k] = differences_.slopes(correspondence_)[k] / scale_;
        return true;
    }

private:
    const Differences& differences_;
    std::size_t correspondence_;
    double scale_;
};

class Solver {
public:
    Solver(const ViewPair& pair, const std::vector<ViewCorrespondence>& correspondences,
           const ViewResiduals& residuals)
        : correspondences_(correspondences), residuals_(residuals) {
        expected_[k_distance] = 1 / k_unknown_distance;
        certainty_[k_distance] = 1 / k_distance_sigma;
        for (int k = 0; k < k_distance; ++k) {
            const double sigma = (k < 6 ? pair.first_prior : pair.second_prior).circle_sigma_px;
            if (k >= 3 && sigma > 0) certainty_[k] = 1 / sigma;
            step_[k] = k < 3 ? 1e-4 : sigma > 0 ? 0.05 : 0;
        }
        step_[k_distance] = pair.find_distance ? 1e-3 : 0;
        step_[k_gain] = 1;
    }

    ViewSolution solve(ViewSolution result) const {
        Differences differences(residuals_, result.at, step_);
        std::vector<double> known = differences.known();
        const double all = static_cast<double>(known.size());
        const double share = result.correspondences > 0
                                 ? std::min(1.0, result.correspondences / std::max(all, 1.0))
                                 : 1;
        result.at[k_gain] -= median_or_zero(std::move(known));
        differences.PrepareForEvaluation(false, true);
        double scale = differences.scale();
        for (int round = 0; round < k_scale_rounds; ++round) {
            minimise(differences, scale, share, result.at);
            differences.PrepareForEvaluation(false, true);
            const double before = std::exchange(scale, differences.scale());
            if (std::abs(scale / before - 1) < k_same_scale) break;
        }
        differences.PrepareForEvaluation(true, false);
        set_sigma(differences, scale, share, all, result);
        std::vector<double> sizes = differences.known();
        for (double& size : sizes) size = std::abs(size);
        result.residual = median_or_zero(std::move(sizes));
        return result;
    }

private:
    void minimise(Differences& differences, double scale, double share, ViewParameters& at) const {
        ceres::Problem::Options at_once;
        at_once.evaluation_callback = &differences;
        ceres::Problem problem(at_once);
        problem.AddParameterBlock(at.data(), k_view_parameters);
        for (std::size_t i = 0; i < correspondences_.size(); ++i) {
            auto* loss =
                new ceres::ScaledLoss(new ceres::CauchyLoss(k_loss),
                                      share * correspondences_[i].weight, ceres::TAKE_OWNERSHIP);
            problem.AddResidualBlock(new CorrespondenceResidual(differences, i, scale), loss,
                                     at.data());
        }
        problem.AddResidualBlock(
            new ceres::NormalPrior(Eigen::MatrixXd(certainty_.asDiagonal()), expected_), nullptr,
            at.data());
        std::vector<int> held;
        for (int k = 0; k < k_view_parameters; ++k)
            if (step_[k] == 0) held.push_back(k);
        if (!held.empty())
            problem.SetManifold(at.data(), new ceres::SubsetManifold(k_view_parameters, held));
        ceres::Solver::Options options;
        options.linear_solver_type = ceres::DENSE_QR;
        options.max_num_iterations = 12;
        options.num_threads = 1;
        options.logging_type = ceres::SILENT;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem, &summary);
    }

    // Sigma and effective number of the correspondences from their gradients' scatter over the
    // patches.
    void set_sigma(const Differences& differences, double scale, double share_before, double all,
                   ViewSolution& result) const {
        Square normal = Square::Zero();        // Gauss-Newton matrix of the reweighted squares
        Square loss_hessian = Square::Zero();  // outliers have the opposite sign
        Eigen::Matrix<double, k_view_parameters, k_patches> patch_gradients;
        Eigen::Array<bool, k_patches, 1> holds;
        patch_gradients.setZero();
        holds.setConstant(false);
        const std::vector<Eigen::Index> patches = patches_of(correspondences_);
        for (std::size_t i = 0; i < correspondences_.size(); ++i) {
            const auto row = differences.slopes(i);
            if (row[k_gain] == 0) continue;
            const double value = differences.values()[i], x = value / (k_loss * scale);
            const double squeezed = 1 / (1 + x * x);
            const double w = correspondences_[i].weight / (scale * scale) * squeezed;
            normal.noalias() += w * row * row.transpose();
            loss_hessian.noalias() += w * squeezed * (1 - x * x) * row * row.transpose();
            patch_gradients.col(patches[i]) += w * value * row;
            holds[patches[i]] = true;
        }
        const double count = static_cast<double>(holds.count());
        const double freedom = count - static_cast<double>((step_.array() != 0).count());
        if (!(freedom > 0)) {
            // Too few patches for a scatter: the rotation is unknown.
            result.sigma = std::numeric_limits<double>::infinity();
            return;
        }
        const ViewParameters sum = patch_gradients.rowwise().sum();
        const Square scatter =
            (patch_gradients * patch_gradients.transpose() - sum * sum.transpose() / count) *
            (count / freedom);
        Square prior = Square(certainty_.cwiseAbs2().asDiagonal());
        const Square held =
            Square((step_.array() == 0).cast<double>().matrix().asDiagonal()) * 1e30;
        // For independent correspondences the two traces would be equal.
        const Square flat = inverse_of(normal + prior / share_before + held);
        const double repeated = std::max(1.0, (flat * scatter).trace() / (flat * normal).trace());
        result.correspondences = all / repeated;
        const double share = 1 / repeated;
        loss_hessian = share * loss_hessian + prior + held;
        if (PivotedCholesky(loss_hessian).pivots().minCoeff() <= 0)
            loss_hessian = share * normal + prior + held;
        const Square back = inverse_of(loss_hessian);
        const Square covariance = back * (share * share * scatter + prior) * back;
        result.sigma = std::sqrt(std::max(covariance.topLeftCorner<3, 3>().trace() / 3, 0.0));
    }

    const std::vector<ViewCorrespondence>& correspondences_;
    const ViewResiduals& residuals_;
    ViewParameters step_ = ViewParameters::Zero();  // for finite differences; 0: fixed
    ViewParameters expected_ = ViewParameters::Zero(), certainty_ = ViewParameters::Zero();
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
    return ball_of(prior, 1 / std::max(p[k_distance], 1e-6));
}

ViewSolution solve_views(const ViewPair& pair,
                         const std::vector<ViewCorrespondence>& correspondences,
                         const ViewResiduals& residuals, ViewSolution start) {
    return Solver(pair, correspondences, residuals).solve(std::move(start));
}

}  // namespace culet
