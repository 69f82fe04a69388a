#include "stone/material/spectrum.h"

#include <algorithm>
#include <cstring>
#include <sstream>
#include <string>

#include "stone/text/errors.h"

namespace culet {

namespace embedded {
extern const char* const cie1931_csv;
extern const char* const illuminants_csv;
}  // namespace embedded

Spectrum::Spectrum(std::vector<double> wavelengths_nm, std::vector<double> values)
    : wavelengths_nm_(std::move(wavelengths_nm)), values_(std::move(values)) {
    check(!values_.empty() && wavelengths_nm_.size() == values_.size(),
          "a spectrum needs one value a wavelength");
    check(std::adjacent_find(wavelengths_nm_.begin(), wavelengths_nm_.end(),
                             [](double a, double b) { return !(a < b); }) == wavelengths_nm_.end(),
          "a spectrum's wavelengths must increase");
}

double Spectrum::at(double wavelength_nm) const {
    if (wavelengths_nm_.empty() || wavelength_nm <= wavelengths_nm_.front()) return values_.front();
    if (wavelength_nm >= wavelengths_nm_.back()) return values_.back();
    const auto above =
        std::upper_bound(wavelengths_nm_.begin(), wavelengths_nm_.end(), wavelength_nm);
    const std::size_t i = static_cast<std::size_t>(above - wavelengths_nm_.begin());
    const double t =
        (wavelength_nm - wavelengths_nm_[i - 1]) / (wavelengths_nm_[i] - wavelengths_nm_[i - 1]);
    return (1 - t) * values_[i - 1] + t * values_[i];
}

bool Spectrum::is_constant() const {
    return min() == max();
}
double Spectrum::max() const {
    return *std::max_element(values_.begin(), values_.end());
}
double Spectrum::min() const {
    return *std::min_element(values_.begin(), values_.end());
}

Spectrum Spectrum::scaled(double factor) const {
    Spectrum result = *this;
    for (double& value : result.values_) value *= factor;
    return result;
}

namespace {

// `#` comments, one header line, then numbers.
std::vector<std::vector<double>> columns_of(const char* csv) {
    std::istringstream lines{std::string(csv)};
    std::vector<std::vector<double>> columns;
    bool header_seen = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] == '#') continue;
        if (!header_seen) {
            header_seen = true;
            continue;
        }
        std::istringstream cells(line);
        std::size_t column = 0;
        for (std::string cell; std::getline(cells, cell, ','); ++column) {
            if (columns.size() <= column) columns.emplace_back();
            columns[column].push_back(std::stod(cell));
        }
    }
    return columns;
}

const std::vector<Spectrum>& observer() {
    static const std::vector<Spectrum> xyz = [] {
        const auto columns = columns_of(embedded::cie1931_csv);
        std::vector<Spectrum> result;
        for (std::size_t c = 1; c <= 3; ++c) result.emplace_back(columns.at(0), columns.at(c));
        return result;
    }();
    return xyz;
}

const std::vector<Spectrum>& illuminants() {
    static const std::vector<Spectrum> both = [] {
        const auto columns = columns_of(embedded::illuminants_csv);
        return std::vector<Spectrum>{{columns.at(0), columns.at(1)},
                                     {columns.at(0), columns.at(2)}};
    }();
    return both;
}

}  // namespace

const Spectrum& cie_x() {
    return observer()[0];
}
const Spectrum& cie_y() {
    return observer()[1];
}
const Spectrum& cie_z() {
    return observer()[2];
}

const Spectrum* illuminant(const char* name) {
    if (std::strcmp(name, "A") == 0) return &illuminants()[0];
    if (std::strcmp(name, "D65") == 0) return &illuminants()[1];
    return nullptr;
}

}  // namespace culet
