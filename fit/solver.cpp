#include "fit/solver.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/errors.h"

namespace culet {

namespace {

using By = Quantity::By;

// One equation as a Ceres residual. All equations share one scratch shape: each writes its own
// blocks into it before it is asked, so only one thread may run.
class EquationCost : public ceres::CostFunction {
public:
    EquationCost(Equation equation, double sigma, std::vector<std::pair<By, int>> blocks,
                 Shape* scratch)
        : equation_(std::move(equation)),
          sigma_(sigma),
          blocks_(std::move(blocks)),
          scratch_(scratch) {
        set_num_residuals(1);
        for (const auto& [by, index] : blocks_) {
            mutable_parameter_block_sizes()->push_back(size_of(by));
        }
    }

    static int size_of(By by) { return by == By::normal || by == By::point ? 3 : 1; }

    bool Evaluate(double const* const* parameters, double* residuals,
                  double** jacobians) const override {
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            const auto& [by, index] = blocks_[b];
            const double* p = parameters[b];
            switch (by) {
                case By::normal:
                    scratch_->normals[index] = {p[0], p[1], p[2]};
                    break;
                case By::offset:
                    scratch_->offsets[index] = p[0];
                    break;
                case By::point:
                    scratch_->points[index] = {p[0], p[1], p[2]};
                    break;
                case By::extra:
                    scratch_->extras[index] = p[0];
                    break;
            }
        }
        const Quantity q = equation_.formula(*scratch_);
        const double residual = q.value - equation_.value;
        if (!std::isfinite(residual)) return false;
        const bool off = equation_.role == Equation::Role::hinge && !(residual > 0);
        residuals[0] = off ? 0 : residual / sigma_;
        if (jacobians == nullptr) return true;
        for (std::size_t b = 0; b < blocks_.size(); ++b) {
            if (jacobians[b] == nullptr) continue;
            std::fill_n(jacobians[b], size_of(blocks_[b].first), 0.0);
            if (off) continue;
            for (const Quantity::Slope& s : q.slopes) {
                if (s.by != blocks_[b].first || s.index != blocks_[b].second) continue;
                for (int k = 0; k < size_of(s.by); ++k) jacobians[b][k] += s.slope[k] / sigma_;
            }
        }
        return true;
    }

private:
    Equation equation_;
    double sigma_;
    std::vector<std::pair<By, int>> blocks_;
    Shape* scratch_;
};

// Which unknowns an equation touches. A folded angle at its fold has no slope there, so normals
// named by a zero slope stay in.
std::vector<std::pair<By, int>> blocks_of(const Equation& equation, const Shape& shape) {
    std::vector<std::pair<By, int>> blocks;
    for (const Quantity::Slope& s : equation.formula(shape).slopes) {
        blocks.emplace_back(s.by, s.index);
    }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
}

struct Stage {
    double incidence_sigma, softening;
};
// Of the half diameter. From the schedule that brought 20 of 20 rough meshes home in trials.
constexpr std::array<Stage, 5> k_stages{
    {{0.1, 0.05}, {0.03, 0.02}, {0.01, 0.005}, {0.003, 0.0}, {0.001, 0.0}}};

class StopOnRequest : public ceres::IterationCallback {
public:
    StopOnRequest(const Progress& progress, double fraction)
        : progress_(progress), fraction_(fraction) {}
    ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
        stopped_ = progress_ && !progress_(fraction_);
        return stopped_ ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
    }
    bool stopped() const { return stopped_; }

private:
    const Progress& progress_;
    double fraction_;
    bool stopped_ = false;
};

double sigma_at(const Equation& e, const Stage& stage) {
    switch (e.role) {
        case Equation::Role::incidence:
        case Equation::Role::released:
            return e.exact ? stage.incidence_sigma : std::hypot(e.sigma, stage.incidence_sigma);
        case Equation::Role::hinge:
            return stage.incidence_sigma / 5;
        case Equation::Role::prior:
            return e.sigma;
        default:
            // An exact reading is as tight as the incidences of its stage.
            return e.exact ? stage.incidence_sigma : std::hypot(e.sigma, stage.softening);
    }
}

// What a stage solves for.
struct StageScope {
    bool keep_normals = false;
    bool with_readings = true;  ///< false: only a convex stone of these meets, near the mesh
};

void solve_stage(const System& system, Shape& shape, const Stage& stage, const StageScope& scope,
                 const Progress& progress, double fraction) {
    Shape scratch = shape;
    ceres::Problem::Options problem_options;
    ceres::Problem problem(problem_options);
    ceres::SphereManifold<3>* sphere = new ceres::SphereManifold<3>;
    bool sphere_used = false;
    const auto data = [&](const std::pair<By, int>& block) -> double* {
        switch (block.first) {
            case By::normal:
                return &shape.normals[block.second].x;
            case By::offset:
                return &shape.offsets[block.second];
            case By::point:
                return &shape.points[block.second].x;
            default:
                return &shape.extras[block.second];
        }
    };
    const auto put = [&](Equation&& e) {
        const std::vector<std::pair<By, int>> blocks = blocks_of(e, shape);
        if (blocks.empty()) return;
        const double sigma = sigma_at(e, stage);
        std::vector<double*> pointers;
        for (const auto& block : blocks) {
            double* p = data(block);
            pointers.push_back(p);
            if (problem.HasParameterBlock(p)) continue;
            problem.AddParameterBlock(p, EquationCost::size_of(block.first));
            if (block.first != By::normal) continue;
            problem.SetManifold(p, sphere);
            sphere_used = true;
            if (scope.keep_normals || block.second == system.up_facet()) {
                problem.SetParameterBlockConstant(p);
            }
        }
        problem.AddResidualBlock(new EquationCost(std::move(e), sigma, blocks, &scratch), nullptr,
                                 pointers);
    };
    for (Equation& e : system.equations(shape, system.mesh_outline())) {
        if (scope.with_readings || e.incidence >= 0) put(std::move(e));
    }
    for (Equation& e : system.hinges()) put(std::move(e));
    for (Equation& e : system.priors()) put(std::move(e));
    if (!sphere_used) delete sphere;

    ceres::Solver::Options options;
    options.num_threads = 1;
    options.max_num_iterations = 40;
    options.function_tolerance = 1e-5;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.logging_type = ceres::SILENT;
    options.minimizer_progress_to_stdout = false;
    StopOnRequest stop(progress, fraction);
    options.callbacks.push_back(&stop);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (stop.stopped()) throw Interrupted();
    for (Vec3& n : shape.normals) n = glm::normalize(n);
}

}  // namespace

Graded graded_fit(const System& system, const GradedStart& start, const Progress& progress) {
    Graded result;
    result.shape = start.shape;
    // First a convex stone with planar facets, whatever its size: lengths of edges that a rough
    // mesh has inside out would hold it there.
    const bool keep = start.keep_normals_at_first;
    solve_stage(system, result.shape, {0.03, 0.0}, {keep, false}, progress, 0.05);
    if (keep) solve_stage(system, result.shape, {0.03, 0.02}, {true, true}, progress, 0.08);
    for (std::size_t s = 0; s < k_stages.size(); ++s) {
        solve_stage(system, result.shape, k_stages[s], {}, progress,
                    0.1 + 0.1 * static_cast<double>(s));
    }
    result.convex = true;
    for (const Equation& e : system.hinges()) {
        if (e.formula(result.shape).value > 0) result.convex = false;
    }
    return result;
}

GradedStart start_from_angles(const System& system) {
    GradedStart start{system.mesh_shape(), true};
    const std::size_t facets = start.shape.normals.size();
    std::vector<double> tilt(facets, -1), turn(facets, 0);
    std::vector<bool> turned(facets, false);
    for (const Reading& r : system.readings()) {
        if (r.datum.kind != Datum::Kind::up || r.facets.empty()) continue;
        for (int f : r.facets) {
            if (r.kind == ReadingKind::inclination) tilt[f] = r.value;
            if (r.kind == ReadingKind::azimuth) {
                turn[f] = r.value;
                turned[f] = true;
            }
        }
    }
    for (std::size_t f = 0; f < facets; ++f) {
        if (static_cast<int>(f) == system.up_facet()) continue;
        Vec3& n = start.shape.normals[f];
        const double flat = std::hypot(n.x, n.y);
        const double inclination = tilt[f] >= 0 ? tilt[f] : std::atan2(flat, std::abs(n.z));
        const double azimuth = turned[f] ? turn[f] : std::atan2(n.y, n.x);
        n = {std::sin(inclination) * std::cos(azimuth), std::sin(inclination) * std::sin(azimuth),
             std::cos(inclination)};
        // Inclinations do not say whether a facet looks up or down; where it lies does, better than
        // the normal of a rough mesh.
        Vec3 mean(0);
        const std::vector<int>& loop = system.mesh_outline()->loops[f];
        for (int corner : loop) mean += start.shape.points[corner] / double(loop.size());
        if (glm::dot(n, mean) < glm::dot(Vec3{n.x, n.y, -n.z}, mean)) n.z = -n.z;
        start.shape.offsets[f] = glm::dot(n, mean);
    }
    return start;
}

}  // namespace culet
