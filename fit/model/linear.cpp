#include "fit/model/linear.h"
#include "fit/model/constants.h"
#include "fit/model/equations.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/progress/check_stop.h"

namespace culet {

namespace {

// Rows divided by sigma; hard ones unchanged.
FunctionRows function_rows(const JacobianRows& rows, int unknowns) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(rows.column.size());
    for (int i = 0; i < rows.count(); ++i) {
        const double variance = rows.variance[std::size_t(i)],
                     weight = variance > 0 ? 1 / std::sqrt(variance) : 1;
        for (int k = rows.begin[std::size_t(i)]; k < rows.begin[std::size_t(i) + 1]; ++k) {
            entries.emplace_back(i, rows.column[std::size_t(k)],
                                 weight * rows.slope[std::size_t(k)]);
        }
    }
    FunctionRows result(rows.count(), unknowns);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

// The six rigid motions as steps of the unknowns.
std::vector<Eigen::VectorXd> rigid_motions(const FitModel& model, const Shape& shape) {
    const Layout layout = layout_of(shape);
    std::vector<Eigen::VectorXd> motions;
    for (int k = 0; k < 6; ++k) {
        Eigen::VectorXd g = Eigen::VectorXd::Zero(layout.size());
        Vec3 axis(0);
        axis[k % 3] = 1;
        const bool turn = k >= 3;
        for (int f = 0; f < layout.facets; ++f) {
            const Vec3& n = shape.normals[f];
            if (turn) {
                const auto [t, u] = tangents(n);
                g(layout.tilt(f)) = glm::dot(t, glm::cross(axis, n));
                g(layout.tilt(f) + 1) = glm::dot(u, glm::cross(axis, n));
            } else {
                g(layout.offset(f)) = glm::dot(n, axis);
            }
        }
        for (int p = 0; p < layout.points; ++p) {
            const Vec3 d = turn ? glm::cross(axis, shape.points[p]) : axis;
            for (int i = 0; i < 3; ++i) g(layout.point(p) + i) = d[i];
        }
        for (std::size_t r = 0; r < model.readings().size(); ++r) {
            const int extra = model.symmetries().first_extra(static_cast<int>(r));
            if (extra < 0) continue;
            const Reading& reading = model.readings()[r];
            if (reading.kind == ReadingKind::rotation) {
                const Vec3 c{shape.extras[extra], shape.extras[extra + 1], 0};
                const Vec3 d = turn ? glm::cross(axis, c) : axis;
                g(layout.extra(extra)) = d.x;
                g(layout.extra(extra) + 1) = d.y;
            } else {
                const double a = reading.has_direction ? reading.azimuth : shape.extras[extra + 1];
                const Vec3 m{std::cos(a), std::sin(a), 0};
                if (!turn) g(layout.extra(extra)) = glm::dot(m, axis);
                if (turn && !reading.has_direction) g(layout.extra(extra) + 1) = axis.z;
            }
        }
        for (const int motion : model.lines().motions()) {
            const auto step = following(shape, motion, turn, axis);
            for (int i = 0; i < LineViews::k_unknowns; ++i) {
                g(layout.extra(motion + i)) = step[std::size_t(i)];
            }
        }
        motions.push_back(std::move(g));
    }
    return motions;
}

// Whether no equation changes along the motion, to rounding error. What holds the motions of lines
// is no observation.
bool unseen(const FunctionRows& rows, const std::vector<Equation>& equations,
            const Eigen::VectorXd& g) {
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        const Equation& e = equations[std::size_t(i)];
        if (e.role == Equation::Role::placed && !e.exact) continue;
        double sum = 0, size = 0;
        for (FunctionRows::InnerIterator it(rows, i); it; ++it) {
            sum += it.value() * g(it.col());
            // A level facet's normal deviates from the vertical by rounding, and a turn moves it by
            // as little: that does not count as seen.
            size += std::abs(it.value()) * std::max(std::abs(g(it.col())), 1e-6);
        }
        if (std::abs(sum) > 1e-9 * size) return false;
    }
    return true;
}

}  // namespace

double Linearised::chi2() const {
    double sum = 0;
    for (std::size_t i = 0; i < soft.size(); ++i) {
        if (soft[i].is_counted())
            sum +=
                soft_residuals(Eigen::Index(i)) * soft_residuals(Eigen::Index(i)) + soft[i].scatter;
    }
    return sum;
}

double Linearised::worst_hard() const {
    return hard_residuals.size() == 0 ? 0 : hard_residuals.cwiseAbs().maxCoeff();
}

RowWriter::RowWriter(const Shape& shape)
    : parameters_(std::make_shared<const Parameters>(
          shape, -1, Orbits(), std::vector<bool>(shape.extras.size(), false))),
      tangent_basis_(parameters_->tangent_basis(shape)) {}

FunctionRow RowWriter::function(const Quantity& quantity) const {
    return function_row(functions({quantity}), 0);
}

FunctionRows RowWriter::functions(const std::vector<Quantity>& quantities) const {
    check_stop();
    JacobianRows rows;
    Parameters::Row sum = row();
    for (const Quantity& quantity : quantities) {
        sum.quantity(quantity);
        sum.close(rows, 0, 0);
    }
    return function_rows(rows, parameters_->size());
}

FunctionRow function_row(const FunctionRows& rows, Eigen::Index i) {
    FunctionRow row(rows.cols());
    for (FunctionRows::InnerIterator it(rows, i); it; ++it) row.coeffRef(it.col()) += it.value();
    return row;
}

std::vector<bool> loose_points(const FitModel& model) {
    std::vector<bool> loose(model.mesh_shape().points.size(), true);
    for (const Incidence& i : model.meets().incidences) {
        if (i.how != MeetTreatment::released) loose[std::size_t(i.point)] = false;
    }
    return loose;
}

Linearised linearise(const FitModel& model, const Shape& shape,
                     const std::shared_ptr<const Outline>& outline,
                     const std::vector<Equation>& held) {
    Linearised linear;
    linear.layout = layout_of(shape);
    linear.has_prior = !model.prior().empty() || model.has_outlines();
    linear.writer = RowWriter(shape);
    Parameters::Row row = linear.writer.row();
    JacobianRows soft, hard;
    const auto put = [&](Equation&& e) {
        const Quantity q = e.formula(shape);
        row.quantity(q);
        if (e.exact) {
            row.close(hard, q.value - e.value, 0);
            linear.hard.push_back(std::move(e));
        } else {
            row.close(soft, (q.value - e.value) / e.sigma, e.sigma * e.sigma);
            linear.soft.push_back(std::move(e));
        }
    };
    for (Equation& e : all_equations(model, shape, outline)) put(std::move(e));
    for (const Equation& e : held) put(Equation(e));
    const int unknowns = linear.layout.size();
    linear.soft_rows = function_rows(soft, unknowns);
    linear.hard_rows = function_rows(hard, unknowns);
    linear.soft_residuals = soft.residuals();
    linear.hard_residuals = hard.residuals();
    linear.metric =
        Eigen::Map<const Eigen::VectorXd>(linear.writer.parameters().metric().data(), unknowns);
    const std::vector<bool> loose = loose_points(model);
    for (int p = 0; p < linear.layout.points; ++p) {
        if (loose[std::size_t(p)])
            linear.metric.segment(linear.layout.point(p), 3) *= k_shapes.loose_point;
    }
    for (const int motion : model.lines().motions()) {
        linear.metric.segment(linear.layout.extra(motion), LineViews::k_unknowns) *=
            k_shapes.loose_motion;
    }
    std::vector<Eigen::VectorXd> motions = rigid_motions(model, shape);
    linear.turn = motions[5];
    for (Eigen::VectorXd& g : motions) {
        if (unseen(linear.soft_rows, linear.soft, g) && unseen(linear.hard_rows, linear.hard, g)) {
            linear.gauge_rows.push_back(linear.metric.cwiseProduct(g));
            linear.gauge_rows.back().normalize();
        }
    }
    return linear;
}

}  // namespace culet
