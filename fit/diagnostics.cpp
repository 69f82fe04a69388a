#include "fit/diagnostics.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "fit/linear.h"
#include "fit/statistics.h"

namespace culet {

namespace {

// A redundancy this small is rounding: nothing checks the equation.
constexpr double k_no_redundancy = 1e-6;
// An error of size limit + 0.84 sigma is found in 80 of 100 cases.
constexpr double k_power_80 = 0.8416212335729143;
// Freedoms held less than twice as tightly by the readings as by the mesh (lambda = 4 in
// variance) count as not determined.
constexpr double k_determined = 4;
// Dense algebra beyond this many unknowns would take minutes.
constexpr Eigen::Index k_most_dense = 2400;

// Directions of the unknowns that satisfy all hard equations and gauge rows.
Eigen::MatrixXd free_directions(const Linearised& linear) {
    const Eigen::Index n = linear.layout.size();
    const Eigen::Index gauges = static_cast<Eigen::Index>(linear.gauge_rows.size());
    Eigen::MatrixXd rows(linear.hard_rows.rows() + gauges, n);
    rows.topRows(linear.hard_rows.rows()) = linear.hard_rows;
    for (Eigen::Index k = 0; k < gauges; ++k) {
        rows.row(linear.hard_rows.rows() + k) = linear.gauge_rows[k].transpose();
    }
    if (rows.rows() == 0) return Eigen::MatrixXd::Identity(n, n);
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(rows.transpose());
    qr.setThreshold(1e-10);
    const Eigen::Index rank = qr.rank();
    Eigen::MatrixXd selector = Eigen::MatrixXd::Zero(n, n - rank);
    selector.bottomRows(n - rank).setIdentity();
    return qr.householderQ() * selector;
}

struct Modes {
    Eigen::MatrixXd held;  ///< covariance factor: cov = held held'
    Eigen::MatrixXd open;  ///< undetermined directions, of length one in the mesh's metric
};

// Splits the free directions by how tightly the readings hold them, relative to the mesh's metric.
Modes modes_of(const Linearised& linear) {
    const Eigen::MatrixXd z = free_directions(linear);
    if (z.cols() == 0) {
        // Exact readings leave nothing free.
        return {Eigen::MatrixXd(linear.layout.size(), 0), Eigen::MatrixXd(linear.layout.size(), 0)};
    }
    // Whitening by the metric first turns the generalised eigenproblem into a plain one.
    const Eigen::MatrixXd metric = z.transpose() * linear.metric.asDiagonal() * z;
    const Eigen::LLT<Eigen::MatrixXd> chol(metric);
    const Eigen::MatrixXd whitened = chol.matrixL().solve(z.transpose()).transpose();  // z L^-T
    Eigen::SparseMatrix<double, Eigen::RowMajor> rows = linear.soft_rows;
    for (std::size_t i = 0; i < linear.soft.size(); ++i) {
        if (linear.soft[i].role != Equation::Role::hinge) continue;
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(rows, Eigen::Index(i));
             it; ++it) {
            it.valueRef() = 0;
        }
    }
    const Eigen::MatrixXd seen = rows * whitened;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(seen.transpose() * seen);
    Eigen::Index open = 0;
    while (open < eigen.eigenvalues().size() && eigen.eigenvalues()(open) < k_determined) ++open;
    Modes modes;
    modes.open = whitened * eigen.eigenvectors().leftCols(open);
    modes.held = whitened * eigen.eigenvectors().rightCols(eigen.eigenvalues().size() - open);
    for (Eigen::Index k = 0; k < modes.held.cols(); ++k) {
        modes.held.col(k) /= std::sqrt(eigen.eigenvalues()(open + k));
    }
    return modes;
}

// Rows that turn unknowns into inclination, azimuth and distance from the middle of the stone.
Eigen::MatrixXd facet_rows(const Shape& shape, int f, const Layout& layout, const Vec3& middle) {
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, layout.size());
    const Vec3& n = shape.normals[f];
    const auto basis = tangents(n);
    const double flat = std::hypot(n.x, n.y);
    for (int k = 0; k < 2; ++k) {
        const Vec3& t = basis[static_cast<std::size_t>(k)];
        if (flat > 1e-9) {
            const Vec3 outward{n.x / flat, n.y / flat, 0};
            // inclination = atan2(flat, |z|)
            rows(0, layout.tilt(f) + k) =
                std::abs(n.z) * glm::dot(outward, t) - std::copysign(flat, n.z) * t.z;
            rows(1, layout.tilt(f) + k) = (n.x * t.y - n.y * t.x) / (flat * flat);
        } else {
            rows(0, layout.tilt(f) + k) = 1;
        }
        rows(2, layout.tilt(f) + k) = -glm::dot(middle, t);
    }
    rows(2, layout.offset(f)) = 1;
    return rows;
}

double size_of(const Eigen::MatrixXd& factor, const Eigen::RowVectorXd& row) {
    return (row * factor).norm();
}

void find_open_freedoms(const System& system, const Shape& shape, const Modes& modes,
                        const Vec3& middle, Diagnosis& diagnosis) {
    diagnosis.undetermined_freedoms = static_cast<int>(modes.open.cols());
    if (modes.open.cols() == 0) return;
    const Layout layout = layout_of(shape);
    // A freedom is named when the open directions together may move it by a tenth of what the mesh
    // itself is trusted for; of a single direction, at least its largest mover is named.
    for (int f = 0; f < layout.facets; ++f) {
        const Eigen::MatrixXd rows = facet_rows(shape, f, layout, middle);
        static constexpr std::array<const char*, 3> names{"inclination", "azimuth", "offset"};
        const double flat = std::hypot(shape.normals[f].x, shape.normals[f].y);
        for (int k = 0; k < 3; ++k) {
            if (k == 1 && flat < 1e-9) continue;
            if (size_of(modes.open, rows.row(k)) > 0.02) {
                diagnosis.undetermined.push_back(
                    {system.stone().solid.facets[f].name, names[static_cast<std::size_t>(k)]});
            }
        }
    }
}

// Baarda's data snooping: the worst equation is set aside, the residuals of the others follow in
// closed form (rank-one update), until none stands out.
void snoop(const System& system, const Linearised& linear, const std::vector<Eigen::Index>& counted,
           const Eigen::MatrixXd& projected, double limit, Diagnosis& diagnosis) {
    const Eigen::Index count = static_cast<Eigen::Index>(counted.size());
    // R = 1 - J C J'; the residuals are R times the errors.
    Eigen::MatrixXd r = Eigen::MatrixXd::Identity(count, count) - projected;
    Eigen::VectorXd e(count);
    for (Eigen::Index i = 0; i < count; ++i) e(i) = linear.soft_residuals(counted[std::size_t(i)]);
    std::vector<bool> removed(system.readings().size(), false);
    const std::size_t most = std::max<std::size_t>(3, counted.size() / 10);
    while (diagnosis.suspects.size() < most) {
        Eigen::Index worst = -1;
        double largest = limit;
        for (Eigen::Index i = 0; i < count; ++i) {
            if (!(r(i, i) > 1e-4)) continue;
            const double w = std::abs(e(i)) / std::sqrt(r(i, i));
            if (w > largest) {
                largest = w;
                worst = i;
            }
        }
        if (worst < 0) return;
        const int reading = linear.soft[std::size_t(counted[std::size_t(worst)])].reading;
        if (reading >= 0 && !removed[std::size_t(reading)]) {
            removed[std::size_t(reading)] = true;
            diagnosis.suspects.push_back(reading);
            diagnosis.readings[std::size_t(reading)].suspect = true;
        }
        const Eigen::VectorXd column = r.col(worst) / r(worst, worst);
        e -= column * e(worst);
        r -= column * Eigen::RowVectorXd(r.row(worst));
        r.row(worst).setZero();
        r.col(worst).setZero();
    }
}

// A stone too large for dense algebra: what every reading came to, and nothing of how sure that is.
void residuals_only(const System& system, const Linearised& linear,
                    const std::vector<Eigen::Index>& counted, Diagnosis& diagnosis) {
    constexpr double k_unknown = std::numeric_limits<double>::quiet_NaN();
    diagnosis.analysed = false;
    for (ReadingCheck& c : diagnosis.readings) c.normalized = c.redundancy = k_unknown;
    for (FacetSigma& s : diagnosis.facets) s = {k_unknown, k_unknown, k_unknown, k_unknown};
    const auto note = [&](const Equation& e, double residual) {
        if (e.reading < 0) return;
        ReadingCheck& c = diagnosis.readings[std::size_t(e.reading)];
        const double in_units =
            residual * system.unit_of(system.readings()[std::size_t(e.reading)]);
        if (std::abs(in_units) > std::abs(c.residual)) c.residual = in_units;
    };
    for (const Eigen::Index i : counted) {
        const Equation& e = linear.soft[std::size_t(i)];
        note(e, linear.soft_residuals(i) * e.sigma);
    }
    for (std::size_t i = 0; i < linear.hard.size(); ++i) {
        note(linear.hard[i], linear.hard_residuals(Eigen::Index(i)));
    }
    // Bounds by counting: no more redundancy than readings, no fewer open freedoms than unknowns
    // that outnumber all equations.
    diagnosis.dof = double(counted.size());
    const Eigen::Index equations = Eigen::Index(counted.size()) + linear.hard_rows.rows() +
                                   Eigen::Index(linear.gauge_rows.size());
    diagnosis.undetermined_freedoms =
        static_cast<int>(std::max<Eigen::Index>(0, linear.layout.size() - equations));
}

}  // namespace

Diagnosis diagnose(const System& system, const Shape& shape,
                   const std::shared_ptr<const Outline>& outline, const DiagnosisOptions& options) {
    Diagnosis diagnosis;
    const Linearised linear = linearise(system, shape, outline, false);
    const Layout layout = linear.layout;
    diagnosis.chi2 = linear.chi2();
    diagnosis.readings.resize(system.readings().size());
    diagnosis.facets.resize(shape.normals.size());
    std::vector<Eigen::Index> counted;
    for (std::size_t i = 0; i < linear.soft.size(); ++i) {
        if (linear.soft[i].is_counted()) counted.push_back(Eigen::Index(i));
    }
    if (layout.size() > k_most_dense) {
        residuals_only(system, linear, counted, diagnosis);
        return diagnosis;
    }
    const Modes modes = modes_of(linear);
    Eigen::MatrixXd seen(Eigen::Index(counted.size()), modes.held.cols());
    {
        const Eigen::MatrixXd all = linear.soft_rows * modes.held;
        for (std::size_t i = 0; i < counted.size(); ++i) {
            seen.row(Eigen::Index(i)) = all.row(counted[i]);
        }
    }
    std::vector<double> redundancy(counted.size());
    for (std::size_t i = 0; i < counted.size(); ++i) {
        redundancy[i] = 1 - seen.row(Eigen::Index(i)).squaredNorm();
        if (redundancy[i] < k_no_redundancy) redundancy[i] = 0;
        diagnosis.dof += redundancy[i];
        const Equation& e = linear.soft[std::size_t(counted[i])];
        if (e.group >= 0) {
            const double miss = linear.soft_residuals(counted[i]) * e.sigma;
            diagnosis.group_squares[std::size_t(e.group)] += miss * miss;
            diagnosis.group_redundancy[std::size_t(e.group)] += redundancy[i];
        }
    }
    if (!options.full) return diagnosis;

    // Every reading's equations together; the worst of them speaks for the reading.
    diagnosis.suspect_limit = two_sided_normal_quantile(
        options.significance / std::max<double>(1, double(counted.size())));
    std::vector<int> terms(system.readings().size(), 0);
    const auto note = [&](const Equation& e, double residual, double r, double w) {
        if (e.reading < 0) return;
        const Reading& reading = system.readings()[std::size_t(e.reading)];
        ReadingCheck& c = diagnosis.readings[std::size_t(e.reading)];
        const double unit = system.unit_of(reading);
        if (terms[std::size_t(e.reading)]++ == 0 ||
            std::abs(residual * unit) > std::abs(c.residual)) {
            c.residual = residual * unit;
        }
        if (std::abs(w) > std::abs(c.normalized)) c.normalized = w;
        c.redundancy += r;
        if (r > k_no_redundancy) {
            const double found =
                e.sigma * unit * (diagnosis.suspect_limit + k_power_80) / std::sqrt(r);
            c.detectable = c.detectable == 0 ? found : std::max(c.detectable, found);
        }
    };
    for (std::size_t i = 0; i < counted.size(); ++i) {
        const Equation& e = linear.soft[std::size_t(counted[i])];
        const double scaled = linear.soft_residuals(counted[i]);
        const double w = redundancy[i] > k_no_redundancy ? scaled / std::sqrt(redundancy[i]) : 0;
        note(e, scaled * e.sigma, redundancy[i], w);
    }
    for (std::size_t i = 0; i < linear.hard.size(); ++i) {
        note(linear.hard[i], linear.hard_residuals(Eigen::Index(i)), 0, 0);
    }
    for (std::size_t r = 0; r < terms.size(); ++r) {
        if (terms[r] > 0) diagnosis.readings[r].redundancy /= terms[r];
    }
    snoop(system, linear, counted, seen * seen.transpose(), diagnosis.suspect_limit, diagnosis);

    Vec3 middle(0);
    for (const Vec3& p : shape.points) middle += p / double(shape.points.size());
    for (int f = 0; f < layout.facets; ++f) {
        const Eigen::MatrixXd rows = facet_rows(shape, f, layout, middle);
        Eigen::MatrixXd both = rows * modes.held;
        const Eigen::MatrixXd open = rows * modes.open;
        const auto total = [&](int k) {
            return std::sqrt(both.row(k).squaredNorm() + open.row(k).squaredNorm());
        };
        FacetSigma& sigma = diagnosis.facets[std::size_t(f)];
        sigma.inclination = total(0);
        sigma.offset = total(2);
        const double flat = std::hypot(shape.normals[f].x, shape.normals[f].y);
        sigma.azimuth = flat > 1e-9 ? total(1) : std::numeric_limits<double>::quiet_NaN();
    }
    const RowWriter writer(shape);
    for (int f = 0; f < layout.facets; ++f) {
        if (outline->loops[f].size() < 3) continue;
        std::vector<Corner> loop;
        for (int c : outline->loops[f]) loop.push_back(outline->corners[c]);
        const Eigen::RowVectorXd row = writer.row(enclosed_area(loop)(shape));
        diagnosis.facets[std::size_t(f)].area =
            std::hypot(size_of(modes.held, row), size_of(modes.open, row));
    }
    find_open_freedoms(system, shape, modes, middle, diagnosis);
    return diagnosis;
}

}  // namespace culet
