#pragma once
// The exact light paths behind one eye ray in an isotropic, convex stone: crystal_paths.h without
// what such a stone cannot do. There is one path, which sends a leaf out at every face.
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
#include <glm/geometric.hpp>

#include "render/convex_body.h"
#include "render/fresnel.h"
#include "render/path.h"
#include "render/scene.h"
#include "stone/perpendicular.h"

namespace culet {

// A Sink has
//   void leaf(const Vec3& origin, const Vec3& direction, const NodeWeights&, const PathTrace&);
//   void remainder(const NodeWeights&), absorbed(const NodeWeights&), cut(const NodeWeights&);
template <class Sink>
class LightPaths {
public:
    LightPaths(const ConvexBody& body, const Band& band, const PathLimits& limits, Sink& sink)
        : body_(body), band_(band), limits_(limits), sink_(sink) {}

    /// Follows an eye ray that enters the stone at `entry`.
    void trace(const EyeRay& ray, const BodyHit& entry) {
        trace_.length = 0;
        tau_full_.fill(1.0);
        const Vec3 at = body_.on_facet(entry.facet, ray.origin + entry.distance * ray.direction);
        if (limits_.polarised) {
            trace_polarised(at, ray.direction, entry.facet);
        } else {
            trace_scalar(at, ray.direction, entry.facet);
        }
    }

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
    void push(int facet) {
        trace_.facets[trace_.length] = facet;
        trace_.modes[trace_.length] = 'i';
        ++trace_.length;
    }

    // Beer and Lambert along a segment.
    void absorb(double weight, double length, NodeWeights& tau) {
        if (!band_.absorbs) return;
        NodeWeights lost{};
        for (int i = 0; i < band_.count; ++i) {
            const double after = tau[i] * std::exp(-band_.absorption[0][i] * length);
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
        push(facet);
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
            absorb(weight, hit.distance, tau);
            const Vec3& n = body_.normal(hit.facet);
            const FaceAmplitudes out = fresnel(band_.n, 1.0, band_.n * glm::dot(direction, n));
            const Vec3 s2 = tangent(direction, n), p2 = glm::cross(direction, s2);
            const Vec3 reflected = mirrored(direction, n), p_reflected = glm::cross(reflected, s2);
            push(hit.facet);
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
        push(facet);
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
            absorb(weight, hit.distance, tau);
            const Vec3& n = body_.normal(hit.facet);
            const double q = band_.n * glm::dot(direction, n);
            const FaceAmplitudes out = fresnel(band_.n, 1.0, q);
            push(hit.facet);
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

    void leaf(const Vec3& at, const Vec3& direction, double weight, const NodeWeights& tau) {
        if (weight > 0) sink_.leaf(at, direction, weighted(weight, tau), trace_);
    }

    const ConvexBody& body_;
    const Band& band_;
    PathLimits limits_;
    Sink& sink_;
    PathTrace trace_;
    NodeWeights tau_full_{};
};

}  // namespace culet
