#include "render/colour.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "stone/errors.h"

namespace culet {

namespace {

// IEC 61966-2-1: XYZ of linear sRGB; the inverse is computed, so that the two agree to the last
// bit.
Eigen::Matrix3d xyz_from_rgb() {
    Eigen::Matrix3d m;
    m << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
    return m;
}
const Eigen::Matrix3d& rgb_from_xyz() {
    static const Eigen::Matrix3d inverse = xyz_from_rgb().inverse();
    return inverse;
}

constexpr Rgb k_luminance{0.2126, 0.7152, 0.0722};

// Weight of each node in the integral over the observer's range of D65 x colour matching function x
// the spectrum that is linear between nodes and held beyond them: sums on the observer's own 1 nm
// grid.
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

// The smoothest three spectra that add up to 1 and integrate to red, green and blue: least squares
// of first differences under linear constraints, with values held at 0 where they would fall below.
std::array<std::vector<double>, 3> smooth_primaries(const Eigen::MatrixXd& weight) {
    const Eigen::Index n = weight.cols(), all = 3 * n;
    std::vector<bool> held(static_cast<std::size_t>(all), false);
    Eigen::VectorXd values = Eigen::VectorXd::Constant(all, 1.0 / 3);
    for (int round = 0; round < 3 * n; ++round) {
        Eigen::MatrixXd roughness = Eigen::MatrixXd::Zero(all, all);
        for (int p = 0; p < 3; ++p) {
            for (Eigen::Index i = 0; i + 1 < n; ++i) {
                const Eigen::Index a = p * n + i, b = a + 1;
                roughness(a, a) += 1;
                roughness(b, b) += 1;
                roughness(a, b) -= 1;
                roughness(b, a) -= 1;
            }
        }
        Eigen::Index holds = std::count(held.begin(), held.end(), true);
        // Rows: sum of the three at each node is 1; red's and green's integrals (blue's follows);
        // holds.
        const Eigen::Index rows = n + 6 + holds;
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(rows, all);
        Eigen::VectorXd b = Eigen::VectorXd::Zero(rows);
        for (Eigen::Index i = 0; i < n; ++i) {
            for (int p = 0; p < 3; ++p) A(i, p * n + i) = 1;
            b(i) = 1;
        }
        Eigen::Index row = n;
        for (int p = 0; p < 2; ++p) {
            for (int c = 0; c < 3; ++c, ++row) {
                A.row(row).segment(p * n, n) = weight.row(c);
                b(row) = p == c ? 1 : 0;
            }
        }
        for (Eigen::Index i = 0; i < all; ++i) {
            if (held[static_cast<std::size_t>(i)]) A(row++, i) = 1;
        }
        Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(all + rows, all + rows);
        kkt.topLeftCorner(all, all) = roughness;
        kkt.topRightCorner(all, rows) = A.transpose();
        kkt.bottomLeftCorner(rows, all) = A;
        Eigen::VectorXd right = Eigen::VectorXd::Zero(all + rows);
        right.tail(rows) = b;
        const Eigen::VectorXd solved = kkt.completeOrthogonalDecomposition().solve(right).head(all);
        // Too many holds leave no exact solution: then the last exact one stands.
        if ((A * solved - b).cwiseAbs().maxCoeff() > 1e-11) break;
        values = solved;
        Eigen::Index worst = -1;
        for (Eigen::Index i = 0; i < all; ++i) {
            if (!held[static_cast<std::size_t>(i)] && values(i) < -1e-12 &&
                (worst < 0 || values(i) < values(worst)))
                worst = i;
        }
        if (worst < 0) break;
        held[static_cast<std::size_t>(worst)] = true;
    }
    std::array<std::vector<double>, 3> primaries;
    for (int p = 0; p < 3; ++p)
        primaries[p].assign(values.data() + p * n, values.data() + (p + 1) * n);
    return primaries;
}

}  // namespace

WavelengthSet::WavelengthSet(std::vector<double> wavelengths_nm)
    : wavelengths_nm_(std::move(wavelengths_nm)) {
    check(!wavelengths_nm_.empty(), "a picture needs a wavelength");
    const Eigen::Index count = static_cast<Eigen::Index>(wavelengths_nm_.size());
    if (count == 1) {
        rgb_weight_ = {{1, 1, 1}};
        for (int p = 0; p < 3; ++p) primaries_[p] = {k_luminance[p]};
        return;
    }
    const Eigen::MatrixXd xyz = xyz_weights(wavelengths_nm_);
    Eigen::MatrixXd rgb = rgb_from_xyz() * xyz;
    // Flat 1 is white by definition: the tables' D65 and sRGB's differ in the fourth digit.
    for (int c = 0; c < 3; ++c) rgb.row(c) /= rgb.row(c).sum();
    for (Eigen::Index i = 0; i < count; ++i)
        rgb_weight_.push_back({rgb(0, i), rgb(1, i), rgb(2, i)});
    primaries_ = smooth_primaries(rgb);
}

Rgb WavelengthSet::rgb_of(const double* radiance) const {
    // Summed as white plus differences from the first node, so that a flat spectrum is grey to the
    // bit.
    const double base = radiance[0];
    Rgb rgb{base, base, base};
    for (std::size_t i = 1; i < rgb_weight_.size(); ++i) {
        for (int c = 0; c < 3; ++c) rgb[c] += rgb_weight_[i][c] * (radiance[i] - base);
    }
    return rgb;
}

std::vector<double> WavelengthSet::spectrum_of(const Rgb& rgb) const {
    std::vector<double> radiance(wavelengths_nm_.size());
    for (std::size_t i = 0; i < radiance.size(); ++i) {
        // Green plus differences: a grey light is flat to the bit, because the primaries add up
        // to 1.
        radiance[i] =
            rgb[1] + (rgb[0] - rgb[1]) * primaries_[0][i] + (rgb[2] - rgb[1]) * primaries_[2][i];
    }
    return radiance;
}

std::vector<double> WavelengthSet::illuminant_relative(const char* name) const {
    const Spectrum* lamp = illuminant(name);
    check(lamp != nullptr, "unknown illuminant");
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
