#include "tests/render/face_oracle.h"

#include <algorithm>
#include <vector>

#include "tests/render/oracle_numbers.h"

namespace culet::oracle {

namespace {

struct Crystal100 {
    Triple<RealVec> axes;
    Triple<Number> n;

    Matrix permittivity() const {
        Matrix eps{};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                for (int k = 0; k < 3; ++k) eps[i][j] += n[k] * n[k] * axes[k][i] * axes[k][j];
        return eps;
    }
};

Triple<RealVec> orthonormal(const std::array<Vec3, 3>& axes) {
    Triple<RealVec> u;
    for (int i = 0; i < 3; ++i) {
        u[i] = exact(axes[i]);
        for (int j = 0; j < i; ++j) u[i] = u[i] - dot(u[i], u[j]) * u[j];
        u[i] = unit(u[i]);
    }
    return u;
}

Matrix wave_matrix(const Matrix& eps, const Vec& N) {
    Matrix m = eps;
    const Number squared = dot(N, N);
    for (int i = 0; i < 3; ++i) {
        m[i][i] -= squared;
        for (int j = 0; j < 3; ++j) m[i][j] += N[i] * N[j];
    }
    return m;
}

std::vector<Number> normal_parts(const Matrix& eps, const RealVec& K, const RealVec& n) {
    std::array<Polynomial, 3> N;
    for (int i = 0; i < 3; ++i) N[i] = {Number(K[i]), Number(n[i])};
    const Polynomial squared = N[0] * N[0] + N[1] * N[1] + N[2] * N[2];
    std::array<std::array<Polynomial, 3>, 3> m;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            m[i][j] = N[i] * N[j] + Polynomial{eps[i][j]};
            if (i == j) m[i][j] = m[i][j] - squared;
        }
    return roots_of(determinant(m), 4);  // powers 5 and 6 cancel
}

// The null vector of a matrix of rank 2: the longest cross product of two rows.
Vec null_vector(const Matrix& m) {
    Vec best{};
    for (int i = 0; i < 3; ++i) {
        const Vec product = cross(m[i], m[(i + 1) % 3]);
        if (norm_of(product) > norm_of(best)) best = product;
    }
    return (1 / Number(sqrt(norm_of(best)))) * best;
}

// Two orthogonal null vectors of a symmetric matrix of rank 1, a multiple of row row^T. The rows
// are complex for evanescent waves.
std::array<Vec, 2> null_plane(const Matrix& m) {
    Vec row{};
    for (int i = 0; i < 3; ++i)
        if (norm_of(m[i]) > norm_of(row)) row = m[i];
    int least = 0;
    for (int i = 1; i < 3; ++i)
        if (norm_of(row[i]) < norm_of(row[least])) least = i;
    Vec other{};
    other[least] = 1;
    const auto of_length_one = [](const Vec& v) { return (1 / Number(sqrt(norm_of(v)))) * v; };
    const Vec u = of_length_one(cross(row, other));
    return {u, of_length_one(cross(row, conjugate(u)))};
}

struct Wave100 {
    Number q;
    Vec N, E, H;  // |E| = 1
    bool propagates = true;
    RealVec flow;
    Real flux;
    Real along_axis;  // share of E along the optic axis, squared

    void complete(const RealVec& n, const RealVec& axis) {
        H = cross(N, E);
        flow = real_part(cross(E, conjugate(H)));
        flux = propagates ? dot(flow, n) : Real(0);
        along_axis = norm_of(dot(complex_of(axis), E));
    }
    Real forward() const { return propagates ? flux : 1000 * q.imag(); }
};

Wave rounded_wave(const Wave100& wave) {
    Wave w;
    w.propagates = wave.propagates;
    w.q = rounded(wave.q);
    w.N = rounded(wave.N);
    const Number scale = wave.propagates && wave.flux != 0 ? 1 / sqrt(abs(wave.flux)) : Real(1);
    w.E = rounded(scale * wave.E);
    w.H = rounded(scale * wave.H);
    if (wave.propagates) w.ray = rounded(unit(wave.flow));
    w.flux_along_normal = static_cast<double>(wave.flux);
    return w;
}

// Solves m x = right for x by Gauss with full pivoting.
using Vec4 = std::array<Number, 4>;
Vec4 solution(std::array<Vec4, 4> m, Vec4 right) {
    std::array<int, 4> column{0, 1, 2, 3};
    for (int k = 0; k < 4; ++k) {
        int row = k, col = k;
        for (int i = k; i < 4; ++i)
            for (int j = k; j < 4; ++j)
                if (norm_of(m[i][j]) > norm_of(m[row][col])) row = i, col = j;
        std::swap(m[k], m[row]);
        std::swap(right[k], right[row]);
        for (Vec4& r : m) std::swap(r[k], r[col]);
        std::swap(column[k], column[col]);
        for (int i = k + 1; i < 4; ++i) {
            const Number f = m[i][k] / m[k][k];
            for (int j = k; j < 4; ++j) m[i][j] -= f * m[k][j];
            right[i] -= f * right[k];
        }
    }
    Vec4 x;
    for (int k = 3; k >= 0; --k) {
        Number sum = right[k];
        for (int j = k + 1; j < 4; ++j) sum -= m[k][j] * x[column[j]];
        x[column[k]] = sum / m[k][k];
    }
    return x;
}

// What all waves of one K and one face share.
class Problem {
public:
    Problem(const Face& face, const Nudge& nudge) {
        n_ = unit(exact(face.normal));
        K_ = exact(face.K);
        K_ = K_ - dot(K_, n_) * n_;
        s_ = length(K_) < Real("1e-13") ? exact(face.s) : cross(K_, n_);
        s_ = unit(s_ - dot(s_, n_) * n_);
        K_ = (1 + Real(nudge.K_growth)) * turned(K_, Real(nudge.K_turn) * n_);
        s_ = turned(s_, Real(nudge.K_turn) * n_);
        n_outside_ = face.n_outside;
        crystal_.axes = orthonormal(face.axes);
        for (RealVec& axis : crystal_.axes) axis = turned(axis, exact(nudge.crystal_turn));
        for (int i = 0; i < 3; ++i) crystal_.n[i] = Real(face.n[i]);
        odd_ = face.n[1] == face.n[2] ? 0 : face.n[0] == face.n[2] ? 1 : 2;
        uniaxial_ = face.n[odd_ == 0 ? 1 : 0] == face.n[odd_ == 2 ? 1 : 2];
    }

    void find_waves() {
        const Matrix eps = crystal_.permittivity();
        std::array<Wave100, 4> found;
        const std::vector<Number> q = normal_parts(eps, K_, n_);
        for (int i = 0; i < 4; ++i) {
            Wave100& wave = found[i];
            wave.q = q[i];
            wave.propagates = abs(q[i].imag()) < k_same;
            if (wave.propagates) wave.q = q[i].real();
            wave.N = complex_of(K_) + wave.q * complex_of(n_);
            wave.E = null_vector(wave_matrix(eps, wave.N));
            wave.complete(n_, crystal_.axes[odd_]);
        }
        // Pairs with one N that are not the forward and backward grazing wave: a plane of fields.
        // In a crystal of three equal indices evanescent waves are such pairs too.
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < i; ++j) {
                if (norm_of(found[i].q - found[j].q) > k_same * k_same) continue;
                const Matrix m = wave_matrix(eps, found[i].N);
                Real largest = 0, minors = 0;
                for (int r = 0; r < 3; ++r) {
                    largest = std::max(largest, norm_of(m[r]));
                    minors = std::max(minors, norm_of(cross(m[r], m[(r + 1) % 3])));
                }
                if (minors > Real("1e-60") * largest * largest) continue;
                const std::array<Vec, 2> fields = null_plane(m);
                found[i].E = fields[0];
                found[j].E = fields[1];
                found[j].N = found[i].N;
                found[i].complete(n_, crystal_.axes[odd_]);
                found[j].complete(n_, crystal_.axes[odd_]);
                if (found[i].propagates) make_orthogonal(found[i], found[j]);
            }
        std::sort(found.begin(), found.end(),
                  [](const Wave100& a, const Wave100& b) { return a.forward() > b.forward(); });
        towards_ = {found[0], found[1]};
        away_ = {found[2], found[3]};
        const auto order = [this](std::array<Wave100, 2>& pair) {
            const bool good =
                uniaxial_ ? pair[0].along_axis <= pair[1].along_axis
                          : dot(pair[0].N, pair[0].N).real() >= dot(pair[1].N, pair[1].N).real();
            if (!good) std::swap(pair[0], pair[1]);
        };
        order(towards_);
        order(away_);
    }

    Answer answer() const {
        Answer a;
        for (int i = 0; i < 2; ++i) {
            a.towards[i] = rounded_wave(towards_[i]);
            a.away[i] = rounded_wave(away_[i]);
        }
        a.gap_towards = static_cast<double>(sqrt(norm_of(towards_[0].q - towards_[1].q)));
        a.gap_away = static_cast<double>(sqrt(norm_of(away_[0].q - away_[1].q)));
        const Real left = n_outside_ * n_outside_ - dot(K_, K_);
        a.enters = left > 0;
        const Number q = left >= 0 ? Number(sqrt(left)) : Number(Real(0), sqrt(-left));
        // Outside: s and p waves of unit E along +n and -n; p = N x s / n also when evanescent.
        std::array<Outer, 2> along{outer(q, false), outer(q, true)};
        std::array<Outer, 2> against{outer(-q, false), outer(-q, true)};
        const Real outer_flux = left > 0 ? Real(sqrt(left)) : Real(0);

        for (int m = 0; a.enters && m < 2; ++m) {
            // incident + reflected = transmitted
            const Vec4 x = solution(columns(part(towards_[0]), part(towards_[1]),
                                            minus(part(against[0])), minus(part(against[1]))),
                                    part(along[m]));
            Real sum = 0;
            for (int j = 0; j < 2; ++j) {
                const Number t = x[j] * sqrt(abs(towards_[j].flux) / outer_flux);
                a.into[m][j] = rounded(t);
                a.back[m][j] = rounded(x[2 + j]);
                sum += norm_of(t) + norm_of(x[2 + j]);
            }
            a.imbalance = std::max(a.imbalance, static_cast<double>(abs(sum - 1)));
        }
        for (int m = 0; m < 2; ++m) {
            if (!(towards_[m].flux > 0)) continue;
            const Vec4 x = solution(columns(part(away_[0]), part(away_[1]), minus(part(along[0])),
                                            minus(part(along[1]))),
                                    minus(part(towards_[m])));
            Real sum = 0;
            for (int j = 0; j < 2; ++j) {
                const Number r = x[j] * sqrt(abs(away_[j].flux) / towards_[m].flux);
                const Number t = x[2 + j] * sqrt(outer_flux / towards_[m].flux);
                a.reflected[m][j] = rounded(r);
                a.out[m][j] = rounded(t);
                sum += norm_of(r) + norm_of(t);
            }
            a.imbalance = std::max(a.imbalance, static_cast<double>(abs(sum - 1)));
        }
        return a;
    }

    // d Im q / dx of the waves towards n, and d Im N / dx of homogeneous waves along the same wave
    // normals, n_i + i kappa_i x.
    Attenuation attenuated(const std::array<double, 3>& kappa) const {
        const Real x("1e-35");
        Crystal100 absorbing = crystal_;
        for (int i = 0; i < 3; ++i) absorbing.n[i] += Number(Real(0), x * Real(kappa[i]));
        const Matrix eps = absorbing.permittivity();
        const std::vector<Number> q = normal_parts(eps, K_, n_);
        Attenuation result{};
        for (int w = 0; w < 2; ++w) {
            result.across_face[w] = static_cast<double>(nearest(q, towards_[w].q).imag() / x);
            // det(z (u u^T - I) + eps) = 0 for z = N^2 along the wave normal u.
            const RealVec u = unit(real_part(towards_[w].N));
            std::array<std::array<Polynomial, 3>, 3> m;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j)
                    m[i][j] = {eps[i][j], Number(u[i] * u[j] - (i == j ? 1 : 0))};
            const Real squared = dot(real_part(towards_[w].N), real_part(towards_[w].N));
            const Number z = nearest(roots_of(determinant(m), 2), Number(squared));
            result.along_normal[w] = static_cast<double>(sqrt(z).imag() / x);
        }
        return result;
    }

private:
    struct Outer {
        Vec E, H;
    };
    Outer outer(const Number& q, bool p) const {
        const Vec N = complex_of(K_) + q * complex_of(n_);
        Vec E = complex_of(s_);
        if (p) E = Number(1 / n_outside_) * cross(N, E);
        return {E, cross(N, E)};
    }

    // A wave's tangential fields: E and H along two directions in the face.
    template <class W>
    Vec4 part(const W& wave) const {
        const Vec t1 = complex_of(s_), t2 = complex_of(cross(n_, s_));
        return {dot(t1, wave.E), dot(t2, wave.E), dot(t1, wave.H), dot(t2, wave.H)};
    }
    static Vec4 minus(const Vec4& a) { return {-a[0], -a[1], -a[2], -a[3]}; }
    static std::array<Vec4, 4> columns(const Vec4& a, const Vec4& b, const Vec4& c, const Vec4& d) {
        std::array<Vec4, 4> m;
        for (int i = 0; i < 4; ++i) m[i] = {a[i], b[i], c[i], d[i]};
        return m;
    }
    static Number nearest(const std::vector<Number>& values, const Number& to) {
        return *std::min_element(
            values.begin(), values.end(),
            [&](const Number& a, const Number& b) { return norm_of(a - to) < norm_of(b - to); });
    }

    // Two waves of one N: fields whose fluxes add, Re(E1 x H2* + E2* x H1).n = 0.
    void make_orthogonal(Wave100& a, Wave100& b) const {
        const RealVec mixed = real_part(cross(a.E, conjugate(b.H)) + cross(b.E, conjugate(a.H)));
        const Real share = dot(mixed, n_) / (2 * a.flux);
        b.E = b.E - Number(share) * a.E;
        b.E = (1 / Number(sqrt(norm_of(b.E)))) * b.E;
        b.complete(n_, crystal_.axes[odd_]);
    }

    RealVec n_, K_, s_;
    Real n_outside_;
    Crystal100 crystal_;
    bool uniaxial_ = false;
    int odd_ = 0;
    std::array<Wave100, 2> towards_, away_;
};

}  // namespace

Answer solve(const Face& face, const Nudge& nudge) {
    Problem problem(face, nudge);
    problem.find_waves();
    return problem.answer();
}

Attenuation attenuation(const Face& face, const std::array<double, 3>& kappa) {
    Problem problem(face, {});
    problem.find_waves();
    return problem.attenuated(kappa);
}

}  // namespace culet::oracle
