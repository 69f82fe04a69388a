#pragma once
// A quantity as a function of wavelength: linear between samples, constant beyond the first and
// last.

#include <vector>

namespace culet {

class Spectrum {
public:
    Spectrum() = default;
    explicit Spectrum(double constant) : values_{constant} {}
    /// `wavelengths_nm` must increase strictly and match `values` in length; else throws
    /// InternalError.
    Spectrum(std::vector<double> wavelengths_nm, std::vector<double> values);

    double at(double wavelength_nm) const;
    bool is_constant() const;
    double max() const;
    double min() const;
    Spectrum scaled(double factor) const;

    const std::vector<double>& wavelengths_nm() const { return wavelengths_nm_; }
    const std::vector<double>& values() const { return values_; }

private:
    std::vector<double> wavelengths_nm_;  ///< empty for a constant
    std::vector<double> values_{0.0};
};

/// The sodium line, at which handbooks and the trade state indices.
inline constexpr double k_d_line_nm = 589.3;

/// CIE 1931 2-degree observer, 360-830 nm in steps of 1 nm (CIE 15 tables).
const Spectrum& cie_x();
const Spectrum& cie_y();
const Spectrum& cie_z();

/// CIE standard illuminant by name, `D65` or `A` (CIE 15:2004, 5 nm), 100 at 560 nm; nullptr for
/// any other name.
const Spectrum* illuminant(const char* name);

}  // namespace culet
