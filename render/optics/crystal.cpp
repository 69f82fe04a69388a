#include "render/optics/crystal.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/optics/complex_vector.h"
#include "render/optics/wave_normals.h"
#include "stone/solid/perpendicular.h"

namespace culet {

Crystal::Crystal(const std::array<Vec3, 3>& axes, const std::array<double, 3>& n)
    : axes_(axes), n_(n) {
    // The axis of a uniaxial crystal is the one whose index differs.
    const int odd = n[1] == n[2] ? 0 : n[0] == n[2] ? 1 : n[0] == n[1] ? 2 : -1;
    if (odd >= 0) {
        axis_ = axes[odd];
        n_e_ = n[odd];
        n_o_ = n[(odd + 1) % 3];
        return;
    }
    biaxial_ = true;
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int a, int b) { return n[a] < n[b]; });
    for (int i = 0; i < 3; ++i) {
        rising_.axes[i] = axes[order[i]];
        rising_.n[i] = n[order[i]];
    }
    const auto& [n1, n2, n3] = rising_.n;
    rising_.e1 = n1 * n1;
    rising_.e2 = n2 * n2;
    rising_.e3 = n3 * n3;
    // Differences of squares, without cancellation.
    rising_.d1 = (n1 - n2) * (n1 + n2);
    rising_.d3 = (n3 - n2) * (n3 + n2);
}

Crystal uniaxial_crystal(const Vec3& axis, double n_o, double n_e) {
    const Vec3 beside = perpendicular_to(axis);
    return Crystal({axis, beside, glm::cross(axis, beside)}, {n_e, n_o, n_o});
}

namespace {

// Sine of the angle between N and the axis below which a x N is only rounding error.
constexpr double k_parallel = 1e-15;
// Sine below which a x N has lost a digit, so that the waves' fields are inconsistent.
constexpr double k_beside = 0.1;

// True if a x N is noise: N runs along the axis a.
bool along(const Vec3& aN, const Vec3& N) {
    return glm::dot(aN, aN) < k_parallel * k_parallel * glm::dot(N, N);
}
bool along(const ComplexVec3& aN, const ComplexVec3& N) {
    return squared_length(aN) < k_parallel * k_parallel * squared_length(N);
}

Complex root_of(double squared) {
    return squared >= 0 ? Complex(std::sqrt(squared)) : Complex(0, std::sqrt(-squared));
}

// A unit vector normal to the axis, determined by the face.
Vec3 beside_axis(const Vec3& axis, const Vec3& n) {
    const Vec3 from_face = glm::cross(axis, n);
    if (glm::dot(from_face, from_face) > 1e-6) return glm::normalize(from_face);
    return perpendicular_to(axis);
}

Vec3 across(const Vec3& a, const Vec3& N, const Vec3& n) {
    Vec3 aN = glm::cross(a, N);
    if (along(aN, N)) aN = beside_axis(a, n);
    // Remove the rounding error along N, which grows relative to aN as N approaches the axis.
    return aN - glm::dot(aN, N) / glm::dot(N, N) * N;
}

std::array<CrystalMode, 2> uniaxial_modes(const Crystal& crystal, const Vec3& K, const Vec3& n) {
    const Vec3& a = crystal.axis();
    const double n_o = crystal.n_o(), n_e = crystal.n_e();
    const double eo = n_o * n_o, ee = n_e * n_e;
    const double d = (n_e - n_o) * (n_e + n_o);
    const double k_length = glm::length(K);
    std::array<CrystalMode, 2> modes;
    modes[0].kind = ModeKind::ordinary;
    modes[1].kind = ModeKind::extraordinary;

    // Ordinary: q^2 = (n_o - K)(n_o + K), E = a x N.
    const double qo_squared = (n_o - k_length) * (n_o + k_length);
    if (qo_squared > 0) {
        const Vec3 N = K + std::sqrt(qo_squared) * n;
        complete_travelling(modes[0], across(a, N, n), N);
    } else {
        const ComplexVec3 N = complex_of(K) + Complex(0, std::sqrt(-qo_squared)) * complex_of(n);
        const ComplexVec3 aN = cross(complex_of(a), N);
        complete_evanescent(modes[0], along(aN, N) ? complex_of(beside_axis(a, n)) : aN, N);
    }

    // Extraordinary: A q^2 + 2 B q + C = 0, E = eps^-1 (N x (a x N)). The sign of the root, not of
    // q, gives the direction of the energy.
    const double an = glm::dot(a, n), ak = glm::dot(a, K);
    const double A = eo + d * an * an, B = d * an * ak;
    const double discriminant = A * eo * (n_e - k_length) * (n_e + k_length) - eo * d * ak * ak;
    const double along_a = 1 / ee - 1 / eo;
    if (discriminant > 0) {
        const double root = std::sqrt(discriminant);
        // If -B and the root cancel, use the other root and Vieta's product.
        const double C = eo * (k_length - n_e) * (k_length + n_e) + d * ak * ak;
        const Vec3 N = K + (B > 0 ? C / (-B - root) : (-B + root) / A) * n;
        const Vec3 D = glm::cross(N, across(a, N, n));
        complete_travelling(modes[1], D / eo + along_a * glm::dot(a, D) * a, N);
        const Vec3 aN = glm::cross(a, N);
        if (modes[0].propagates && glm::dot(aN, aN) < k_beside * k_beside * glm::dot(N, N)) {
            const Vec3 H = real_part(modes[1].H);
            share_no_flux(modes[0], modes[1], H / eo + along_a * glm::dot(a, H) * a, n);
        }
    } else {
        const Complex q(-B / A, std::sqrt(-discriminant) / A);
        const ComplexVec3 N = complex_of(K) + q * complex_of(n);
        const ComplexVec3 aN = cross(complex_of(a), N), D = cross(N, aN);
        complete_evanescent(modes[1],
                            along(aN, N)
                                ? complex_of(glm::cross(a, beside_axis(a, n)))
                                : Complex(1 / eo) * D + along_a * dot(a, D) * complex_of(a),
                            N);
    }
    return modes;
}

}  // namespace

std::array<CrystalMode, 2> modes_towards(const Crystal& crystal, const Vec3& K, const Vec3& n) {
    return crystal.biaxial() ? biaxial_modes(crystal.rising(), K, n)
                             : uniaxial_modes(crystal, K, n);
}

namespace {

// Tangential parts of a field at a face, t1 along s and t2 = n x t1.
struct Tangential {
    Complex E1, E2, H1, H2;
};

struct FaceFrame {
    Vec3 t1, t2;
    FaceFrame(const Vec3& K, const Vec3& n) {
        // Normal incidence has no plane of incidence: any tangent serves. A short K may have a part
        // along n that is not small beside it.
        const bool oblique = glm::length(K) > 1e-14;
        t1 = glm::normalize(glm::cross(oblique ? K : perpendicular_to(n), n));
        t2 = glm::cross(n, t1);
    }
    Tangential of(const CrystalMode& mode) const {
        return {dot(t1, mode.E), dot(t2, mode.E), dot(t1, mode.H), dot(t2, mode.H)};
    }
};

// Solves the 2x2 system with columns a, b and right side c by Cramer's rule, with rows scaled to
// their largest entry.
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

// Normalises two pairs of amplitudes to one column of a unitary matrix. Returns |sum of powers - 1|
// before, or 2 if the sum is 0 or not finite.
double balance(std::array<Complex, 2>& a, std::array<Complex, 2>& b) {
    const double sum = std::norm(a[0]) + std::norm(a[1]) + std::norm(b[0]) + std::norm(b[1]);
    if (!(sum > 0) || !std::isfinite(sum)) return 2;
    const double scale = 1 / std::sqrt(sum);
    for (int j = 0; j < 2; ++j) {
        a[j] *= scale;
        b[j] *= scale;
    }
    return std::abs(sum - 1);
}

// Root of the normal flux of a wave of unit amplitude; 0 if it carries none.
double root_flux(const CrystalMode& mode, const Vec3& n) {
    if (!mode.propagates) return 0;
    return std::sqrt(std::max(0.0, mode.flux * glm::dot(mode.ray, n)));
}

}  // namespace

CrystalEntry enter_crystal(const Crystal& crystal, double n_outside, const Vec3& K,
                           const Vec3& n_into) {
    CrystalEntry entry;
    entry.modes = modes_towards(crystal, K, n_into);
    const FaceFrame frame(K, n_into);
    entry.s = frame.t1;
    const double e = n_outside * n_outside;
    const double k_length = glm::length(K);
    const double q = std::sqrt(std::max(0.0, (n_outside - k_length) * (n_outside + k_length)));
    // Exactly grazing incidence: a mirror with r_s = r_p = -1.
    const auto shut_out = [&entry](int incident) {
        entry.into[incident] = {};
        entry.power[incident] = {};
        entry.back[incident] = {};
        entry.back[incident][incident] = -1;
        entry.reflected[incident] = 1;
    };
    if (q == 0) {
        shut_out(0);
        shut_out(1);
        return entry;
    }
    const std::array<Tangential, 2> m{frame.of(entry.modes[0]), frame.of(entry.modes[1])};
    const double root_q = std::sqrt(q);
    for (int incident = 0; incident < 2; ++incident) {
        // Unit normal flux: E along s is 1/sqrt(q); H of p along s is -n E, E = 1/sqrt(q).
        const double E1 = incident == 0 ? 1 / root_q : 0,
                     H1 = incident == 0 ? 0 : -n_outside / root_q;
        const std::array<Complex, 2> t = solve({m[0].H2 + q * m[0].E1, q * m[0].H1 - e * m[0].E2},
                                               {m[1].H2 + q * m[1].E1, q * m[1].H1 - e * m[1].E2},
                                               {Complex(2 * q * E1), Complex(2 * q * H1)});
        for (int j = 0; j < 2; ++j)
            entry.into[incident][j] = t[j] * root_flux(entry.modes[j], n_into);
        const Complex E1_back = t[0] * m[0].E1 + t[1] * m[1].E1 - E1;
        const Complex H1_back = t[0] * m[0].H1 + t[1] * m[1].H1 - H1;
        entry.back[incident] = {root_q * E1_back, -root_q / n_outside * H1_back};
        const double imbalance = balance(entry.into[incident], entry.back[incident]);
        if (imbalance == 2) {
            shut_out(incident);
            continue;
        }
        entry.imbalance = std::max(entry.imbalance, imbalance);
        for (int j = 0; j < 2; ++j) entry.power[incident][j] = std::norm(entry.into[incident][j]);
        entry.reflected[incident] =
            std::norm(entry.back[incident][0]) + std::norm(entry.back[incident][1]);
    }
    return entry;
}

CrystalHit hit_face(const Crystal& crystal, double n_outside, const CrystalMode& incident,
                    const Vec3& K, const Vec3& n_out) {
    CrystalHit hit;
    hit.modes = modes_towards(crystal, K, -n_out);
    const FaceFrame frame(K, n_out);
    hit.s = frame.t1;
    const double e = n_outside * n_outside;
    const double k_length = glm::length(K);
    const double q_squared = (n_outside - k_length) * (n_outside + k_length);
    const Complex q = root_of(q_squared);
    const Tangential in = frame.of(incident);
    const std::array<Tangential, 2> m{frame.of(hit.modes[0]), frame.of(hit.modes[1])};
    // Continuity with the wave outside, whose admittance is H2 = q E1 and q H1 = -e E2.
    const std::array<Complex, 2> r = solve({m[0].H2 - q * m[0].E1, q * m[0].H1 + e * m[0].E2},
                                           {m[1].H2 - q * m[1].E1, q * m[1].H1 + e * m[1].E2},
                                           {-(in.H2 - q * in.E1), -(q * in.H1 + e * in.E2)});
    const double incident_flux = root_flux(incident, n_out);
    for (int j = 0; j < 2; ++j)
        hit.amplitude[j] = r[j] * (root_flux(hit.modes[j], -n_out) / incident_flux);
    if (q_squared > 0) {
        const double root_q = std::sqrt(q.real());
        const Complex E1 = in.E1 + r[0] * m[0].E1 + r[1] * m[1].E1;
        const Complex H1 = in.H1 + r[0] * m[0].H1 + r[1] * m[1].H1;
        hit.out = {root_q / incident_flux * E1, -root_q / (n_outside * incident_flux) * H1};
        hit.exit_direction = glm::normalize(K + q.real() * n_out);
    }
    const double imbalance = balance(hit.amplitude, hit.out);
    if (imbalance == 2) {
        // The ray lies in the face and continues unchanged.
        hit.out = {};
        hit.amplitude = {};
        const std::size_t same = hit.modes[0].kind == incident.kind ? 0 : 1;
        hit.amplitude[same] = 1;
        // The last digit of K may make its own reflection evanescent. Then reflect the incident
        // wave.
        if (!hit.modes[same].propagates) {
            CrystalMode on = incident;
            on.ray = glm::normalize(on.ray - 2 * std::max(0.0, glm::dot(on.ray, n_out)) * n_out);
            hit.modes[same] = on;
        }
    } else {
        hit.imbalance = imbalance;
    }
    for (int j = 0; j < 2; ++j) hit.power[j] = std::norm(hit.amplitude[j]);
    hit.transmitted = std::norm(hit.out[0]) + std::norm(hit.out[1]);
    return hit;
}

CrystalHit hit_face(const Crystal& crystal, double n_outside, const CrystalMode& incident,
                    const Vec3& n_out) {
    return hit_face(crystal, n_outside, incident,
                    incident.wave - glm::dot(incident.wave, n_out) * n_out, n_out);
}

std::array<double, 3> absorption_shares(const Crystal& crystal, const CrystalMode& mode) {
    std::array<double, 3> shares{};
    for (int i = 0; i < 3; ++i)
        shares[i] = crystal.n()[i] * std::norm(dot(crystal.axes()[i], mode.E)) / mode.flux;
    return shares;
}

}  // namespace culet
