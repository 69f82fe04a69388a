#include "render/colour/smooth_primaries.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "stone/numbers/dense_algebra.h"

namespace culet {

namespace {

// Largest number of free nodes: an even choice, interpolated linearly. This keeps the solve small
// and the spectra smooth.
constexpr Eigen::Index k_most_free = 33;

// Row i: weights of the free values at node i; each row sums to 1.
Eigen::MatrixXd interpolation(const std::vector<double>& nm) {
    const Eigen::Index n = static_cast<Eigen::Index>(nm.size());
    const Eigen::Index free = std::min(n, k_most_free);
    Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(n, free);
    for (Eigen::Index f = 0; f + 1 < free; ++f) {
        const Eigen::Index from = f * (n - 1) / (free - 1), to = (f + 1) * (n - 1) / (free - 1);
        for (Eigen::Index i = from; i <= to; ++i) {
            const double t = (nm[i] - nm[from]) / (nm[to] - nm[from]);
            shares.row(i).setZero();
            shares(i, f) = 1 - t;
            shares(i, f + 1) = t;
        }
    }
    return shares;
}

// Minimises x'N x / 2 under A x = b with Lagrange multipliers, and again with some values of x
// fixed; one factorization serves all.
class ConstrainedQuadratic {
public:
    ConstrainedQuadratic(const Eigen::MatrixXd& normal, const Eigen::MatrixXd& A,
                         const Eigen::VectorXd& b)
        : A_(A), b_(b) {
        const Eigen::Index all = normal.rows(), rows = A.rows();
        Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(all + rows, all + rows);
        kkt.topLeftCorner(all, all) = normal;
        kkt.topRightCorner(all, rows) = A.transpose();
        kkt.bottomLeftCorner(rows, all) = A;
        const Eigen::MatrixXd inverse = pseudo_inverse(kkt);
        free_ = inverse.topRightCorner(all, rows) * b;
        give_ = inverse.topLeftCorner(all, all);
    }
    /// Adds the constraints H x = h. Returns nothing if the constraints are contradictory.
    std::optional<Eigen::VectorXd> with(const Eigen::MatrixXd& H, const Eigen::VectorXd& h) const {
        Eigen::VectorXd x = free_;
        if (H.rows() > 0) {
            const Eigen::MatrixXd moved = times_transpose(give_, H);
            const Eigen::VectorXd push = shortest_solution(product(H, moved), h - H * free_);
            x += moved * push;
        }
        const double off = std::max((A_ * x - b_).cwiseAbs().maxCoeff(),
                                    H.rows() > 0 ? (H * x - h).cwiseAbs().maxCoeff() : 0.0);
        if (off > 1e-11) return std::nullopt;
        return x;
    }

private:
    Eigen::MatrixXd A_, give_;
    Eigen::VectorXd b_, free_;
};

// The unknowns are red and blue, less a third each (grey light); green is the rest.
constexpr double k_third = 1.0 / 3;

Eigen::MatrixXd primaries_of(const Eigen::VectorXd& unknown) {
    const Eigen::Index n = unknown.size() / 2;
    Eigen::MatrixXd values(n, 3);
    values.col(0) = unknown.head(n);
    values.col(1) = -unknown.head(n) - unknown.tail(n);
    values.col(2) = unknown.tail(n);
    return Eigen::MatrixXd(values.array() + k_third);
}

// Grey light of a third each already integrates to a third per colour.
Eigen::Vector3d wanted(int primary) {
    return Eigen::Vector3d(Eigen::Vector3d::Unit(primary).array() - k_third);
}

// Sum of squares of all three primaries.
Eigen::MatrixXd of_all_three(const Eigen::MatrixXd& square) {
    const Eigen::Index n = square.rows();
    Eigen::MatrixXd normal(2 * n, 2 * n);
    normal << 2 * square, square, square, 2 * square;
    return normal;
}

// Empty if the integrals cannot be exact.
Eigen::MatrixXd exact_primaries(const Eigen::MatrixXd& roughness, const Eigen::MatrixXd& weight) {
    const Eigen::Index n = weight.cols();
    Eigen::MatrixXd integrals = Eigen::MatrixXd::Zero(6, 2 * n);
    integrals.block(0, 0, 3, n) = weight;
    integrals.block(3, n, 3, n) = weight;
    Eigen::VectorXd colours(6);
    colours << wanted(0), wanted(2);
    const ConstrainedQuadratic smoothest(roughness, integrals, colours);
    std::vector<std::pair<Eigen::Index, Eigen::Index>> active;  // node, primary
    Eigen::MatrixXd best;
    while (true) {
        const Eigen::Index rows = static_cast<Eigen::Index>(active.size());
        Eigen::MatrixXd H = Eigen::MatrixXd::Zero(rows, 2 * n);
        for (Eigen::Index row = 0; row < rows; ++row) {
            const auto [node, primary] = active[static_cast<std::size_t>(row)];
            if (primary != 2) H(row, node) = primary == 0 ? 1 : -1;
            if (primary != 0) H(row, n + node) = primary == 2 ? 1 : -1;
        }
        const auto unknown = smoothest.with(H, Eigen::VectorXd::Constant(rows, -k_third));
        if (!unknown) break;
        const Eigen::MatrixXd values = primaries_of(*unknown);
        // With few nodes, fixing a value can push another below 0: keep the least negative
        // solution.
        if (best.size() == 0 || values.minCoeff() > best.minCoeff()) best = values;
        std::pair<Eigen::Index, Eigen::Index> worst;
        if (values.minCoeff(&worst.first, &worst.second) >= -1e-12) break;
        if (std::find(active.begin(), active.end(), worst) != active.end()) break;
        active.push_back(worst);
    }
    return best;
}

Eigen::MatrixXd approximate_primaries(const Eigen::MatrixXd& roughness,
                                      const Eigen::MatrixXd& weight) {
    // Only determines what the integrals leave open.
    constexpr double k_smoothness = 1e-6;
    Eigen::VectorXd pull(roughness.rows());
    pull << weight.transpose() * (wanted(0) - wanted(1)),
        weight.transpose() * (wanted(2) - wanted(1));
    const Eigen::MatrixXd normal =
        k_smoothness * roughness + of_all_three(transpose_times(weight, weight));
    return primaries_of(shortest_solution(normal, pull));
}

}  // namespace

std::array<std::vector<double>, 3> smooth_primaries(const Eigen::MatrixXd& rgb_weight,
                                                    const std::vector<double>& nm) {
    const Eigen::MatrixXd shares = interpolation(nm);
    const Eigen::MatrixXd weight = product(rgb_weight, shares);
    const Eigen::Index n = weight.cols();
    Eigen::MatrixXd differences = Eigen::MatrixXd::Zero(n - 1, n);
    differences.diagonal().setConstant(-1);
    differences.diagonal(1).setOnes();
    const Eigen::MatrixXd roughness = of_all_three(transpose_times(differences, differences));
    Eigen::MatrixXd best = exact_primaries(roughness, weight);
    if (best.size() == 0) best = approximate_primaries(roughness, weight);
    std::array<std::vector<double>, 3> primaries;
    for (int p = 0; p < 3; ++p) {
        const Eigen::VectorXd at_nodes = shares * best.col(p);
        primaries[std::size_t(p)].assign(at_nodes.data(), at_nodes.data() + at_nodes.size());
    }
    return primaries;
}

}  // namespace culet
