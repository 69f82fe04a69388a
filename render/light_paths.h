#pragma once
// The exact tree of light paths behind one eye ray: the judge of every faster engine.
//
// Traced backwards from the eye, which is exact because a face's power fractions are the same when
// every wave vector is reversed: the eye ray is an emitted, unpolarised ray, and the radiance seen
// is the sum over leaves of weight x radiance from the exit direction. Radiance is "basic" (per
// normal flux and per squared tangential wave vector), so there are no factors of index squared or
// of solid angle. For every ray
//   leaves + remainder + absorbed + cut = 1.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "render/convex_body.h"
#include "render/crystal.h"
#include "render/fresnel.h"
#include "render/scene.h"
#include "stone/perpendicular.h"

namespace culet {

/// Most wavelengths that share one band; longer sets are split.
constexpr int k_band_nodes = 32;
using NodeWeights = std::array<double, k_band_nodes>;

/// Wavelength nodes that share one geometry, and the optics of the stone for them.
struct Band {
    int first = 0, count = 1;  ///< of the wavelength set
    bool crystal = false;      ///< two waves; else isotropic of index `n`
    double n = 1.5;
    UniaxialCrystal uniaxial;
    bool absorbs = false;
    /// Per unit of length: [0] n or o, [1] e. Equal for isotropic absorption.
    std::array<NodeWeights, 2> absorption{};
};

struct PathLimits {
    int depth = 64;         ///< depth d has d - 1 inner segments
    double cut_weight = 0;  ///< a path of less weight is not followed; its weight is counted as cut
    /// Crystals: below this weight one reflected wave is followed, chosen with the probability of
    /// its power, so that the sum stays unbiased (0: both always).
    double split_weight = 0;
    /// Crystals: so many hits of one eye ray at most split in two; after them every path follows
    /// one wave as above. Without it a tree of depth d has 2^d paths.
    int most_splits = 1 << 14;
    std::uint64_t seed = 0;  ///< of those choices
    bool polarised = true;   ///< false: mean powers of s and p at every isotropic face
};

/// What the eye ray met on the way, by facet; depth-first, so one array serves.
struct PathTrace {
    static constexpr int k_longest = 1024;
    std::array<short, k_longest> facets{};
    std::array<char, k_longest> modes{};  ///< of the segment behind each facet: 'i', 'o' or 'e'
    int length = 0;
};

// A Sink has
//   void leaf(const Vec3& origin, const Vec3& direction, const NodeWeights&, const PathTrace&);
//   void remainder(const NodeWeights&), absorbed(const NodeWeights&), cut(const NodeWeights&);
template <class Sink>
class LightPaths {
public:
    LightPaths(const ConvexBody& body, const Band& band, const PathLimits& limits, Sink& sink)
        : body_(body), band_(band), limits_(limits), sink_(sink), random_(limits.seed) {}

    /// Follows an eye ray that enters the stone at `entry`.
    void trace(const EyeRay& ray, const BodyHit& entry) {
        splits_ = 0;
        trace_.length = 0;
        tau_full_.fill(1.0);
        const Vec3 at = body_.on_facet(entry.facet, ray.origin + entry.distance * ray.direction);
        if (band_.crystal) {
            trace_crystal(at, ray.direction, entry.facet);
        } else if (limits_.polarised) {
            trace_polarised(at, ray.direction, entry.facet);
        } else {
            trace_scalar(at, ray.direction, entry.facet);
        }
    }

    /// True when the last tree was larger than `most_splits`.
    bool sampled() const { return splits_ > limits_.most_splits; }
    /// Largest |sum of powers - 1| of a crystal's face before it was put right.
    double worst_imbalance() const { return worst_imbalance_; }

private:
    NodeWeights weighted(double weight, const NodeWeights& tau) const {
        NodeWeights result{};
        for (int i = 0; i < band_.count; ++i) result[i] = weight * tau[i];
        return result;
    }
    double largest(double weight, const NodeWeights& tau) const {
        double most = 0;
        for (int i = 0; i < band_.count; ++i) most = std::max(most, tau[i]);
        return weight * most;
    }
    void push(int facet, char mode) {
        trace_.facets[trace_.length] = static_cast<short>(facet);
        trace_.modes[trace_.length] = mode;
        ++trace_.length;
    }

    // Beer and Lambert along a segment; `share_e`, `share_o` weigh the principal coefficients.
    void absorb(double weight, double length, double share_o, double share_e, NodeWeights& tau) {
        if (!band_.absorbs) return;
        NodeWeights lost{};
        for (int i = 0; i < band_.count; ++i) {
            const double alpha =
                share_o * band_.absorption[0][i] + share_e * band_.absorption[1][i];
            const double after = tau[i] * std::exp(-alpha * length);
            lost[i] = weight * (tau[i] - after);
            tau[i] = after;
        }
        sink_.absorbed(lost);
    }

    // The tangent s of a face for a ray, and p for any ray in the same plane of incidence.
    static Vec3 tangent(const Vec3& direction, const Vec3& n) {
        const Vec3 s = glm::cross(direction, n);
        const double squared = glm::dot(s, s);
        if (squared > 1e-28) return s / std::sqrt(squared);
        // Normal incidence: the face treats all directions alike (r_p = -r_s), any tangent serves.
        return perpendicular_to(n);
    }

    static Vec3 mirrored(const Vec3& direction, const Vec3& n) {
        return glm::normalize(direction - 2 * glm::dot(direction, n) * n);
    }
    // `n` points to the side that the ray goes to; q1, q2 along it.
    static Vec3 refracted(const Vec3& direction, const Vec3& n, double n1, double q1, double q2) {
        return glm::normalize(n1 * direction + (q2 - q1) * n);
    }

    // Jones vector images of two orthonormal eye polarisations, as complex 3-vectors in global
    // coordinates: no frame is turned and none degenerates. |E_1|^2 + |E_2|^2 is twice the weight.
    struct Field {
        Vec3 re{0, 0, 0}, im{0, 0, 0};
    };

    void trace_polarised(Vec3 at, Vec3 direction, int facet) {
        const Vec3 n_in = -body_.normal(facet);
        const double q1 = std::clamp(glm::dot(direction, n_in), 0.0, 1.0);
        const FaceAmplitudes face = fresnel(1.0, band_.n, q1);
        const Vec3 s = tangent(direction, n_in);
        push(facet, 'i');
        // Eye polarisations along s and p of the first face.
        leaf(at, mirrored(direction, n_in), 0.5 * (std::norm(face.r_s) + std::norm(face.r_p)),
             tau_full_);
        const Vec3 inner = refracted(direction, n_in, 1.0, q1, face.q2);
        std::array<Field, 2> fields;
        fields[0].re = face.t_s * s;
        fields[1].re = face.t_p * glm::cross(inner, s);
        double weight = 0.5 * (face.t_s * face.t_s + face.t_p * face.t_p);
        direction = inner;
        NodeWeights tau = tau_full_;
        for (int event = 2; event <= limits_.depth; ++event) {
            if (largest(weight, tau) < limits_.cut_weight) {
                sink_.cut(weighted(weight, tau));
                return;
            }
            const BodyHit hit = body_.exit(at, direction);
            at = body_.on_facet(hit.facet, at + hit.distance * direction);
            absorb(weight, hit.distance, 1, 0, tau);
            const Vec3& n = body_.normal(hit.facet);
            const FaceAmplitudes out = fresnel(band_.n, 1.0, band_.n * glm::dot(direction, n));
            const Vec3 s2 = tangent(direction, n), p2 = glm::cross(direction, s2);
            const Vec3 reflected = mirrored(direction, n), p_reflected = glm::cross(reflected, s2);
            push(hit.facet, 'i');
            double transmitted = 0, kept = 0;
            for (Field& field : fields) {
                const std::complex<double> along_s(glm::dot(field.re, s2), glm::dot(field.im, s2));
                const std::complex<double> along_p(glm::dot(field.re, p2), glm::dot(field.im, p2));
                transmitted +=
                    out.t_s * out.t_s * std::norm(along_s) + out.t_p * out.t_p * std::norm(along_p);
                const double sr = out.r_s.real() * along_s.real() - out.r_s.imag() * along_s.imag();
                const double si = out.r_s.real() * along_s.imag() + out.r_s.imag() * along_s.real();
                const double pr = out.r_p.real() * along_p.real() - out.r_p.imag() * along_p.imag();
                const double pi = out.r_p.real() * along_p.imag() + out.r_p.imag() * along_p.real();
                kept += sr * sr + si * si + pr * pr + pi * pi;
                field.re = sr * s2 + pr * p_reflected;
                field.im = si * s2 + pi * p_reflected;
            }
            if (!out.total) {
                leaf(at, refracted(direction, n, band_.n, band_.n * glm::dot(direction, n), out.q2),
                     0.5 * transmitted, tau);
            }
            weight = 0.5 * kept;
            direction = reflected;
        }
        sink_.remainder(weighted(weight, tau));
    }

    void trace_scalar(Vec3 at, Vec3 direction, int facet) {
        const Vec3 n_in = -body_.normal(facet);
        const double q1 = std::clamp(glm::dot(direction, n_in), 0.0, 1.0);
        const FaceAmplitudes face = fresnel(1.0, band_.n, q1);
        push(facet, 'i');
        leaf(at, mirrored(direction, n_in), 0.5 * (std::norm(face.r_s) + std::norm(face.r_p)),
             tau_full_);
        double weight = 0.5 * (face.t_s * face.t_s + face.t_p * face.t_p);
        direction = refracted(direction, n_in, 1.0, q1, face.q2);
        NodeWeights tau = tau_full_;
        for (int event = 2; event <= limits_.depth; ++event) {
            if (largest(weight, tau) < limits_.cut_weight) {
                sink_.cut(weighted(weight, tau));
                return;
            }
            const BodyHit hit = body_.exit(at, direction);
            at = body_.on_facet(hit.facet, at + hit.distance * direction);
            absorb(weight, hit.distance, 1, 0, tau);
            const Vec3& n = body_.normal(hit.facet);
            const double q = band_.n * glm::dot(direction, n);
            const FaceAmplitudes out = fresnel(band_.n, 1.0, q);
            push(hit.facet, 'i');
            const double reflectance = 0.5 * (std::norm(out.r_s) + std::norm(out.r_p));
            if (!out.total) {
                leaf(at, refracted(direction, n, band_.n, q, out.q2), weight * (1 - reflectance),
                     tau);
                weight *= reflectance;
            }
            direction = mirrored(direction, n);
        }
        sink_.remainder(weighted(weight, tau));
    }

    void trace_crystal(const Vec3& at, const Vec3& direction, int facet) {
        const Vec3 n_in = -body_.normal(facet);
        const Vec3 K = direction - glm::dot(direction, n_in) * n_in;
        const CrystalEntry entry = enter_crystal(band_.uniaxial, 1.0, K, n_in);
        worst_imbalance_ = std::max(worst_imbalance_, entry.imbalance);
        push(facet, 'i');
        leaf(at, mirrored(direction, n_in), 0.5 * (entry.reflected[0] + entry.reflected[1]),
             tau_full_);
        for (int j = 0; j < 2; ++j) {
            const double weight = 0.5 * (entry.power[0][j] + entry.power[1][j]);
            if (!(weight > 0)) continue;
            trace_.length = 1;
            trace_.modes[0] = letter(entry.modes[j]);
            follow(at, entry.modes[j], weight, tau_full_, 2);
        }
    }

    static char letter(const CrystalMode& mode) {
        return mode.kind == ModeKind::ordinary ? 'o' : 'e';
    }

    void follow(Vec3 at, CrystalMode mode, double weight, NodeWeights tau, int event) {
        for (; event <= limits_.depth; ++event) {
            if (largest(weight, tau) < limits_.cut_weight) {
                sink_.cut(weighted(weight, tau));
                return;
            }
            const BodyHit found = body_.exit(at, mode.ray);
            at = body_.on_facet(found.facet, at + found.distance * mode.ray);
            if (band_.absorbs) {
                absorb(weight, found.distance, absorption_along(band_.uniaxial, mode, 1, 0),
                       absorption_along(band_.uniaxial, mode, 0, 1), tau);
            }
            const CrystalHit hit = hit_face(band_.uniaxial, 1.0, mode, body_.normal(found.facet));
            worst_imbalance_ = std::max(worst_imbalance_, hit.imbalance);
            push(found.facet, 'i');
            if (hit.transmitted > 0) leaf(at, hit.exit_direction, weight * hit.transmitted, tau);
            const std::array<double, 2> child{weight * hit.power[0], weight * hit.power[1]};
            const double sum = child[0] + child[1];
            if (!(sum > 0)) return;
            int next = child[0] >= child[1] ? 0 : 1;
            if (child[0] > 0 && child[1] > 0) {
                if (largest(sum, tau) < limits_.split_weight || ++splits_ > limits_.most_splits) {
                    next = uniform() * sum < child[0] ? 0 : 1;
                    weight = sum;
                } else {
                    const int other = 1 - next, length = trace_.length;
                    trace_.modes[length - 1] = letter(hit.modes[other]);
                    follow(at, hit.modes[other], child[other], tau, event + 1);
                    trace_.length = length;
                    weight = child[next];
                }
            } else {
                weight = sum;
            }
            trace_.modes[trace_.length - 1] = letter(hit.modes[next]);
            mode = hit.modes[next];
        }
        sink_.remainder(weighted(weight, tau));
    }

    void leaf(const Vec3& at, const Vec3& direction, double weight, const NodeWeights& tau) {
        if (weight > 0) sink_.leaf(at, direction, weighted(weight, tau), trace_);
    }

    // SplitMix64 (Steele, Lea & Flood 2014): a stream fixed by the seed.
    double uniform() {
        random_ += 0x9e3779b97f4a7c15ull;
        std::uint64_t z = random_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }

    const ConvexBody& body_;
    const Band& band_;
    PathLimits limits_;
    Sink& sink_;
    std::uint64_t random_;
    PathTrace trace_;
    int splits_ = 0;
    double worst_imbalance_ = 0;
    NodeWeights tau_full_{};
};

}  // namespace culet
