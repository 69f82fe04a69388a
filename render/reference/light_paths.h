#pragma once
// The exact light paths behind one eye ray in an isotropic, convex stone: a special case of
// crystal_paths.h. There is a single path, with an exit at every face. In a non-convex stone (Body:
// StoneBody) light that would meet the stone again after leaving counts as gone; the rest is exact.
//
// Paths are traced backwards from the eye. This is exact because a face's power fractions are the
// same when every wave vector is reversed: the eye emits an unpolarised ray, and the radiance seen
// is the sum over exits of weight x radiance from the exit direction. Radiance is "basic" (per
// normal flux and per squared tangential wave vector), so no factors of index squared or of solid
// angle arise. For every ray
//   exits + remainder + absorbed + cut = 1.
//
// A ground facet reflects and transmits by Lambert's law, as if each of its points showed all
// slopes: whatever meets it goes on unpolarised, in one random direction on either side. The means
// over many rays are exact for that surface, and the sum above holds for every ray.

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <type_traits>

#include "render/geometry/stone_body.h"
#include "render/optics/fresnel.h"
#include "render/optics/path.h"
#include "render/optics/random.h"
#include "render/scene/scene.h"
#include "render/setup/built_effects.h"
#include "stone/solid/perpendicular.h"

namespace culet {

// A Sink has
//   void path_exits(const Vec3& origin, const Vec3& direction, const NodeWeights&,
//                   const PathTrace&);
//   void remainder(const NodeWeights&), absorbed(const NodeWeights&), cut(const NodeWeights&);
// `single`: the band has one node, so no loops over nodes are needed.
template <class Sink, bool single = !k_has_effects, class Body = ConvexBody>
class LightPaths {
public:
    /// `trace`: storage for the path, and a guess from the last ray's path, which changes only the
    /// time. It must be new or come from the same body.
    LightPaths(const Body& body, const Band& band, const PathLimits& limits, Sink& sink,
               PathTrace& trace)
        : body_(body), band_(band), limits_(limits), sink_(sink), trace_(trace) {}
    LightPaths(const Body& body, const Band& band, const PathLimits& limits, Sink& sink)
        : body_(body),
          band_(band),
          limits_(limits),
          sink_(sink),
          own_(PathTrace{}),
          trace_(*own_) {}
    LightPaths(const LightPaths&) = delete;
    LightPaths& operator=(const LightPaths&) = delete;

    /// Follows an eye ray that enters the stone at `entry`.
    void trace(const EyeRay& ray, const BodyHit& entry) {
        trace_.length = 0;
        std::fill_n(tau_.begin(), nodes(), 1.0);
        const Vec3 at = body_.on_facet(entry.facet, ray.origin + entry.distance * ray.direction);
        // Template arguments remove unused effects from the loop.
        if (body_.has_ground()) {
            trace_polarised<true, true>(at, ray.direction, entry.facet);
        } else if (!k_has_effects) {
            trace_scalar<false>(at, ray.direction, entry.facet);
        } else if (limits_.polarised) {
            band_.absorbs ? trace_polarised<true>(at, ray.direction, entry.facet)
                          : trace_polarised<false>(at, ray.direction, entry.facet);
        } else {
            band_.absorbs ? trace_scalar<true>(at, ray.direction, entry.facet)
                          : trace_scalar<false>(at, ray.direction, entry.facet);
        }
    }

private:
    int nodes() const { return single ? 1 : band_.count; }
    NodeWeights weighted(double weight, const NodeWeights& tau) const {
        NodeWeights result;  // only the band's nodes are set
        for (int i = 0; i < nodes(); ++i) result[i] = weight * tau[i];
        return result;
    }
    bool too_small(double weight, const NodeWeights& tau) const {
        return limits_.cut_weight > 0 && largest(weight, tau) < limits_.cut_weight;
    }
    double largest(double weight, const NodeWeights& tau) const {
        double most = 0;
        for (int i = 0; i < nodes(); ++i) most = std::max(most, tau[i]);
        return weight * most;
    }
    // A convex body is given the last ray's facet as a guess, any other the facet where the ray
    // starts.
    BodyHit way_out(const Vec3& at, const Vec3& direction) const {
        constexpr bool convex = std::is_same_v<Body, ConvexBody>;
        return body_.exit(at, direction, trace_.facets[trace_.length - (convex ? 0 : 1)]);
    }
    void push(int facet) {
        trace_.facets[trace_.length] = facet;
        trace_.modes[trace_.length] = 'i';
        ++trace_.length;
    }

    // Absorbs along a segment (Beer-Lambert).
    void absorb(double weight, double length, NodeWeights& tau) {
        NodeWeights lost{};
        for (int i = 0; i < band_.count; ++i) {
            const double after = tau[i] * std::exp(-band_.absorption[0][i] * length);
            lost[i] = weight * (tau[i] - after);
            tau[i] = after;
        }
        sink_.absorbed(lost);
    }

    // Returns s of a face for a ray, of any length; with the ray's direction it gives p.
    static Vec3 tangent(const Vec3& direction, const Vec3& n) {
        const Vec3 s = glm::cross(direction, n);
        if (glm::dot(s, s) > 1e-28) return s;
        // At normal incidence all directions are equivalent (r_p = -r_s): any tangent serves.
        return perpendicular_to(n);
    }

    static Vec3 mirrored(const Vec3& direction, const Vec3& n) {
        const Vec3 v = direction - 2 * glm::dot(direction, n) * n;
        // One Newton step to unit length corrects a rounding error exactly.
        return (1.5 - 0.5 * glm::dot(v, v)) * v;
    }
    // `n` points to the side that the ray goes to; q1, q2 are along it.
    static Vec3 refracted(const Vec3& direction, const Vec3& n, double n1, double q1, double q2) {
        return glm::normalize(n1 * direction + (q2 - q1) * n);
    }

    // Power carried by a path for two orthogonal eye polarisations of power 1/2 each, as Stokes
    // parameters: sum and difference of s and p, and twice the real and imaginary part of E_s E_p*.
    // Each face rotates the frame (s, direction x s). No frame degenerates, and I is the weight.
    struct Carried {
        double I, Q, U, V;

        // Rotates from tangent s to s2, each of any length.
        void turn(const Vec3& direction, const Vec3& s, const Vec3& s2) {
            const double along = glm::dot(s, s2), across = glm::dot(glm::cross(direction, s), s2);
            const double scale = 1 / (along * along + across * across);
            const double cosine = (along * along - across * across) * scale,
                         sine = 2 * along * across * scale, was = Q;
            Q = cosine * was + sine * U;
            U = cosine * U - sine * was;
        }
        void reflect(const FaceAmplitudes& face) {
            const std::complex<double>&s = face.r_s, &p = face.r_p;
            if (!face.total) {
                const double Rs = s.real() * s.real(), Rp = p.real() * p.real(), was = I;
                I = 0.5 * ((Rs + Rp) * was + (Rs - Rp) * Q);
                Q = 0.5 * ((Rs - Rp) * was + (Rs + Rp) * Q);
            }
            // r_s r_p*, of modulus 1 in total reflection.
            const double re = s.real() * p.real() + s.imag() * p.imag(),
                         im = s.imag() * p.real() - s.real() * p.imag(), was = U;
            U = re * was - im * V;
            V = im * was + re * V;
        }
        double transmitted(const FaceAmplitudes& face) const {
            return 0.5 * (face.t_s * face.t_s * (I + Q) + face.t_p * face.t_p * (I - Q));
        }
    };

    // The first face: sends out its exit and refracts `direction` into the stone.
    FaceAmplitudes enter(const Vec3& at, Vec3& direction, int facet) {
        const Vec3 n_in = -body_.normal(facet);
        const double q1 = std::clamp(glm::dot(direction, n_in), 0.0, 1.0);
        const FaceAmplitudes face = fresnel(1.0, band_.n, q1);
        push(facet);
        path_exits(at, mirrored(direction, n_in), 0.5 * (std::norm(face.r_s) + std::norm(face.r_p)),
                   tau_);
        direction = refracted(direction, n_in, 1.0, q1, face.q2);
        return face;
    }

    // A direction on the side of `n`, by Lambert's law.
    static Vec3 scattered(const Vec3& n, Random& random) {
        const double part = random.uniform(), azimuth = 2 * std::numbers::pi * random.uniform();
        const Vec3 x = perpendicular_to(n), y = glm::cross(n, x);
        return glm::normalize(std::sqrt(part) * (std::cos(azimuth) * x + std::sin(azimuth) * y) +
                              std::sqrt(1 - part) * n);
    }

    // At a ground facet: sends `leaves` of the light out, and leaves the rest inside.
    void scatter(const Vec3& at, int facet, double leaves, Random& random, Carried& carried,
                 Vec3& direction, Vec3& s) {
        const Vec3& n = body_.normal(facet);
        push(facet);
        path_exits(at, scattered(n, random), carried.I * leaves, tau_);
        carried = {carried.I * (1 - leaves), 0, 0, 0};
        direction = scattered(-n, random);
        s = perpendicular_to(direction);
    }

    template <bool absorbs, bool ground = false>
    void trace_polarised(Vec3 at, Vec3 direction, int facet) {
        Random random(limits_.seed);
        const double outside = ground ? diffuse_reflectance(band_.n) : 0;
        Vec3 s = tangent(direction, -body_.normal(facet));
        Carried carried{1, 0, 0, 0};
        if (ground && body_.ground(facet)) {
            scatter(at, facet, outside, random, carried, direction, s);
        } else {
            const FaceAmplitudes face = enter(at, direction, facet);
            const double Ts = face.t_s * face.t_s, Tp = face.t_p * face.t_p;
            carried = {0.5 * (Ts + Tp), 0.5 * (Ts - Tp), 0, 0};
        }
        NodeWeights& tau = tau_;
        for (int event = 2; event <= limits_.depth; ++event) {
            if (too_small(carried.I, tau)) {
                sink_.cut(weighted(carried.I, tau));
                return;
            }
            const BodyHit hit = way_out(at, direction);
            at = body_.on_facet(hit.facet, at + hit.distance * direction);
            if constexpr (absorbs) absorb(carried.I, hit.distance, tau);
            if (ground && body_.ground(hit.facet)) {
                scatter(at, hit.facet, (1 - outside) / (band_.n * band_.n), random, carried,
                        direction, s);
                continue;
            }
            if (ground && !limits_.polarised) carried.Q = carried.U = carried.V = 0;
            const Vec3& n = body_.normal(hit.facet);
            const double q = band_.n * glm::dot(direction, n);
            const FaceAmplitudes out = fresnel(band_.n, 1.0, q);
            const Vec3 s2 = tangent(direction, n);
            carried.turn(direction, s, s2);
            push(hit.facet);
            if (!out.total) {
                path_exits(at, refracted(direction, n, band_.n, q, out.q2),
                           carried.transmitted(out), tau);
            }
            carried.reflect(out);
            direction = mirrored(direction, n);
            s = s2;
        }
        sink_.remainder(weighted(carried.I, tau));
    }

    template <bool absorbs>
    void trace_scalar(Vec3 at, Vec3 direction, int facet) {
        const FaceAmplitudes face = enter(at, direction, facet);
        double weight = 0.5 * (face.t_s * face.t_s + face.t_p * face.t_p);
        NodeWeights& tau = tau_;
        for (int event = 2; event <= limits_.depth; ++event) {
            if (too_small(weight, tau)) {
                sink_.cut(weighted(weight, tau));
                return;
            }
            const BodyHit hit = way_out(at, direction);
            at = body_.on_facet(hit.facet, at + hit.distance * direction);
            if constexpr (absorbs) absorb(weight, hit.distance, tau);
            const Vec3& n = body_.normal(hit.facet);
            const double q = band_.n * glm::dot(direction, n);
            const FaceReflection out = mean_reflection(band_.n, 1.0, q);
            push(hit.facet);
            if (!out.total) {
                path_exits(at, refracted(direction, n, band_.n, q, out.q2), weight * (1 - out.mean),
                           tau);
                weight *= out.mean;
            }
            direction = mirrored(direction, n);
        }
        sink_.remainder(weighted(weight, tau));
    }

    void path_exits(const Vec3& at, const Vec3& direction, double weight, const NodeWeights& tau) {
        if (weight > 0) sink_.path_exits(at, direction, weighted(weight, tau), trace_);
    }

    const Body& body_;
    const Band& band_;
    PathLimits limits_;
    Sink& sink_;
    std::optional<PathTrace> own_;
    PathTrace& trace_;
    NodeWeights tau_;  // transmission so far, after absorption
};

}  // namespace culet
