#include "render/reference/crystal_node.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/optics/complex_vector.h"

namespace culet {

namespace {

// Rotation from a ray's waves (u, v) to the face's s and p.
Eigen::Matrix2d turned(const Vec3& u, const Vec3& v, const Vec3& s, const Vec3& p) {
    Eigen::Matrix2d turn;
    turn << glm::dot(s, u), glm::dot(s, v), glm::dot(p, u), glm::dot(p, v);
    return turn;
}

// Column of a face's matrix: the amplitudes from one arriving mode.
Eigen::Vector2cd column(const std::array<Complex, 2>& a) {
    return {a[0], a[1]};
}

// Unit vector along H of a travelling wave, which is real and normal to N.
Vec3 magnetic(const CrystalMode& mode) {
    return glm::normalize(real_part(mode.H));
}

// Orthogonal matrix nearest to a 2x2 one (its polar factor).
Eigen::Matrix2d nearest_rotation(const Eigen::Matrix2d& m) {
    Eigen::Matrix2d nearest;
    if (m(0, 0) * m(1, 1) >= m(0, 1) * m(1, 0)) {
        const double c = m(0, 0) + m(1, 1), s = m(1, 0) - m(0, 1), r = std::hypot(c, s);
        nearest << c / r, -s / r, s / r, c / r;
    } else {
        const double c = m(0, 0) - m(1, 1), s = m(1, 0) + m(0, 1), r = std::hypot(c, s);
        nearest << c / r, s / r, s / r, -c / r;
    }
    return nearest;
}

// Starts the node after `from` at a point on `facet`, with coherency `c`, as a ray outside whose
// first wave vibrates along `s`.
void start_outside(const CrystalNode& from, const Vec3& at, int facet, const Vec3& direction,
                   const Vec3& s, const EyeCoherency& c, CrystalNode& outer) {
    outer.inside = false;
    outer.at = at;
    outer.facet = facet;
    outer.direction = direction;
    outer.u = s;
    outer.v = glm::cross(direction, s);
    outer.c = c;
    outer.tau = from.tau;
    outer.event = from.event + 1;
}

// Starts it as two modes inside.
void start_inside(const CrystalNode& from, const Vec3& at, int facet,
                  const std::array<CrystalMode, 2>& modes, const EyeCoherency& c,
                  CrystalNode& inner) {
    inner.inside = true;
    inner.at = at;
    inner.facet = facet;
    inner.modes = modes;
    inner.c = c;
    inner.tau = from.tau;
    inner.event = from.event + 1;
}

}  // namespace

void CrystalSteps::meet_from_outside(const CrystalNode& node, int facet, CrystalNode& inner,
                                     CrystalNode& outer) {
    const Vec3 n_in = -body_.normal(facet);
    const Vec3& d = node.direction;
    const double cosine = std::max(glm::dot(d, n_in), 0.0);
    const Vec3 K = band_.n_outside * (d - cosine * n_in);
    const CrystalEntry entry = enter_crystal(band_.crystal, band_.n_outside, K, n_in);
    worst_imbalance_ = std::max(worst_imbalance_, entry.imbalance);
    const Vec3& s = entry.s;
    const Eigen::Matrix2d turn = turned(node.u, node.v, s, glm::cross(d, s));
    Eigen::Matrix2cd into, back;
    into << entry.into[0][0], entry.into[1][0], entry.into[0][1], entry.into[1][1];
    back << entry.back[0][0], entry.back[1][0], entry.back[0][1], entry.back[1][1];

    start_outside(node, node.at, facet, glm::normalize(d - 2 * cosine * n_in), s,
                  node.c.through(back * turn), outer);
    start_inside(node, node.at, facet, entry.modes, node.c.through(into * turn), inner);
}

double CrystalSteps::alpha(const CrystalMode& mode, int wavelength) const {
    const std::array<double, 3> shares = absorption_shares(band_.crystal, mode);
    double sum = 0;
    for (int i = 0; i < 3; ++i) sum += shares[i] * band_.absorption[i][wavelength];
    return sum;
}

void CrystalSteps::meet_alone(CrystalNode& node, int m, CrystalNode& inner, CrystalNode& outer,
                              NodeWeights& absorbed) {
    const CrystalMode& mode = node.modes[m];
    const BodyHit found = body_.exit(node.at, mode.ray, node.facet);
    const Vec3 at = body_.on_facet(found.facet, node.at + found.distance * mode.ray);
    if (band_.absorbs) {
        const std::array<double, 3> shares = absorption_shares(band_.crystal, mode);
        for (int i = 0; i < band_.count; ++i) {
            double a = 0;
            for (int axis = 0; axis < 3; ++axis) a += shares[axis] * band_.absorption[axis][i];
            const double after = node.tau[i] * std::exp(-a * found.distance);
            absorbed[i] = node.c.power(m) * (node.tau[i] - after);
            node.tau[i] = after;
        }
    }
    const CrystalHit hit =
        hit_face(band_.crystal, band_.n_outside, mode, body_.normal(found.facet));
    worst_imbalance_ = std::max(worst_imbalance_, hit.imbalance);
    start_outside(node, at, found.facet, hit.exit_direction, hit.s,
                  node.c.through_one(m, hit.out[0], hit.out[1]), outer);
    start_inside(node, at, found.facet, hit.modes,
                 node.c.through_one(m, hit.amplitude[0], hit.amplitude[1]), inner);
}

bool CrystalSteps::meet_together(CrystalNode& node, CrystalNode& inner, CrystalNode& outer,
                                 NodeWeights& absorbed) {
    const bool isotropic = band_.crystal.isotropic();
    if (!isotropic && !(band_.coherence_length > 0)) return false;
    const BodyHit first = body_.exit(node.at, node.modes[0].ray, node.facet);
    const BodyHit second = isotropic ? first : body_.exit(node.at, node.modes[1].ray, node.facet);
    if (first.facet != second.facet) return false;
    const int facet = first.facet;
    const Vec3& n = body_.normal(facet);
    const std::array<double, 2> power{node.c.power(0), node.c.power(1)};
    const double share = power[1] / (power[0] + power[1]);
    const std::array<double, 2> length{first.distance, second.distance};
    const Vec3 step =
        (1 - share) * length[0] * node.modes[0].ray + share * length[1] * node.modes[1].ray;
    const Vec3 at = body_.on_facet(facet, node.at + step);
    const double retardation =
        isotropic ? 0 : glm::dot(node.modes[1].wave - node.modes[0].wave, at - node.at);
    if (!isotropic && !(std::abs(retardation) < band_.coherence_length)) return false;

    const Vec3 N = (1 - share) * node.modes[0].wave + share * node.modes[1].wave;
    const Vec3 K = N - glm::dot(N, n) * n;
    const std::array<CrystalMode, 2> arriving = modes_towards(band_.crystal, K, n);
    for (const CrystalMode& mode : arriving) {
        if (!mode.propagates || !(glm::dot(mode.ray, n) > 0)) return false;
    }
    absorb_together(node, length, absorbed);
    if (retardation != 0) {
        const double x = std::numbers::pi * retardation / band_.coherence_length;
        const double sinc = x != 0 ? std::sin(x) / x : 1;
        // E_0 conj(E_1) gets the phase of N0 - N1.
        const Complex turn =
            std::polar(sinc * sinc, -2 * std::numbers::pi * retardation / band_.wavelength);
        for (Eigen::Matrix2cd* block : {&node.c.xx, &node.c.yy, &node.c.xy}) {
            (*block)(0, 1) *= turn;
            (*block)(1, 0) *= std::conj(turn);
        }
    }
    // Transform to the modes of the mean K: the same waves, or near an optic axis, where vibrations
    // are arbitrary, rotated ones.
    Eigen::Matrix2d overlap;
    for (int a = 0; a < 2; ++a) {
        for (int b = 0; b < 2; ++b)
            overlap(a, b) = glm::dot(magnetic(arriving[a]), magnetic(node.modes[b]));
    }
    node.c = node.c.through(nearest_rotation(overlap));
    const CrystalHit hit0 = hit_face(band_.crystal, band_.n_outside, arriving[0], K, n);
    const CrystalHit hit1 = hit_face(band_.crystal, band_.n_outside, arriving[1], K, n);
    worst_imbalance_ = std::max({worst_imbalance_, hit0.imbalance, hit1.imbalance});
    Eigen::Matrix2cd out, reflected;
    out << column(hit0.out), column(hit1.out);
    reflected << column(hit0.amplitude), column(hit1.amplitude);
    EyeCoherency leaving = node.c.through(out), staying = node.c.through(reflected);
    // The mean K makes the columns orthogonal only approximately: restore the energy balance.
    const double before = node.c.power(), after = leaving.power() + staying.power();
    if (after > 0) {
        leaving.scale(before / after);
        staying.scale(before / after);
    }
    start_outside(node, at, facet, hit0.exit_direction, hit0.s, leaving, outer);
    start_inside(node, at, facet, hit0.modes, staying, inner);
    return true;
}

// Absorbs both modes: scales tau if all light is absorbed alike (isotropic stones), else the
// coherency at the band's only wavelength.
void CrystalSteps::absorb_together(CrystalNode& node, const std::array<double, 2>& length,
                                   NodeWeights& absorbed) const {
    if (!band_.absorbs) return;
    if (band_.crystal.isotropic()) {
        for (int i = 0; i < band_.count; ++i) {
            const double after = node.tau[i] * std::exp(-band_.absorption[0][i] * length[0]);
            absorbed[i] = node.power() * (node.tau[i] - after);
            node.tau[i] = after;
        }
    } else {
        const double before = node.power();
        Eigen::Matrix2cd fade = Eigen::Matrix2cd::Zero();
        for (int m = 0; m < 2; ++m)
            fade(m, m) = std::exp(-0.5 * alpha(node.modes[m], 0) * length[m]);
        node.c = node.c.through(fade);
        absorbed[0] = (before - node.power()) * node.tau[0];
    }
}

}  // namespace culet
