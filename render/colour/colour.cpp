#include "render/colour/colour.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>

#include "stone/numbers/dense_algebra.h"
#include "stone/text/errors.h"

namespace culet {

namespace {

// IEC 61966-2-1. The inverse is computed, so that the two agree to the last bit.
Eigen::Matrix3d xyz_from_rgb() {
    Eigen::Matrix3d m;
    m << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
    return m;
}
const Eigen::Matrix3d& rgb_from_xyz() {
    static const Eigen::Matrix3d inverse = inverse3(xyz_from_rgb());
    return inverse;
}

constexpr Rgb k_luminance{0.2126, 0.7152, 0.0722};

// Weight of each node in the integral of D65 x colour matching function x spectrum, on the
// observer's 1 nm grid. The spectrum is linear between nodes and constant beyond them.
Eigen::MatrixXd xyz_weights(const std::vector<double>& nm) {
    const Eigen::Index count = static_cast<Eigen::Index>(nm.size());
    Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(3, count);
    const Spectrum& d65 = *illuminant("D65");
    const std::vector<double>& grid = cie_y().wavelengths_nm();
    for (std::size_t g = 0; g < grid.size(); ++g) {
        const Eigen::Vector3d cmf(cie_x().values()[g], cie_y().values()[g], cie_z().values()[g]);
        const Eigen::Vector3d share = d65.at(grid[g]) * cmf;
        const auto above = std::upper_bound(nm.begin(), nm.end(), grid[g]);
        if (above == nm.begin()) {
            weights.col(0) += share;
        } else if (above == nm.end()) {
            weights.col(count - 1) += share;
        } else {
            const Eigen::Index i = above - nm.begin();
            const double t = (grid[g] - nm[i - 1]) / (nm[i] - nm[i - 1]);
            weights.col(i - 1) += (1 - t) * share;
            weights.col(i) += t * share;
        }
    }
    return weights;
}

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

// The three smoothest spectra that sum to 1 and integrate to red, green and blue: least squares of
// first differences under linear constraints. Negative values are fixed at 0 while the integrals
// can stay exact. If they cannot (two nodes, or all nodes where the eye sees nothing), the sum
// stays 1 and the integrals are approximated.
std::array<std::vector<double>, 3> smooth_primaries(const Eigen::MatrixXd& rgb_weight,
                                                    const std::vector<double>& nm) {
    const Eigen::MatrixXd shares = interpolation(nm);
    const Eigen::MatrixXd weight = product(rgb_weight, shares);
    const Eigen::Index n = weight.cols();
    // The unknowns are red and blue, less a third each (grey light); green is the rest.
    constexpr double k_third = 1.0 / 3;
    const auto primaries_of = [&](const Eigen::VectorXd& unknown) {
        Eigen::MatrixXd values(n, 3);
        values.col(0) = unknown.head(n);
        values.col(1) = -unknown.head(n) - unknown.tail(n);
        values.col(2) = unknown.tail(n);
        return Eigen::MatrixXd(values.array() + k_third);
    };
    Eigen::MatrixXd differences = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
        differences(i, i) += 1;
        differences(i + 1, i + 1) += 1;
        differences(i, i + 1) -= 1;
        differences(i + 1, i) -= 1;
    }
    // Sum of squares of all three primaries.
    const auto of_all_three = [&](const Eigen::MatrixXd& square) {
        Eigen::MatrixXd normal(2 * n, 2 * n);
        normal << 2 * square, square, square, 2 * square;
        return normal;
    };
    const Eigen::MatrixXd roughness = of_all_three(differences);
    // Grey light of a third each already integrates to a third per colour.
    const auto wanted = [&](int primary) {
        return Eigen::Vector3d(Eigen::Vector3d::Unit(primary).array() - k_third);
    };

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
    if (best.size() == 0) {
        // Only determines what the integrals leave open.
        constexpr double k_smoothness = 1e-6;
        Eigen::VectorXd pull(2 * n);
        pull << weight.transpose() * (wanted(0) - wanted(1)),
            weight.transpose() * (wanted(2) - wanted(1));
        const Eigen::MatrixXd normal =
            k_smoothness * roughness + of_all_three(transpose_times(weight, weight));
        best = primaries_of(shortest_solution(normal, pull));
    }
    std::array<std::vector<double>, 3> primaries;
    for (int p = 0; p < 3; ++p) {
        const Eigen::VectorXd at_nodes = shares * best.col(p);
        primaries[std::size_t(p)].assign(at_nodes.data(), at_nodes.data() + at_nodes.size());
    }
    return primaries;
}

}  // namespace

WavelengthSet::WavelengthSet(std::vector<double> wavelengths_nm)
    : wavelengths_nm_(std::move(wavelengths_nm)) {
    check(!wavelengths_nm_.empty(), "a picture needs a wavelength");
    const Eigen::Index count = static_cast<Eigen::Index>(wavelengths_nm_.size());
    if (count == 1) {
        rgb_weight_ = {{1, 1, 1}};
        return;
    }
    const Eigen::MatrixXd xyz = xyz_weights(wavelengths_nm_);
    Eigen::MatrixXd rgb = rgb_from_xyz() * xyz;
    // Flat 1 is white by definition; the tables' D65 and sRGB's differ in the fourth digit.
    for (int c = 0; c < 3; ++c) rgb.row(c) /= rgb.row(c).sum();
    for (Eigen::Index i = 0; i < count; ++i)
        rgb_weight_.push_back({rgb(0, i), rgb(1, i), rgb(2, i)});
}

WavelengthSet::WavelengthSet(std::vector<double> wavelengths_nm, std::vector<Rgb> shares)
    : wavelengths_nm_(std::move(wavelengths_nm)), rgb_weight_(std::move(shares)), fitted_(true) {
    check(wavelengths_nm_.size() == rgb_weight_.size(), "each wavelength needs its shares");
}

const std::array<std::vector<double>, 3>& WavelengthSet::primaries() const {
    // Cached: a plan tries the same few sets repeatedly. Lazy: most scenes have no coloured light.
    static std::mutex mutex;
    static std::map<std::vector<Rgb>, std::array<std::vector<double>, 3>> found;
    const std::lock_guard<std::mutex> lock(mutex);
    const auto [at, is_new] = found.try_emplace(rgb_weight_);
    if (!is_new) return at->second;
    if (size() == 1) {
        for (int p = 0; p < 3; ++p) at->second[p] = {k_luminance[p]};
        return at->second;
    }
    Eigen::MatrixXd rgb(3, size());
    for (Eigen::Index i = 0; i < rgb.cols(); ++i) {
        for (int c = 0; c < 3; ++c) rgb(c, i) = rgb_weight_[static_cast<std::size_t>(i)][c];
    }
    at->second = smooth_primaries(rgb, wavelengths_nm_);
    return at->second;
}

Rgb WavelengthSet::rgb_of(const double* radiance) const {
    // Sum differences from the first node, so that a flat spectrum is grey to the bit.
    const double base = radiance[0];
    Rgb rgb{base, base, base};
    for (std::size_t i = 1; i < rgb_weight_.size(); ++i) {
        for (int c = 0; c < 3; ++c) rgb[c] += rgb_weight_[i][c] * (radiance[i] - base);
    }
    return rgb;
}

std::vector<double> WavelengthSet::spectrum_of(const Rgb& rgb) const {
    std::vector<double> radiance(wavelengths_nm_.size(), rgb[1]);
    // Start from green: a grey light is flat to the bit, because the primaries sum to 1.
    if (rgb[0] == rgb[1] && rgb[2] == rgb[1]) return radiance;
    const std::array<std::vector<double>, 3>& of = primaries();
    for (std::size_t i = 0; i < radiance.size(); ++i)
        radiance[i] = rgb[1] + (rgb[0] - rgb[1]) * of[0][i] + (rgb[2] - rgb[1]) * of[2][i];
    return radiance;
}

std::vector<double> WavelengthSet::illuminant_relative(const char* name) const {
    const Spectrum* lamp = illuminant(name);
    check(lamp != nullptr, "unknown illuminant");
    if (fitted_) {
        const WavelengthSet whole(lamp->wavelengths_nm());
        return spectrum_of(whole.rgb_of(whole.illuminant_relative(name).data()));
    }
    const Spectrum& d65 = *illuminant("D65");
    double y_lamp = 0, y_white = 0;
    for (double nm : cie_y().wavelengths_nm()) {
        y_lamp += lamp->at(nm) * cie_y().at(nm);
        y_white += d65.at(nm) * cie_y().at(nm);
    }
    std::vector<double> radiance;
    for (double nm : wavelengths_nm_)
        radiance.push_back(lamp->at(nm) / d65.at(nm) * (y_white / y_lamp));
    return radiance;
}

double luminance(const Rgb& rgb) {
    return k_luminance[0] * rgb[0] + k_luminance[1] * rgb[1] + k_luminance[2] * rgb[2];
}

double srgb_encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double srgb_decoded(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

std::array<double, 3> xyz_of_rgb(const Rgb& rgb) {
    const Eigen::Vector3d xyz = xyz_from_rgb() * Eigen::Vector3d(rgb[0], rgb[1], rgb[2]);
    return {xyz[0], xyz[1], xyz[2]};
}

Rgb rgb_of_xyz(const std::array<double, 3>& xyz) {
    const Eigen::Vector3d rgb = rgb_from_xyz() * Eigen::Vector3d(xyz[0], xyz[1], xyz[2]);
    return {rgb[0], rgb[1], rgb[2]};
}

}  // namespace culet
