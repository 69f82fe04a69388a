#include "fit/solve/relax.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "fit/solve/constants.h"
#include "fit/solve/manifolds.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// The shape as Ceres' parameter blocks: the first facet and the first point of each orbit, and the
// extra unknowns. The rest of the shape follows them.
class Blocks : public ceres::EvaluationCallback {
public:
    Blocks(const Parameters& parameters, const Shape& shape, bool keep_normals)
        : parameters_(parameters),
          tangent_basis_(parameters.tangent_basis(shape)),
          shape_(shape),
          keep_normals_(keep_normals) {
        const int facets = static_cast<int>(shape.normals.size()),
                  points = static_cast<int>(shape.points.size());
        first_point_ = facets;
        first_extra_ = facets + points;
        planes_.resize(std::size_t(facets));
        for (int f = 0; f < facets; ++f) {
            const Vec3& n = shape.normals[std::size_t(f)];
            planes_[std::size_t(f)] = {n.x, n.y, n.z, shape.offsets[std::size_t(f)]};
        }
        points_ = shape.points;
        extras_ = shape.extras;
    }

    const Shape& shape() const { return shape_; }

    void add_to(ceres::Problem& problem) {
        for (int f = 0; f < first_point_; ++f) {
            if (!parameters_.is_first_facet(f)) continue;
            const Parameters::Slots& slots = tangent_basis_.normals[std::size_t(f)];
            const Vec3 outward = slots.count == 1
                                     ? parameters_.orbits().kept_by_facet[std::size_t(f)].outward
                                     : Vec3(0);
            problem.AddParameterBlock(planes_[std::size_t(f)].data(), 4,
                                      new PlaneManifold(keep_normals_ ? 0 : slots.count, outward));
        }
        for (std::size_t p = 0; p < points_.size(); ++p) {
            if (!parameters_.is_first_point(static_cast<int>(p))) continue;
            const Parameters::Slots& slots = tangent_basis_.points[p];
            problem.AddParameterBlock(data(points_[p]), 3,
                                      slots.count < 3 ? new PointManifold(slots) : nullptr);
        }
        for (std::size_t e = 0; e < extras_.size(); ++e) {
            problem.AddParameterBlock(&extras_[e], 1);
            if ((*tangent_basis_.extras)[e] < 0) problem.SetParameterBlockConstant(&extras_[e]);
        }
    }

    void PrepareForEvaluation(bool, bool is_new) override {
        if (!is_new) return;
        // Images' blocks do not move: they follow the first of their orbit.
        for (std::size_t f = 0; f < planes_.size(); ++f) {
            shape_.normals[f] = {planes_[f][0], planes_[f][1], planes_[f][2]};
            shape_.offsets[f] = planes_[f][3];
        }
        shape_.points = points_;
        parameters_.place_images(shape_);
        shape_.extras = extras_;
    }

    /// The block that a slope belongs to, and the slope in the block's own numbers.
    struct BlockSlope {
        int block = -1, at = 0, size = 0;
        std::array<double, 3> slope{};
    };
    BlockSlope of_block(const Quantity::Slope& s) const {
        const Orbits& orbits = parameters_.orbits();
        const auto turned = [&](const std::vector<OrbitMember>& members) {
            const OrbitMember& m = members[std::size_t(s.index)];
            return m.first == s.index ? s.slope : glm::transpose(m.from_first) * s.slope;
        };
        const auto first = [&](const std::vector<OrbitMember>& members) {
            return orbits.empty() ? s.index : members[std::size_t(s.index)].first;
        };
        switch (s.by) {
            case Quantity::By::normal: {
                const Vec3 v = orbits.empty() ? s.slope : turned(orbits.facets);
                return {first(orbits.facets), 0, 3, {v.x, v.y, v.z}};
            }
            case Quantity::By::offset:
                return {first(orbits.facets), 3, 1, {s.slope.x, 0, 0}};
            case Quantity::By::point: {
                const Vec3 v = orbits.empty() ? s.slope : turned(orbits.points);
                return {first_point_ + first(orbits.points), 0, 3, {v.x, v.y, v.z}};
            }
            case Quantity::By::extra:
                return {first_extra_ + s.index, 0, 1, {s.slope.x, 0, 0}};
        }
        return {};
    }
    double* numbers(int block) {
        if (block < first_point_) return planes_[std::size_t(block)].data();
        if (block < first_extra_) return data(points_[std::size_t(block - first_point_)]);
        return &extras_[std::size_t(block - first_extra_)];
    }
    int size(int block) const { return block < first_point_ ? 4 : block < first_extra_ ? 3 : 1; }

private:
    const Parameters& parameters_;
    Parameters::TangentBasis tangent_basis_;
    Shape shape_;
    bool keep_normals_;
    int first_point_ = 0, first_extra_ = 0;
    std::vector<std::array<double, 4>> planes_;
    std::vector<Vec3> points_;
    std::vector<double> extras_;
};

// weight * formula, with its slopes by the blocks.
class Term : public ceres::CostFunction {
public:
    Term(const Blocks& blocks, Formula formula, double weight, std::vector<int> of)
        : blocks_(blocks), formula_(std::move(formula)), weight_(weight), of_(std::move(of)) {
        set_num_residuals(1);
        for (const int block : of_) mutable_parameter_block_sizes()->push_back(blocks.size(block));
    }

    bool Evaluate(double const* const*, double* residual, double** jacobians) const override {
        const Quantity q = formula_(blocks_.shape());
        *residual = weight_ * q.value;
        if (!std::isfinite(*residual)) return false;
        if (jacobians == nullptr) return true;
        for (std::size_t k = 0; k < of_.size(); ++k) {
            if (jacobians[k]) std::fill_n(jacobians[k], blocks_.size(of_[k]), 0.0);
        }
        for (const Quantity::Slope& s : q.slopes) {
            const Blocks::BlockSlope b = blocks_.of_block(s);
            const auto k = std::lower_bound(of_.begin(), of_.end(), b.block) - of_.begin();
            // The shape is degenerate, so that the formula has another form: reject the step.
            if (k == std::ptrdiff_t(of_.size()) || of_[std::size_t(k)] != b.block) return false;
            if (jacobians[k] == nullptr) continue;
            for (int i = 0; i < b.size; ++i)
                jacobians[k][b.at + i] += weight_ * b.slope[std::size_t(i)];
        }
        return true;
    }

private:
    const Blocks& blocks_;
    Formula formula_;
    double weight_;
    std::vector<int> of_;  // sorted
};

class Interruptor : public ceres::IterationCallback {
public:
    Interruptor(const Progress& progress, double fraction)
        : progress_(progress), fraction_(fraction) {}
    ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
        return progress_ && !progress_(fraction_) ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
    }

private:
    const Progress& progress_;
    double fraction_;
};

// max(formula, 0).
Formula positive_part(Formula formula) {
    return [formula = std::move(formula)](const Shape& shape) {
        Quantity q = formula(shape);
        if (q.value > 0) return q;
        for (Quantity::Slope& s : q.slopes) s.slope = Vec3(0);
        q.value = 0;
        return q;
    };
}

// Adds the formula over its sigma as a term, unless it is constant.
void add(const Formula& formula, double sigma, Blocks& blocks, ceres::Problem& problem) {
    std::vector<int> of;
    for (const Quantity::Slope& s : formula(blocks.shape()).slopes) {
        of.push_back(blocks.of_block(s).block);
    }
    std::sort(of.begin(), of.end());
    of.erase(std::unique(of.begin(), of.end()), of.end());
    std::vector<double*> numbers;
    for (const int block : of) numbers.push_back(blocks.numbers(block));
    if (numbers.empty()) return;
    problem.AddResidualBlock(new Term(blocks, formula, 1 / sigma, std::move(of)), nullptr, numbers);
}

ceres::Solver::Options solver_options(int most_steps) {
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    // Sum in the same order whatever the number of threads.
    solver.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
    solver.num_threads = 1;
    // Inactive hinges have zero slopes. Left out of the pattern they cause no fill: stages of 979
    // facets take a sixth of the time.
    solver.dynamic_sparsity = true;
    solver.function_tolerance = k_stage.least_gain;
    solver.initial_trust_region_radius = k_stage.first_trust;
    solver.logging_type = ceres::SILENT;
    solver.max_num_iterations = most_steps;
    return solver;
}

}  // namespace

Shape relax(const Relaxation& relaxation, const Shape& shape, const PenaltyScale& penalty,
            const RelaxOptions& options, const Progress& progress, double fraction, int& steps) {
    if (progress && !progress(fraction)) throw Interrupted();
    Blocks blocks(relaxation.parameters(), shape, options.keep_normals);
    ceres::Problem::Options settings;
    settings.evaluation_callback = &blocks;
    settings.disable_all_safety_checks = true;
    ceres::Problem problem(settings);
    blocks.add_to(problem);
    using Term = Relaxation::Term;
    const std::vector<Term> terms = relaxation.terms(
        penalty, {}, relaxation.above(shape, k_stage.hinge_margin * penalty.incidence));
    const auto hinges = std::find_if(terms.begin(), terms.end(), [](const Term& term) {
        return term.kind == Term::Kind::hinge;
    });
    for (auto term = terms.begin(); term != hinges; ++term) {
        add(term->formula, std::sqrt(term->variance), blocks, problem);
    }
    const Shape& mesh = relaxation.model().mesh_shape();
    for (int i = 0; i < 3 * int(mesh.points.size()) && penalty.with_priors; ++i) {
        Vec3 axis(0);
        axis[i % 3] = 1;
        add(point_component(i / 3, axis, mesh.points[std::size_t(i / 3)][i % 3]),
            penalty.mesh_sigma, blocks, problem);
    }
    for (auto term = hinges; term != terms.end(); ++term) {
        add(positive_part(term->formula), std::sqrt(term->variance), blocks, problem);
    }
    Interruptor interruptor(progress, fraction);
    ceres::Solver::Options solver = solver_options(options.most_steps);
    solver.callbacks.push_back(&interruptor);
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem, &summary);
    if (summary.termination_type == ceres::USER_FAILURE) throw Interrupted();
    steps += summary.num_successful_steps + summary.num_unsuccessful_steps;
    blocks.PrepareForEvaluation(false, true);
    return blocks.shape();
}

}  // namespace culet
