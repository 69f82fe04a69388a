#pragma once
// Algebra of complex field vectors.

#include "render/optics/crystal.h"

namespace culet {

inline ComplexVec3 complex_of(const Vec3& v) {
    return {v.x, v.y, v.z};
}
inline ComplexVec3 operator+(const ComplexVec3& a, const ComplexVec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline ComplexVec3 operator*(const Complex& f, const ComplexVec3& a) {
    return {f * a.x, f * a.y, f * a.z};
}
inline Vec3 real_part(const ComplexVec3& v) {
    return {v.x.real(), v.y.real(), v.z.real()};
}
/// Bilinear, without conjugation.
inline Complex dot(const Vec3& a, const ComplexVec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline ComplexVec3 cross(const ComplexVec3& a, const ComplexVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double squared_length(const ComplexVec3& a) {
    return std::norm(a.x) + std::norm(a.y) + std::norm(a.z);
}

}  // namespace culet
