#include "fit/model/linear.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace culet {

namespace {

using Triplets = RowWriter::Triplets;

// What a step of one means for each unknown: a mesh may be off by 20 % of its width in its points;
// tilts, offsets and extras are of the order of one.
constexpr double k_point_weight = 1 / (0.4 * 0.4);
constexpr double k_loose_point_weight = 0.5;

// The six rigid motions as steps of the unknowns.
std::vector<Eigen::VectorXd> rigid_motions(const System& system, const Shape& shape) {
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
        for (std::size_t r = 0; r < system.readings().size(); ++r) {
            const int extra = system.first_extra(static_cast<int>(r));
            if (extra < 0) continue;
            const Reading& reading = system.readings()[r];
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
        motions.push_back(std::move(g));
    }
    return motions;
}

// No equation changes along the motion, as far as rounding lets one see.
bool unseen(const Eigen::SparseMatrix<double, Eigen::RowMajor>& rows, const Eigen::VectorXd& g) {
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        double sum = 0, size = 0;
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(rows, i); it; ++it) {
            sum += it.value() * g(it.col());
            // A level facet's normal is off the vertical by rounding: what a turn does to that is
            // no sight of it.
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

double Linearised::merit() const {
    return soft_residuals.squaredNorm();
}

double Linearised::worst_hard() const {
    return hard_residuals.size() == 0 ? 0 : hard_residuals.cwiseAbs().maxCoeff();
}

RowWriter::RowWriter(const Shape& shape) : layout_(layout_of(shape)) {
    for (const Vec3& n : shape.normals) tangents_.push_back(tangents(n));
}

void RowWriter::write(const Quantity& quantity, int row, double factor, Triplets& to) const {
    for (const Quantity::Slope& s : quantity.slopes) {
        switch (s.by) {
            case Quantity::By::normal:
                for (int k = 0; k < 2; ++k) {
                    to.emplace_back(row, layout_.tilt(s.index) + k,
                                    factor * glm::dot(tangents_[s.index][k], s.slope));
                }
                break;
            case Quantity::By::offset:
                to.emplace_back(row, layout_.offset(s.index), factor * s.slope.x);
                break;
            case Quantity::By::point:
                for (int k = 0; k < 3; ++k) {
                    to.emplace_back(row, layout_.point(s.index) + k, factor * s.slope[k]);
                }
                break;
            case Quantity::By::extra:
                to.emplace_back(row, layout_.extra(s.index), factor * s.slope.x);
                break;
        }
    }
}

FunctionRow RowWriter::function(const Quantity& quantity) const {
    Triplets entries;
    write(quantity, 0, 1, entries);
    FunctionRow row(layout_.size());
    for (const auto& entry : entries) row.coeffRef(entry.col()) += entry.value();
    return row;
}

FunctionRows RowWriter::functions(const std::vector<Quantity>& quantities) const {
    Triplets entries;
    for (std::size_t i = 0; i < quantities.size(); ++i) write(quantities[i], int(i), 1, entries);
    FunctionRows rows(Eigen::Index(quantities.size()), layout_.size());
    rows.setFromTriplets(entries.begin(), entries.end());
    return rows;
}

FunctionRow function_row(const FunctionRows& rows, Eigen::Index i) {
    FunctionRow row(rows.cols());
    for (FunctionRows::InnerIterator it(rows, i); it; ++it) row.coeffRef(it.col()) += it.value();
    return row;
}

Linearised linearise(const System& system, const Shape& shape,
                     const std::shared_ptr<const Outline>& outline,
                     const std::vector<Equation>& held) {
    Linearised linear;
    linear.layout = layout_of(shape);
    linear.has_prior = system.has_prior();
    linear.writer = RowWriter(shape);
    Triplets soft, hard;
    std::vector<double> soft_residuals, hard_residuals;
    const auto put = [&](Equation&& e) {
        const Quantity q = e.formula(shape);
        const double residual = q.value - e.value;
        if (e.exact) {
            linear.writer.write(q, static_cast<int>(linear.hard.size()), 1, hard);
            hard_residuals.push_back(residual);
            linear.hard.push_back(std::move(e));
        } else {
            linear.writer.write(q, static_cast<int>(linear.soft.size()), 1 / e.sigma, soft);
            soft_residuals.push_back(residual / e.sigma);
            linear.soft.push_back(std::move(e));
        }
    };
    for (Equation& e : system.equations(shape, outline)) put(std::move(e));
    for (const Equation& e : held) put(Equation(e));
    const Eigen::Index unknowns = linear.layout.size();
    linear.soft_rows.resize(Eigen::Index(linear.soft.size()), unknowns);
    linear.soft_rows.setFromTriplets(soft.begin(), soft.end());
    linear.hard_rows.resize(Eigen::Index(linear.hard.size()), unknowns);
    linear.hard_rows.setFromTriplets(hard.begin(), hard.end());
    linear.soft_residuals =
        Eigen::Map<Eigen::VectorXd>(soft_residuals.data(), Eigen::Index(soft_residuals.size()));
    linear.hard_residuals =
        Eigen::Map<Eigen::VectorXd>(hard_residuals.data(), Eigen::Index(hard_residuals.size()));
    linear.metric = Eigen::VectorXd::Ones(unknowns);
    linear.metric.segment(linear.layout.point(0), 3 * linear.layout.points)
        .setConstant(k_point_weight);
    // The point of a meet that was let go belongs to nothing: wherever it lies, nothing is open.
    std::vector<bool> held_point(std::size_t(linear.layout.points), false);
    for (const Incidence& incidence : system.incidences()) {
        if (incidence.how != MeetTreatment::released)
            held_point[std::size_t(incidence.point)] = true;
    }
    for (int p = 0; p < linear.layout.points; ++p) {
        if (held_point[std::size_t(p)]) continue;
        linear.metric.segment(linear.layout.point(p), 3).setConstant(k_loose_point_weight);
    }
    std::vector<Eigen::VectorXd> motions = rigid_motions(system, shape);
    linear.turn = motions[5];
    for (Eigen::VectorXd& g : motions) {
        if (unseen(linear.soft_rows, g) && unseen(linear.hard_rows, g)) {
            linear.gauge_rows.push_back(linear.metric.cwiseProduct(g));
            linear.gauge_rows.back().normalize();
        }
    }
    return linear;
}

JacobianRows kkt_rows(const Linearised& linear, bool with_soft, double hard_scale) {
    JacobianRows rows;
    const auto add = [&](const Eigen::SparseMatrix<double, Eigen::RowMajor>& from, double scale,
                         double variance) {
        for (Eigen::Index i = 0; i < from.rows(); ++i) {
            for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(from, i); it;
                 ++it) {
                rows.add(static_cast<int>(it.col()), scale * it.value());
            }
            rows.close(0, variance);
        }
    };
    add(linear.hard_rows, hard_scale, 0);
    for (const Eigen::VectorXd& gauge : linear.gauge_rows) {
        for (Eigen::Index i = 0; i < gauge.size(); ++i) {
            if (gauge(i) != 0) rows.add(static_cast<int>(i), gauge(i));
        }
        rows.close(0, 0);
    }
    if (with_soft) add(linear.soft_rows, 1, 1);
    return rows;
}

Eigen::Index kkt_row_count(const Linearised& linear, bool with_soft) {
    return linear.hard_rows.rows() + Eigen::Index(linear.gauge_rows.size()) +
           (with_soft ? linear.soft_rows.rows() : 0);
}

}  // namespace culet
