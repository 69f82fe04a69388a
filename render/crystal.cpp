#include "render/crystal.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "stone/perpendicular.h"

namespace culet {

namespace {

using Complex = std::complex<double>;

ComplexVec3 complex_of(const Vec3& v) {
    return {v.x, v.y, v.z};
}
ComplexVec3 operator+(const ComplexVec3& a, const ComplexVec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
ComplexVec3 operator*(const Complex& f, const ComplexVec3& a) {
    return {f * a.x, f * a.y, f * a.z};
}
Complex dot(const Vec3& a, const ComplexVec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
ComplexVec3 cross(const ComplexVec3& a, const ComplexVec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double squared_length(const ComplexVec3& a) {
    return std::norm(a.x) + std::norm(a.y) + std::norm(a.z);
}

// Re(E x H*), twice the mean Poynting vector.
Vec3 energy_flow(const ComplexVec3& E, const ComplexVec3& H) {
    const ComplexVec3 conjugate{std::conj(H.x), std::conj(H.y), std::conj(H.z)};
    const ComplexVec3 s = cross(E, conjugate);
    return {s.x.real(), s.y.real(), s.z.real()};
}

// N parallel to the axis: below this sine of their angle a x N is rounding noise.
constexpr double k_parallel = 1e-9;

void finish(CrystalMode& mode, const ComplexVec3& N, bool propagates) {
    const double length = std::sqrt(squared_length(mode.E));
    mode.E = Complex(1 / length) * mode.E;
    mode.H = cross(N, mode.E);
    mode.propagates = propagates;
    if (!propagates) return;
    mode.wave = {N.x.real(), N.y.real(), N.z.real()};
    const Vec3 flow = energy_flow(mode.E, mode.H);
    mode.flux = glm::length(flow);
    mode.ray = flow / mode.flux;
}

// Any unit vector normal to the axis and fixed by the face, for waves along the axis.
Vec3 beside_axis(const Vec3& axis, const Vec3& n) {
    const Vec3 from_face = glm::cross(axis, n);
    if (glm::dot(from_face, from_face) > 1e-6) return glm::normalize(from_face);
    return perpendicular_to(axis);
}

}  // namespace

std::array<CrystalMode, 2> modes_towards(const UniaxialCrystal& crystal, const Vec3& K,
                                         const Vec3& n) {
    const Vec3& a = crystal.axis;
    const double eo = crystal.n_o * crystal.n_o, ee = crystal.n_e * crystal.n_e;
    const double d = (crystal.n_e - crystal.n_o) * (crystal.n_e + crystal.n_o);
    const double k_length = glm::length(K);
    std::array<CrystalMode, 2> modes;
    modes[0].kind = ModeKind::ordinary;
    modes[1].kind = ModeKind::extraordinary;

    // Ordinary: q^2 = (n_o - K)(n_o + K).
    const double qo_squared = (crystal.n_o - k_length) * (crystal.n_o + k_length);
    const Complex qo =
        qo_squared >= 0 ? Complex(std::sqrt(qo_squared)) : Complex(0, std::sqrt(-qo_squared));
    const ComplexVec3 No = complex_of(K) + qo * complex_of(n);
    modes[0].E = cross(complex_of(a), No);
    if (squared_length(modes[0].E) < k_parallel * k_parallel * squared_length(No)) {
        modes[0].E = complex_of(beside_axis(a, n));
    }
    finish(modes[0], No, qo_squared > 0);

    // Extraordinary: A q^2 + 2 B q + C = 0; the sign of the root, not of q, is the energy's
    // direction.
    const double an = glm::dot(a, n), ak = glm::dot(a, K);
    const double A = eo + d * an * an, B = d * an * ak;
    const double discriminant =
        A * eo * (crystal.n_e - k_length) * (crystal.n_e + k_length) - eo * d * ak * ak;
    Complex qe;
    if (discriminant >= 0) {
        const double root = std::sqrt(discriminant);
        // Where -B and the root cancel, the other root and Vieta's product give the digits back.
        const double C = eo * (k_length * k_length - ee) + d * ak * ak;
        qe = B > 0 ? Complex(C / (-B - root)) : Complex((-B + root) / A);
    } else {
        qe = Complex(-B / A, std::sqrt(-discriminant) / A);
    }
    const ComplexVec3 Ne = complex_of(K) + qe * complex_of(n);
    const ComplexVec3 D = cross(Ne, cross(complex_of(a), Ne));
    const Complex along = (1 / ee - 1 / eo) * dot(a, D);
    modes[1].E = Complex(1 / eo) * D + along * complex_of(a);
    const ComplexVec3 aNe = cross(complex_of(a), Ne);
    if (squared_length(aNe) < k_parallel * k_parallel * squared_length(Ne)) {
        modes[1].E = complex_of(glm::cross(a, beside_axis(a, n)));
    }
    finish(modes[1], Ne, discriminant > 0);
    return modes;
}

namespace {

// The tangential parts of a field at a face, t1 along s and t2 = n x t1.
struct Tangential {
    Complex E1, E2, H1, H2;
};

struct FaceFrame {
    Vec3 t1, t2;
    FaceFrame(const Vec3& K, const Vec3& n) {
        const double length = glm::length(K);
        // Normal incidence has no plane of incidence: any tangent serves.
        t2 = length > 1e-14 ? K / length : Vec3(0);
        if (length <= 1e-14) {
            t2 = perpendicular_to(n);
        }
        t1 = glm::cross(t2, n);
    }
    Tangential of(const CrystalMode& mode) const {
        return {dot(t1, mode.E), dot(t2, mode.E), dot(t1, mode.H), dot(t2, mode.H)};
    }
};

// x of the 2x2 system with columns a, b and right side c, by Cramer on rows scaled to their largest
// entry.
std::array<Complex, 2> solve(std::array<Complex, 2> a, std::array<Complex, 2> b,
                             std::array<Complex, 2> c) {
    for (int row = 0; row < 2; ++row) {
        const double scale = std::max(std::abs(a[row]), std::abs(b[row]));
        if (scale > 0) {
            a[row] /= scale;
            b[row] /= scale;
            c[row] /= scale;
        }
    }
    const Complex determinant = a[0] * b[1] - a[1] * b[0];
    return {(c[0] * b[1] - c[1] * b[0]) / determinant, (a[0] * c[1] - a[1] * c[0]) / determinant};
}

}  // namespace

CrystalEntry enter_crystal(const UniaxialCrystal& crystal, double n_outside, const Vec3& K,
                           const Vec3& n_into) {
    CrystalEntry entry;
    entry.modes = modes_towards(crystal, K, n_into);
    const FaceFrame frame(K, n_into);
    const double e = n_outside * n_outside;
    const double k_length = glm::length(K);
    const double q = std::sqrt(std::max(0.0, (n_outside - k_length) * (n_outside + k_length)));
    if (q == 0) {  // grazing light does not enter
        entry.reflected = {1, 1};
        return entry;
    }
    const std::array<Tangential, 2> m{frame.of(entry.modes[0]), frame.of(entry.modes[1])};
    for (int incident = 0; incident < 2; ++incident) {
        const double E1 = incident == 0 ? 1 : 0, H1 = incident == 0 ? 0 : 1;
        const double flux = incident == 0 ? q : q / e;
        const std::array<Complex, 2> t = solve({m[0].H2 + q * m[0].E1, q * m[0].H1 - e * m[0].E2},
                                               {m[1].H2 + q * m[1].E1, q * m[1].H1 - e * m[1].E2},
                                               {Complex(2 * q * E1), Complex(2 * q * H1)});
        double sum = 0;
        for (int j = 0; j < 2; ++j) {
            const CrystalMode& mode = entry.modes[j];
            if (!mode.propagates) continue;
            const double normal_flux = mode.flux * glm::dot(mode.ray, n_into);
            entry.power[incident][j] = std::clamp(std::norm(t[j]) * normal_flux / flux, 0.0, 1.0);
            sum += entry.power[incident][j];
        }
        const Complex E1_reflected = t[0] * m[0].E1 + t[1] * m[1].E1 - E1;
        const Complex H1_reflected = t[0] * m[0].H1 + t[1] * m[1].H1 - H1;
        const double reflected = q * (std::norm(E1_reflected) + std::norm(H1_reflected) / e) / flux;
        sum += reflected;
        entry.imbalance = std::max(entry.imbalance, std::abs(sum - 1));
        if (!(sum > 0) || !std::isfinite(sum)) {  // grazing to the last digit: nothing enters
            entry.reflected[incident] = 1;
            entry.power[incident] = {0, 0};
            continue;
        }
        entry.reflected[incident] = reflected / sum;
        for (double& power : entry.power[incident]) power /= sum;
    }
    return entry;
}

CrystalHit hit_face(const UniaxialCrystal& crystal, double n_outside, const CrystalMode& incident,
                    const Vec3& n_out) {
    CrystalHit hit;
    const Vec3 K = incident.wave - glm::dot(incident.wave, n_out) * n_out;
    hit.modes = modes_towards(crystal, K, -n_out);
    const FaceFrame frame(K, n_out);
    const double e = n_outside * n_outside;
    const double k_length = glm::length(K);
    const double q_squared = (n_outside - k_length) * (n_outside + k_length);
    const Complex q =
        q_squared >= 0 ? Complex(std::sqrt(q_squared)) : Complex(0, std::sqrt(-q_squared));
    const Tangential in = frame.of(incident);
    const std::array<Tangential, 2> m{frame.of(hit.modes[0]), frame.of(hit.modes[1])};
    // Continuity with the one wave outside, whose admittance is H2 = q E1 and q H1 = -e E2.
    const std::array<Complex, 2> r = solve({m[0].H2 - q * m[0].E1, q * m[0].H1 + e * m[0].E2},
                                           {m[1].H2 - q * m[1].E1, q * m[1].H1 + e * m[1].E2},
                                           {-(in.H2 - q * in.E1), -(q * in.H1 + e * in.E2)});
    const double incident_flux = incident.flux * glm::dot(incident.ray, n_out);
    double sum = 0;
    for (int j = 0; j < 2; ++j) {
        const CrystalMode& mode = hit.modes[j];
        if (!mode.propagates) continue;
        hit.power[j] = std::clamp(
            std::norm(r[j]) * mode.flux * glm::dot(mode.ray, -n_out) / incident_flux, 0.0, 1.0);
        sum += hit.power[j];
    }
    if (q_squared > 0) {
        const Complex E1 = in.E1 + r[0] * m[0].E1 + r[1] * m[1].E1;
        const Complex H1 = in.H1 + r[0] * m[0].H1 + r[1] * m[1].H1;
        hit.transmitted =
            std::clamp(q.real() * (std::norm(E1) + std::norm(H1) / e) / incident_flux, 0.0, 1.0);
        sum += hit.transmitted;
        hit.exit_direction = glm::normalize(K + q.real() * n_out);
    }
    // A ray in the face itself carries nothing across it: no balance to speak of.
    hit.imbalance = std::isfinite(sum) ? std::abs(sum - 1) : 0;
    if (sum > 0 && std::isfinite(sum)) {
        for (double& power : hit.power) power /= sum;
        hit.transmitted /= sum;
    } else {
        // A ray in the face itself: nothing crosses, it goes on as it is.
        hit.power = {incident.kind == ModeKind::ordinary ? 1.0 : 0.0,
                     incident.kind == ModeKind::ordinary ? 0.0 : 1.0};
        hit.transmitted = 0;
    }
    return hit;
}

double absorption_along(const UniaxialCrystal& crystal, const CrystalMode& mode, double k_o,
                        double k_e) {
    const double along = std::norm(dot(crystal.axis, mode.E));
    const double across = std::max(0.0, squared_length(mode.E) - along);
    return (crystal.n_o * k_o * across + crystal.n_e * k_e * along) / mode.flux;
}

}  // namespace culet
