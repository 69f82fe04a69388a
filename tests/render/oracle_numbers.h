#pragma once
// The arithmetic of face_oracle.cpp: 100 digits, vectors, and the roots of polynomials.

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_complex.hpp>
#include <vector>

#include "render/optics/crystal.h"

namespace culet::oracle {

namespace mp = boost::multiprecision;
using Real = mp::number<mp::cpp_bin_float<100>, mp::et_off>;
using Number = mp::number<mp::complex_adaptor<mp::cpp_bin_float<100>>, mp::et_off>;

inline const Real k_same("1e-40");  ///< waves closer than this are one

template <class T>
using Triple = std::array<T, 3>;
using RealVec = Triple<Real>;
using Vec = Triple<Number>;
using Matrix = Triple<Vec>;

template <class T>
Triple<T> operator+(const Triple<T>& a, const Triple<T>& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T>
Triple<T> operator-(const Triple<T>& a, const Triple<T>& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T>
Triple<T> operator*(const T& f, const Triple<T>& a) {
    return {f * a[0], f * a[1], f * a[2]};
}
template <class T>
T dot(const Triple<T>& a, const Triple<T>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class T>
Triple<T> cross(const Triple<T>& a, const Triple<T>& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Real length(const RealVec& a) {
    return sqrt(dot(a, a));
}
inline RealVec unit(const RealVec& a) {
    return (1 / length(a)) * a;
}
inline Vec conjugate(const Vec& a) {
    return {conj(a[0]), conj(a[1]), conj(a[2])};
}
inline Real norm_of(const Number& a) {
    return a.real() * a.real() + a.imag() * a.imag();
}
inline Real norm_of(const Vec& a) {
    return norm_of(a[0]) + norm_of(a[1]) + norm_of(a[2]);
}
inline RealVec real_part(const Vec& a) {
    return {a[0].real(), a[1].real(), a[2].real()};
}
inline RealVec exact(const Vec3& v) {
    return {Real(v.x), Real(v.y), Real(v.z)};
}
inline Vec complex_of(const RealVec& a) {
    return {Number(a[0]), Number(a[1]), Number(a[2])};
}
inline Complex rounded(const Number& a) {
    return {static_cast<double>(a.real()), static_cast<double>(a.imag())};
}
inline ComplexVec3 rounded(const Vec& a) {
    return {rounded(a[0]), rounded(a[1]), rounded(a[2])};
}
inline Vec3 rounded(const RealVec& a) {
    return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}

inline RealVec turned(const RealVec& v, const RealVec& about) {
    const Real angle = length(about);
    if (angle == 0) return v;
    const RealVec axis = unit(about);
    return cos(angle) * v + sin(angle) * cross(axis, v) + ((1 - cos(angle)) * dot(axis, v)) * axis;
}

using Polynomial = std::vector<Number>;  // by rising power

inline Polynomial operator+(Polynomial a, const Polynomial& b) {
    a.resize(std::max(a.size(), b.size()));
    for (std::size_t i = 0; i < b.size(); ++i) a[i] += b[i];
    return a;
}
inline Polynomial operator-(Polynomial a, const Polynomial& b) {
    a.resize(std::max(a.size(), b.size()));
    for (std::size_t i = 0; i < b.size(); ++i) a[i] -= b[i];
    return a;
}
inline Polynomial operator*(const Polynomial& a, const Polynomial& b) {
    Polynomial product(a.size() + b.size() - 1);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) product[i + j] += a[i] * b[j];
    return product;
}

inline Polynomial determinant(const std::array<std::array<Polynomial, 3>, 3>& m) {
    const auto minor = [&](int j, int k) { return m[1][j] * m[2][k] - m[1][k] * m[2][j]; };
    return m[0][0] * minor(1, 2) - m[0][1] * minor(0, 2) + m[0][2] * minor(0, 1);
}

// All roots of a polynomial of the given degree by the method of Aberth (1973): Newton's step, with
// the other roots divided out. Each step gives a root of a double pair one more bit, and triples
// the digits of any other.
inline std::vector<Number> roots_of(const Polynomial& p, int degree) {
    Real bound = 0;
    for (int i = 0; i < degree; ++i) {
        const Real ratio = sqrt(norm_of(p[i]) / norm_of(p[degree]));
        if (ratio > 0) bound = std::max(bound, Real(pow(ratio, Real(1) / (degree - i))));
    }
    std::vector<Number> roots(degree);
    for (int i = 0; i < degree; ++i) {
        const Real angle = Real(i) * 2 * Real("3.14159265358979") / degree + Real("0.4");
        roots[i] = bound * Number(cos(angle), sin(angle));
    }
    const Real enough = bound * Real("1e-98");
    std::vector<Real> last(degree, bound);
    for (int step = 0; step < 400; ++step) {
        bool settled = true;
        for (int i = 0; i < degree; ++i) {
            Number value = p[degree], slope = 0;
            for (int k = degree - 1; k >= 0; --k) {
                slope = slope * roots[i] + value;
                value = value * roots[i] + p[k];
            }
            if (norm_of(value) == 0) continue;
            Number others = 0;
            for (int j = 0; j < degree; ++j)
                if (j != i && roots[i] != roots[j]) others += Number(1) / (roots[i] - roots[j]);
            const Number denominator = slope - value * others;
            if (norm_of(denominator) == 0) continue;
            const Number move = value / denominator;
            const Real size = sqrt(norm_of(move));
            // Steps this small that no longer shrink are rounding noise.
            if (size < bound * Real("1e-44") && size >= last[i]) continue;
            last[i] = size;
            roots[i] -= move;
            if (size > enough) settled = false;
        }
        if (settled) break;
    }
    return roots;
}

}  // namespace culet::oracle
