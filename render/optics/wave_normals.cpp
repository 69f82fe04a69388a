#include "render/optics/wave_normals.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <type_traits>

#include "render/optics/complex_vector.h"
#include "stone/numbers/dense_algebra.h"
#include "stone/solid/perpendicular.h"

namespace culet {

void complete_travelling(CrystalMode& mode, const Vec3& E, const Vec3& N) {
    const Vec3 unit = glm::normalize(E), H = glm::cross(N, unit);
    mode.E = complex_of(unit);
    mode.H = complex_of(H);
    mode.propagates = true;
    mode.wave = N;
    const Vec3 flow = glm::cross(unit, H);
    mode.flux = glm::length(flow);
    mode.ray = flow / mode.flux;
}

void complete_evanescent(CrystalMode& mode, const ComplexVec3& E, const ComplexVec3& N) {
    mode.E = Complex(1 / std::sqrt(squared_length(E))) * E;
    mode.H = cross(N, mode.E);
    mode.propagates = false;
}

void share_no_flux(const CrystalMode& first, CrystalMode& second, const Vec3& E_beside,
                   const Vec3& n) {
    const Vec3 E1 = real_part(first.E), H1 = real_part(first.H), E2 = real_part(second.E);
    const auto shared = [&](const Vec3& E) {
        return glm::dot(n, glm::cross(E1, glm::cross(second.wave, E)) + glm::cross(E, H1));
    };
    const double along = shared(E2), beside = shared(E_beside);
    if (along == 0 || beside == 0) return;
    complete_travelling(second, E2 - (along / beside) * E_beside, second.wave);
}

namespace {

// Everything below uses the principal frame, axes by rising index.
//
// Fresnel's equation for N^2 = e2 + w (from det(N N^T - w I + diag(d1, 0, d3)) = 0):
//   a w^2 - b(N) w + d1 d3 N2^2 = 0,   a = e1 + e3 - e2,
//   b(N) = d3 N1^2 + (d1 + d3) N2^2 + d1 N3^2 + d1 d3,
// with N = K + q n and q^2 = w + Q2, Q2 = n2^2 - K^2.
class FresnelEquation {
public:
    FresnelEquation(const Crystal::Rising& c, const Vec3& K, const Vec3& n) : c_(c), K_(K), n_(n) {
        const double k = glm::length(K);
        Q2_ = (c.n[1] - k) * (c.n[1] + k);
        a_ = c.e1 + c.d3;
    }
    double Q2() const { return Q2_; }
    Vec3 at(double q) const { return K_ + q * n_; }

    // Root w of the quadratic with N fixed: the larger (slow) or the smaller (fast). For real N the
    // discriminant is a sum of non-negative terms.
    double root_at_fixed_normal(double q, bool slow) const {
        const Vec3 N = at(q);
        const double b = b_of(N), product = c_.d1 * c_.d3 * N.y * N.y;
        const double root = std::sqrt(b * b - 4 * a_ * product);
        const double larger_magnitude = b + (b >= 0 ? root : -root);
        if (larger_magnitude == 0) return 0;
        const bool is_slow = b >= 0;
        return is_slow == slow ? larger_magnitude / (2 * a_) : 2 * product / larger_magnitude;
    }

    // Both roots for a complex N, in arbitrary order.
    std::array<Complex, 2> root_at_fixed_normal(Complex q) const {
        const Complex x = K_.x + q * n_.x, y = K_.y + q * n_.y, z = K_.z + q * n_.z;
        const Complex b = c_.d3 * x * x + (c_.d1 + c_.d3) * y * y + c_.d1 * z * z + c_.d1 * c_.d3;
        const Complex product = c_.d1 * c_.d3 * y * y;
        const Complex root = std::sqrt(b * b - 4 * a_ * product);
        const Complex larger = std::norm(b + root) >= std::norm(b - root) ? b + root : b - root;
        if (larger == 0.0) return {0, 0};
        return {larger / (2 * a_), 2.0 * product / larger};
    }

    // Result of Newton's method for one wave; `Number` is real or complex.
    template <class Number>
    struct Root {
        Number w, q;
        bool converged = false;
    };

    // Solves F(w) = 0 along q = +-sqrt(w + Q2) from a start (w, q).
    template <class Number>
    Root<Number> polished(Number w, Number q, int steps) const {
        Root<Number> root{w, q, false};
        double last = std::numeric_limits<double>::infinity();
        for (int step = 0; step < steps; ++step) {
            // Iterate in w while w is the smaller part of q^2, to keep its last digits; else in q.
            const bool in_w = std::norm(root.q) > std::abs(root.w);
            const Number Nx = K_.x + root.q * n_.x, Ny = K_.y + root.q * n_.y,
                         Nz = K_.z + root.q * n_.z;
            const Number b =
                c_.d3 * Nx * Nx + (c_.d1 + c_.d3) * Ny * Ny + c_.d1 * Nz * Nz + c_.d1 * c_.d3;
            const Number b_q =
                2.0 * (c_.d3 * Nx * n_.x + (c_.d1 + c_.d3) * Ny * n_.y + c_.d1 * Nz * n_.z);
            const Number F = root.w * (a_ * root.w - b) + c_.d1 * c_.d3 * Ny * Ny;
            const Number F_w = 2.0 * a_ * root.w - b;
            const Number F_q = -root.w * b_q + 2.0 * c_.d1 * c_.d3 * Ny * n_.y;
            double change = 0;
            if (in_w) {
                const Number slope = F_w + F_q / (2.0 * root.q);
                if (slope == 0.0) return root;
                const Number move = F / slope;
                root.w -= move;
                // The step went too far, to where no wave travels.
                if constexpr (std::is_floating_point_v<Number>) {
                    if (root.w + Q2_ < 0) return root;
                }
                const Number next = std::sqrt(root.w + Q2_);
                root.q = std::abs(next - root.q) <= std::abs(next + root.q) ? next : -next;
                change = std::abs(move) / (std::abs(root.w) + scale());
            } else {
                const Number slope = 2.0 * root.q * F_w + F_q;
                if (slope == 0.0) return root;
                const Number move = F / slope;
                root.q -= move;
                root.w = root.q * root.q - Q2_;
                change = std::abs(move) / (std::abs(root.q) + 1e-300);
            }
            if (!std::isfinite(change)) return root;
            // Newton's method squares the error: after 1e-9 only rounding error remains.
            if (change < 1e-14 || (change < 1e-9 && step > 0 && last < 1e-3)) {
                root.converged = true;
                return root;
            }
            last = change;
        }
        return root;
    }

    // Coefficients of q^4 .. q^0.
    std::array<double, 5> quartic() const {
        const double d13 = c_.d1 * c_.d3;
        const double b0 = b_of(K_);
        const double b1 =
            2 * (c_.d3 * K_.x * n_.x + (c_.d1 + c_.d3) * K_.y * n_.y + c_.d1 * K_.z * n_.z);
        const double b2 = c_.d3 * n_.x * n_.x + (c_.d1 + c_.d3) * n_.y * n_.y + c_.d1 * n_.z * n_.z;
        return {a_ - b2, -b1, -2 * a_ * Q2_ - b0 + b2 * Q2_ + d13 * n_.y * n_.y,
                b1 * Q2_ + 2 * d13 * K_.y * n_.y, a_ * Q2_ * Q2_ + Q2_ * b0 + d13 * K_.y * K_.y};
    }

private:
    double b_of(const Vec3& N) const {
        return c_.d3 * N.x * N.x + (c_.d1 + c_.d3) * N.y * N.y + c_.d1 * N.z * N.z + c_.d1 * c_.d3;
    }
    // Scale for relative changes of w: its largest size, so that w = 0 converges too.
    double scale() const { return 1e-3 * (c_.d3 - c_.d1); }

    const Crystal::Rising& c_;
    Vec3 K_, n_;
    double Q2_ = 0, a_ = 1;
};

// Fields of a real N: D is an eigenvector of the impermeability, less I/e2, on the plane normal to
// N. The two waves are always orthogonal, also on an optic axis.
Vec3 field_of_real(const Crystal::Rising& c, const Vec3& N, bool slow) {
    const Vec3 u = perpendicular_to(glm::normalize(N));
    const Vec3 v = glm::normalize(glm::cross(N, u));
    const double f1 = -c.d1 / (c.e1 * c.e2), f3 = -c.d3 / (c.e3 * c.e2);  // 1/e_i - 1/e2
    const double uu = f1 * u.x * u.x + f3 * u.z * u.z, vv = f1 * v.x * v.x + f3 * v.z * v.z,
                 uv = f1 * u.x * v.x + f3 * u.z * v.z;
    // The fast wave has the larger eigenvalue 1/N^2.
    const double angle = 0.5 * std::atan2(2 * uv, uu - vv);
    const Vec3 fast = std::cos(angle) * u + std::sin(angle) * v;
    const Vec3 D = slow ? glm::cross(glm::normalize(N), fast) : fast;
    return {D.x / c.e1, D.y / c.e2, D.z / c.e3};
}

// Field of a complex N: the null vector of N N^T + diag(d1 - w, -w, d3 - w), as the largest column
// of its adjugate.
ComplexVec3 field_of_complex(const Crystal::Rising& c, const ComplexVec3& N, Complex w) {
    const std::array<Complex, 3> N_{N.x, N.y, N.z}, delta{c.d1 - w, -w, c.d3 - w};
    int best = 0;
    double most = -1;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double size =
            std::abs(delta[j] * delta[k] + delta[j] * N_[k] * N_[k] + delta[k] * N_[j] * N_[j]);
        if (size > most) {
            most = size;
            best = i;
        }
    }
    const int i = best, j = (i + 1) % 3, k = (i + 2) % 3;
    std::array<Complex, 3> E;
    E[i] = delta[j] * delta[k] + delta[j] * N_[k] * N_[k] + delta[k] * N_[j] * N_[j];
    E[j] = -delta[k] * N_[i] * N_[j];
    E[k] = -delta[j] * N_[i] * N_[k];
    return {E[0], E[1], E[2]};
}

class PrincipalFrame {
public:
    explicit PrincipalFrame(const std::array<Vec3, 3>& axes) : axes_(axes) {}
    Vec3 into(const Vec3& v) const {
        return {glm::dot(axes_[0], v), glm::dot(axes_[1], v), glm::dot(axes_[2], v)};
    }
    Vec3 back(const Vec3& v) const { return v.x * axes_[0] + v.y * axes_[1] + v.z * axes_[2]; }
    ComplexVec3 back(const ComplexVec3& v) const {
        return v.x * complex_of(axes_[0]) + v.y * complex_of(axes_[1]) + v.z * complex_of(axes_[2]);
    }

private:
    const std::array<Vec3, 3>& axes_;
};

constexpr int k_most_steps = 60;

// Farthest that Newton's method may move a root, relative to the quartic's scale. At an m-fold root
// the companion matrix's eigenvalues are off by the m-th root of rounding, 1e-4 of the scale for m
// = 4; there Newton's method has no slope and may go anywhere.
constexpr double k_reach = 1e-3;

// Waves whose N differ by less, relative to the birefringence, run beside an optic axis.
constexpr double k_beside_axis = 1e-2;

class WavePair {
public:
    WavePair(const Crystal::Rising& crystal, const Vec3& K, const Vec3& n)
        : crystal_(crystal),
          K_(K),
          n_(n),
          frame_(crystal.axes),
          equation_(crystal, frame_.into(K), frame_.into(n)),
          split_(crystal.d3 - crystal.d1) {}

    std::array<CrystalMode, 2> towards_n() const {
        std::array<CrystalMode, 2> modes;
        if (!both_travel(modes) && !both_evanescent(modes)) from_quartic(modes);
        const double apart = glm::length(modes[0].wave - modes[1].wave);
        if (modes[0].propagates && modes[1].propagates && apart < k_beside_axis * split_) {
            const Vec3 H = frame_.into(real_part(modes[1].H));
            const Vec3 E{H.x / crystal_.e1, H.y / crystal_.e2, H.z / crystal_.e3};
            share_no_flux(modes[0], modes[1], frame_.back(E), n_);
        }
        modes[0].kind = ModeKind::slow;
        modes[1].kind = ModeKind::fast;
        return modes;
    }

private:
    // The common case: both waves travel, q > 0. Each iteration with N fixed gains a factor of the
    // birefringence; Newton's method finishes, unless the roots coincide (on an optic axis), where
    // it has no slope and the iterations continue.
    bool both_travel(std::array<CrystalMode, 2>& modes) const {
        for (int m = 0; m < 2; ++m) {
            const bool slow = m == 0;
            double squared = equation_.Q2(), w = 0;
            for (int step = 0; step < 3; ++step) {
                if (!(squared > 0)) return false;
                w = equation_.root_at_fixed_normal(std::sqrt(squared), slow);
                squared = w + equation_.Q2();
            }
            if (!(squared > 0)) return false;
            double q = std::sqrt(squared);
            const auto newton = equation_.polished<double>(w, q, 8);
            const bool same_wave = newton.converged && newton.q > 0 &&
                                   std::abs(newton.w - equation_.root_at_fixed_normal(
                                                           newton.q, slow)) <= 1e-9 * split_;
            if (same_wave) {
                q = newton.q;
            } else {
                bool settled = false;
                for (int step = 0; step < k_most_steps && !settled; ++step) {
                    const double next = equation_.root_at_fixed_normal(q, slow);
                    squared = next + equation_.Q2();
                    if (!(squared > 0)) return false;
                    settled = std::abs(next - w) <= 1e-15 * (std::abs(next) + 1e-3 * split_);
                    w = next;
                    q = std::sqrt(squared);
                }
                if (!settled) return false;
            }
            travelling(modes[m], q, slow);
            // Near grazing, the wave of q > 0 may carry its energy the other way.
            if (!(glm::dot(modes[m].ray, n_) > 0)) return false;
        }
        return true;
    }

    // Both waves decay, far enough beyond the critical angle for iterations with N fixed to
    // converge. Each branch takes the root nearest to its last one.
    bool both_evanescent(std::array<CrystalMode, 2>& modes) const {
        if (!(equation_.Q2() < -4 * split_)) return false;
        const Complex start(0, std::sqrt(-equation_.Q2()));
        const std::array<Complex, 2> first = equation_.root_at_fixed_normal(start);
        for (int m = 0; m < 2; ++m) {
            Complex w = first[m], q = start;
            bool settled = false;
            for (int step = 0; step < k_most_steps && !settled; ++step) {
                q = std::sqrt(w + equation_.Q2());
                if (q.imag() < 0) q = -q;
                const std::array<Complex, 2> next = equation_.root_at_fixed_normal(q);
                const Complex nearest =
                    std::abs(next[0] - w) <= std::abs(next[1] - w) ? next[0] : next[1];
                settled = std::abs(nearest - w) <= 1e-15 * (std::abs(w) + 1e-3 * split_);
                w = nearest;
            }
            if (!settled) return false;
            q = std::sqrt(w + equation_.Q2());
            if (q.imag() < 0) q = -q;
            evanescent(modes[m], q, w);
        }
        return true;
    }

    // Near grazing: polishes all four waves of this K from the companion matrix of Fresnel's
    // quartic in a scaled q, and takes the two towards n.
    void from_quartic(std::array<CrystalMode, 2>& modes) const {
        const std::array<double, 5> c = equation_.quartic();
        double scale = 0;
        for (int i = 1; i < 5; ++i)
            scale = std::max(scale, std::pow(std::abs(c[i] / c[0]), 1.0 / i));
        if (scale == 0) scale = 1;
        Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
        for (int i = 0; i < 4; ++i) companion(0, i) = -c[i + 1] / (c[0] * std::pow(scale, i + 1));
        for (int i = 1; i < 4; ++i) companion(i, i - 1) = 1;
        const Eigen::Vector4cd starts = scale * eigenvalues4(companion);
        struct Found {
            CrystalMode mode;
            double forward = 0;  // > 0: carries energy, or decays, towards n
            double w = 0;
        };
        std::array<Found, 4> found;
        for (int i = 0; i < 4; ++i) {
            Found& wave = found[i];
            // Eigenvalues of a real matrix are exactly real or come in conjugate pairs.
            if (starts[i].imag() == 0) {
                const double q0 = starts[i].real(), w0 = q0 * q0 - equation_.Q2();
                const auto root = equation_.polished<double>(w0, q0, 20);
                const bool good = std::abs(root.q - q0) <= k_reach * scale && std::isfinite(root.w);
                const double q = good ? root.q : q0;
                wave.w = good ? root.w : w0;
                const bool slow = std::abs(wave.w - equation_.root_at_fixed_normal(q, true)) <=
                                  std::abs(wave.w - equation_.root_at_fixed_normal(q, false));
                travelling(wave.mode, q, slow);
                wave.forward = glm::dot(wave.mode.ray, n_);
            } else {
                const Complex q0 = starts[i], w0 = q0 * q0 - equation_.Q2();
                const auto root = equation_.polished<Complex>(w0, q0, 20);
                const bool good = std::abs(root.q - q0) <= k_reach * scale &&
                                  std::isfinite(std::abs(root.w)) && root.q.imag() != 0;
                const Complex q = good ? root.q : q0, w = good ? root.w : w0;
                evanescent(wave.mode, q, w);
                wave.forward = q.imag() > 0 ? 2 : -2;
                wave.w = w.real();
            }
        }
        std::sort(found.begin(), found.end(),
                  [](const Found& a, const Found& b) { return a.forward > b.forward; });
        const bool in_order = found[0].w >= found[1].w;
        modes = {found[in_order ? 0 : 1].mode, found[in_order ? 1 : 0].mode};
    }

    void travelling(CrystalMode& mode, double q, bool slow) const {
        complete_travelling(mode, frame_.back(field_of_real(crystal_, equation_.at(q), slow)),
                            K_ + q * n_);
    }
    void evanescent(CrystalMode& mode, Complex q, Complex w) const {
        const ComplexVec3 N = complex_of(frame_.into(K_)) + q * complex_of(frame_.into(n_));
        complete_evanescent(mode, frame_.back(field_of_complex(crystal_, N, w)),
                            complex_of(K_) + q * complex_of(n_));
    }

    const Crystal::Rising& crystal_;
    Vec3 K_, n_;
    PrincipalFrame frame_;
    FresnelEquation equation_;
    double split_;
};

}  // namespace

std::array<CrystalMode, 2> biaxial_modes(const Crystal::Rising& crystal, const Vec3& K,
                                         const Vec3& n) {
    return WavePair(crystal, K, n).towards_n();
}

}  // namespace culet
