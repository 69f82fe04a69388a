#include "render/colour/colour.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "render/colour/smooth_primaries.h"
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
