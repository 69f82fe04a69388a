#include "render/beams/beam_shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "render/band.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/beams/beam_shading.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include "render/beams/beam_shading_kernel.h"

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

// What reaches the eye of a path's end: its weight at each node, and where light's polarisation
// counts (one node then) the rest of the Stokes parameters, along u and v.
struct PathWeight {
    const V* weight;
    bool polarised = false;
    V Q, U;  // of weight I = weight[0]
    V3 direction, u, v;
};

// Adds light to the nodes' sums; without `kMany` there is one node, and no absorption.
template <bool kMany>
struct Gather {
    const ShadedLights& lights;
    V* sum;
    const PathWeight& path;

    HWY_INLINE int nodes() const { return kMany ? lights.nodes : 1; }

    // Of light that is polarised, more or less of the path's weight comes through.
    HWY_INLINE V weight(int node, const ShadedLights::Polarised& light) const {
        const V I = path.weight[node];
        if (!kMany || !path.polarised || light.degree == 0) return I;
        V3 along = vector(light.along);
        if (light.sheet) {
            V3 normal = vector(light.normal);
            const V sign = hn::CopySign(number(1.0f), dot(normal, path.direction));
            normal = sign * normal;
            // Turned with the normal into the ray, to which it is perpendicular then.
            const V cosine = dot(normal, path.direction);
            along = plus(along, hn::Neg(dot(along, path.direction)) / (number(1.0f) + cosine),
                         normal + path.direction);
        }
        const V a = dot(along, path.u), b = dot(along, path.v);
        const V square = hn::Max(hn::MulAdd(a, a, b * b), number(1e-30f));
        const V Q = (a * a - b * b) / square, U = number(2.0f) * a * b / square;
        return hn::MulAdd(number(light.degree), hn::MulAdd(path.Q, Q, path.U * U), I);
    }

    HWY_INLINE void operator()(const V& factor, const float* radiance,
                               const ShadedLights::Polarised& light) const {
        for (int i = 0; i < nodes(); ++i)
            sum[i] = hn::MulAdd(factor * weight(i, light), number(radiance[i]), sum[i]);
    }
    HWY_INLINE void colour(const V& r, const V& g, const V& b,
                           const ShadedLights::Polarised& light) const {
        const V more_red = r - g, more_blue = b - g;
        for (int i = 0; i < nodes(); ++i) {
            const auto at = static_cast<size_t>(i);
            const V seen = hn::MulAdd(more_red, number(lights.red[at]),
                                      hn::MulAdd(more_blue, number(lights.blue[at]), g));
            sum[i] = hn::MulAdd(weight(i, light), seen, sum[i]);
        }
    }
};

// What is carried from face to face: powers of s and p together, their difference, and twice the
// real and imaginary part of E_s E_p* (light_paths.h).
struct Carried {
    V I, Q, U, V_;

    // To a frame turned by half the angle of (cosine, sine).
    HWY_INLINE void turn(const V& cosine, const V& sine) {
        const V before = Q;
        Q = hn::MulAdd(cosine, before, sine * U);
        U = hn::NegMulAdd(sine, before, cosine * U);
    }
};

// Cosine and sine of twice an angle from a vector along and across.
struct DoubleAngle {
    V cosine, sine;
    HWY_INLINE DoubleAngle(const V& along, const V& across) {
        const V al = along * along, ac = across * across, length = al + ac;
        // Where there is no direction all serve.
        const M any = length > number(1e-24f);
        const V scale = number(1.0f) / hn::IfThenElse(any, length, number(1.0f));
        cosine = hn::IfThenElse(any, (al - ac) * scale, number(1.0f));
        sine = hn::IfThenElseZero(any, (along + along) * across * scale);
    }
};

// The picture's right, turned with the view's axis into a ray.
HWY_INLINE V3 eye_right(const ShadedEye& eye, const V3& direction) {
    const V3 forward = vector(eye.forward), right = vector(eye.right);
    return plus(right, hn::Neg(dot(right, direction)) / (number(1.0f) + dot(forward, direction)),
                forward + direction);
}

// kGeneral: polarised lights, what the eye responds to, merged crystals.
template <bool kPolarised, bool kSoft, bool kMany, bool kGeneral>
class Follower {
public:
    HWY_INLINE Follower(const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
                        int facet_count, const Fragments& out)
        : stone_(*job.stone),
          optics_(*job.optics),
          lights_(*job.lights),
          eye_(eye),
          facets_(facets),
          facet_count_(facet_count),
          out_(out) {}

    HWY_INLINE void follow(int first) {
        const V dx = hn::LoadU(k_floats, out_.x + first), dy = hn::LoadU(k_floats, out_.y + first);
        const int nodes = kMany ? lights_.nodes : 1;
        for (int i = 0; i < nodes; ++i) {
            sum_[i] = number(0.0f);
            tau_[i] = number(1.0f);
        }
        enter(dx, dy);
        const bool located =
            kMany ? true
                  : out_.follows != nullptr || !lights_.spheres.empty() || !lights_.planes.empty();
        V absorbed = number(0.0f);
        for (int k = 1; k < facet_count_; ++k) {
            const ShadedStone::Face& face = stone_.faces[facets_[k]];
            const V3 a{number(face.x), number(face.y), number(face.z)};
            const V cosine = dot(a, ray_.direction);
            if (located) {
                // Rays beside the beam need not meet its facets: they go no farther than a ray in the
                // stone can.
                const V towards = hn::Max(cosine, number(1e-4f));
                const V farthest = number(stone_.size);
                const V length = hn::Min(
                    hn::Max((number(face.offset) - dot(a, ray_.point)) / towards, hn::Neg(farthest)),
                    farthest);
                ray_.point = plus(ray_.point, length, ray_.direction);
                if constexpr (kSoft) {
                    move(ray_.point_x, ray_.direction_x, length, a, towards);
                    move(ray_.point_y, ray_.direction_y, length, a, towards);
                }
                if constexpr (kMany) absorb(length, absorbed);
                if constexpr (kGeneral) {
                    if (optics_.crystal) go_through(*optics_.crystal, length, k, absorbed);
                }
                if (out_.follows != nullptr)
                    follows_ = hn::And(follows_, hn::And(cosine > number(0.0f), on_facet(face)));
            }
            if constexpr (kPolarised) turn(a, cosine, k);
            meet(a, cosine);
        }
        for (int i = 0; i < nodes; ++i)
            hn::StoreU(
                sum_[i] * uncovered_ + before_[i], k_floats,
                out_.radiance + static_cast<size_t>(i) * static_cast<size_t>(out_.stride) + first);
        hn::StoreU(remaining() * uncovered_, k_floats, out_.left + first);
        if (out_.absorbed != nullptr)
            hn::StoreU(absorbed * uncovered_, k_floats, out_.absorbed + first);
        if (out_.follows != nullptr) {
            const size_t lanes = hn::Lanes(k_floats);
            HWY_ALIGN float yes[64];
            hn::Store(hn::IfThenElseZero(follows_, number(1.0f)), k_floats, yes);
            for (size_t i = 0; i < lanes; ++i)
                out_.follows[static_cast<size_t>(first) + i] = yes[i] > 0;
        }
    }

private:
    HWY_INLINE V remaining() const {
        if constexpr (!kMany) {
            return carried_.I;
        } else {
            V mean = number(0.0f);
            for (int i = 0; i < lights_.nodes; ++i) mean = mean + tau_[i];
            return carried_.I * mean / number(static_cast<float>(lights_.nodes));
        }
    }

    HWY_INLINE M on_facet(const ShadedStone::Face& face) const {
        const ShadedStone::Side* side = stone_.sides.data() + face.first_side;
        V most = number(-1.0f);
        for (std::uint32_t i = 0; i < face.sides; ++i, ++side) {
            const V3 across{number(side->x), number(side->y), number(side->z)};
            most = hn::Max(most, dot(across, ray_.point) - number(side->offset));
        }
        return most <= number(0.0f);
    }

    // The next point's change: it stays in the plane.
    HWY_INLINE static void move(V3& point, const V3& direction_change, const V& length, const V3& a,
                                const V& towards, const V3& along) {
        const V3 moved = plus(point, length, direction_change);
        point = plus(moved, hn::Neg(dot(a, moved)) / towards, along);
    }
    HWY_INLINE void move(V3& point, const V3& direction_change, const V& length, const V3& a,
                         const V& towards) {
        move(point, direction_change, length, a, towards, ray_.direction);
    }

    HWY_INLINE void absorb(const V& length, V& absorbed) {
        if (optics_.absorption.empty()) return;
        V lost = number(0.0f);
        for (int i = 0; i < lights_.nodes; ++i) {
            const V after =
                tau_[i] *
                hn::Exp(k_floats, hn::Neg(number(optics_.absorption[static_cast<size_t>(i)])) *
                                      hn::Max(length, number(0.0f)));
            lost = lost + tau_[i] - after;
            tau_[i] = after;
        }
        absorbed =
            hn::MulAdd(carried_.I / number(static_cast<float>(lights_.nodes)), lost, absorbed);
    }

    // Light at the end of a path of weight `weight`; `end` has what else is known of it.
    HWY_INLINE void leaf(const V& weight, const Ray& out, PathWeight& end) {
        if constexpr (kMany) {
            V weights[k_band_nodes];
            for (int i = 0; i < lights_.nodes; ++i) weights[i] = weight * tau_[i];
            if (end.polarised) {
                end.Q = end.Q * tau_[0];
                end.U = end.U * tau_[0];
            }
            end.weight = weights;
            Gather<kMany> gather{lights_, sum_, end};
            all_light<kSoft>(lights_, out, gather);
        } else {
            end.weight = &weight;
            Gather<kMany> gather{lights_, sum_, end};
            all_light<kSoft>(lights_, out, gather);
        }
    }

    // Q and U of what leaves through a face, with the tangent `s` of any length.
    HWY_INLINE void polarise(PathWeight& end, const V& Q, const V& U, const V3& direction,
                             const V3& s) const {
        end.polarised = true;
        end.Q = Q;
        end.U = U;
        end.direction = direction;
        const V square = dot(s, s);
        const M any = square > number(1e-24f);
        const V scale = number(1.0f) / hn::Sqrt(hn::IfThenElse(any, square, number(1.0f)));
        end.u = scale * s;
        end.v = cross(direction, end.u);
    }

    // A segment of a crystal whose waves are merged: absorption of each, and what is left of their
    // coherence.
    HWY_INLINE void go_through(const MergedCrystal& crystal, const V& length, int k, V& absorbed) {
        const V3& d = ray_.direction;
        const ShadedStone::Face& was = stone_.faces[facets_[k - 1]];
        const V3 b{number(was.x), number(was.y), number(was.z)};
        const V one = number(1.0f), half = number(0.5f), zero = number(0.0f);
        V along[2], across[2], cosine[2];
        for (int i = 0; i < 2; ++i) {
            const V3 axis = vector(crystal.optic_axis[i]);
            cosine[i] = dot(axis, d);
            along[i] = dot(b, axis) - cosine[i] * dot(d, b);
            across[i] = dot(d, cross(b, axis));
        }
        // Twice the bisector's angle is the sum of the two planes' angles.
        V c = along[0] * along[1] - across[0] * across[1],
          s = along[0] * across[1] + across[0] * along[1];
        const V size = hn::Sqrt(hn::MulAdd(c, c, s * s));
        const M any = size > number(1e-20f);
        const V scale = one / hn::IfThenElse(any, size, one);
        c = hn::IfThenElse(any, c * scale, one);
        s = hn::IfThenElseZero(any, s * scale);
        carried_.turn(c, s);

        // The waves' directions of vibration: the bisector, and across it.
        V3 tangent = cross(d, b);
        const V squared = dot(tangent, tangent);
        const M oblique = squared > number(1e-20f);
        // Normal incidence: the tangent is that which the angles above are from, any.
        tangent = hn::AllTrue(k_floats, oblique) ? tangent : any_tangent(tangent, d, oblique);
        tangent = (one / length_of(tangent)) * tangent;
        const V3 beside = cross(d, tangent);
        const V cosine1 = hn::Sqrt(hn::Max(half * (one + c), zero));
        const V sine1 = hn::CopySign(hn::Sqrt(hn::Max(half * (one - c), zero)), s);
        const V3 first = cosine1 * tangent + sine1 * beside;
        const V3 second = cosine1 * beside + hn::Neg(sine1) * tangent;
        V alpha1 = zero, alpha2 = zero;
        for (int i = 0; i < 3; ++i) {
            const V3 axis = vector(crystal.principal[i]);
            const V p = dot(first, axis), q = dot(second, axis), K = number(crystal.absorption[i]);
            alpha1 = hn::MulAdd(K * p, p, alpha1);
            alpha2 = hn::MulAdd(K * q, q, alpha2);
        }
        const V way = hn::Max(length, zero);
        const V kept1 = hn::Exp(k_floats, hn::Neg(half * alpha1 * way)),
                kept2 = hn::Exp(k_floats, hn::Neg(half * alpha2 * way));
        const V power1 = half * (carried_.I + carried_.Q) * kept1 * kept1,
                power2 = half * (carried_.I - carried_.Q) * kept2 * kept2;
        absorbed = absorbed + carried_.I - power1 - power2;
        carried_.I = power1 + power2;
        carried_.Q = power1 - power2;
        if (crystal.waves_per_length == 0) {
            carried_.U = carried_.V_ = zero;
        } else {
            // 1/n^2 of the two waves; psi are the angles to the optic axes.
            const V sines = hn::Sqrt(
                hn::Max((one - cosine[0] * cosine[0]) * (one - cosine[1] * cosine[1]), zero));
            const V cosines = cosine[0] * cosine[1];
            const V mean = number(crystal.inverse_square[0]),
                    spread = number(crystal.inverse_square[1]);
            const V fast = hn::MulAdd(spread, cosines + sines, mean),
                    slow = hn::MulAdd(spread, cosines - sines, mean);
            // n_slow - n_fast without a difference of near equals.
            const V root_fast = hn::Sqrt(fast), root_slow = hn::Sqrt(slow);
            const V split =
                number(2.0f) * spread * sines / (root_fast * root_slow * (root_fast + root_slow));
            const V retardation = split * way;
            const V turns = retardation * number(crystal.waves_per_length);
            const V phase = number(6.28318530718f) * (turns - hn::Round(turns));
            const V over =
                number(3.14159265359f) * retardation * number(crystal.coherence_per_length);
            const V sinc = hn::IfThenElse(
                over > number(1e-3f), hn::Sin(k_floats, over) / hn::Max(over, number(1e-3f)), one);
            const V left =
                hn::IfThenElseZero(over < number(3.14159265f), sinc * sinc) * kept1 * kept2;
            const V cos_phase = hn::Cos(k_floats, phase), sin_phase = hn::Sin(k_floats, phase);
            const V U = carried_.U * left, W = carried_.V_ * left;
            // E_first E_second*: the second wave, the slow one, is ahead in phase.
            carried_.U = hn::MulAdd(cos_phase, U, sin_phase * W);
            carried_.V_ = hn::NegMulAdd(sin_phase, U, cos_phase * W);
        }
        carried_.turn(c, hn::Neg(s));
    }
    HWY_INLINE V3 any_tangent(const V3& tangent, const V3& d, const M& oblique) const {
        // Across the ray and the axis that it is least along.
        const V ax = hn::Abs(d.x), ay = hn::Abs(d.y), az = hn::Abs(d.z), zero = number(0.0f);
        const M x = hn::And(ax <= ay, ax <= az), y = hn::And(hn::Not(x), ay <= az);
        const V3 other{hn::IfThenElse(x, zero, hn::IfThenElse(y, d.z, hn::Neg(d.y))),
                       hn::IfThenElse(x, hn::Neg(d.z), hn::IfThenElse(y, zero, d.x)),
                       hn::IfThenElse(x, d.y, hn::IfThenElse(y, hn::Neg(d.x), zero))};
        return {hn::IfThenElse(oblique, tangent.x, other.x),
                hn::IfThenElse(oblique, tangent.y, other.y),
                hn::IfThenElse(oblique, tangent.z, other.z)};
    }

    // The eye ray through a pixel, to the first face and through it.
    HWY_INLINE void enter(const V& dx, const V& dy) {
        const ShadedStone::Face& face = stone_.faces[facets_[0]];
        const V3 N{number(face.x), number(face.y), number(face.z)};
        const V3 vx = vector(eye_.direction_x), vy = vector(eye_.direction_y);
        const V3 gx = vector(eye_.point_x), gy = vector(eye_.point_y);
        const V3 v = plus(plus(vector(eye_.direction), dx, vx), dy, vy);
        const V3 shift = dx * gx + dy * gy;
        const V towards = hn::Min(dot(N, v), number(-1e-20f));
        const V later = hn::Neg(dot(N, shift)) / towards;
        ray_.point = plus(vector(eye_.point) + shift, later, v);
        const V length = hn::Sqrt(dot(v, v)), over = number(1.0f) / length;
        const V3 along = over * v;
        const V q1 = hn::Min(hn::Neg(towards) * over, number(1.0f));
        const float n = optics_.n;
        const V q2 = hn::Sqrt(hn::MulAdd(q1, q1, number((n - 1) * (n + 1))));
        const V bend = q1 - q2, over_n = number(1.0f / n);
        ray_.direction = over_n * plus(along, bend, N);
        follows_ = hn::And(towards < number(0.0f), on_facet(face));

        Ray mirrored{ray_.point, plus(along, q1 + q1, N), ray_.point, ray_.point, N, N};
        if constexpr (kSoft) {
            const auto change = [&](const V3& g, const V3& dv, V3& point, V3& inside,
                                    V3& outside) HWY_ATTR {
                const V3 moved = plus(g, later, dv);
                point = plus(moved, hn::Neg(dot(N, moved)) / towards, v);
                const V3 turned = over * plus(dv, hn::Neg(dot(along, dv)), along);
                const V dq1 = hn::Neg(dot(N, turned)), dq2 = q1 * dq1 / q2;
                inside = over_n * plus(turned, dq1 - dq2, N);
                outside = plus(turned, dq1 + dq1, N);
            };
            change(gx, vx, ray_.point_x, ray_.direction_x, mirrored.direction_x);
            change(gy, vy, ray_.point_y, ray_.direction_y, mirrored.direction_y);
            mirrored.point_x = ray_.point_x;
            mirrored.point_y = ray_.point_y;
        }

        // What stands before the stone.
        uncovered_ = number(1.0f);
        const int nodes = kMany ? lights_.nodes : 1;
        for (int i = 0; i < nodes; ++i) before_[i] = number(0.0f);
        if (!lights_.spheres.empty() || !lights_.planes.empty()) {
            const V distance = (number(eye_.distance) + later) * length;
            Ray from_eye{plus(ray_.point, hn::Neg(distance), along), along, gx, gy, vx, vy};
            if constexpr (kSoft) {
                from_eye.point_x = vector(eye_.origin_x);
                from_eye.point_y = vector(eye_.origin_y);
                from_eye.direction_x = over * plus(vx, hn::Neg(dot(along, vx)), along);
                from_eye.direction_y = over * plus(vy, hn::Neg(dot(along, vy)), along);
            }
            V one[k_band_nodes];
            for (int i = 0; i < nodes; ++i) one[i] = number(1.0f);
            PathWeight direct{};
            direct.weight = one;
            if constexpr (kGeneral) respond(direct, along);
            if constexpr (kGeneral) {
                if (optics_.response) one[0] = number((*optics_.response)[0]);
            }
            Gather<kMany> gather{lights_, before_, direct};
            uncovered_ = near_light<kSoft>(lights_, from_eye, distance, gather);
        }

        const V e2 = number(n * n);
        const V r_s = bend / (q1 + q2), r_p = (e2 * q1 - q2) / (e2 * q1 + q2);
        const V R_s = r_s * r_s, R_p = r_p * r_p, half = number(0.5f), one = number(1.0f);
        const V R = half * (R_s + R_p), D = half * (R_s - R_p);
        PathWeight end{};
        if constexpr (kGeneral) {
            // Stokes parameters of what the eye responds to, in the face's frame.
            carried_ = {one, number(0.0f), number(0.0f), number(0.0f)};
            const V3 s = cross(along, N);
            if (optics_.response) {
                const auto& row = *optics_.response;
                // The picture's y is the other way round: right x ray, not ray x right.
                carried_ = {number(row[0]), number(row[1]), number(-row[2]), number(row[3])};
                const V3 right = eye_right(eye_, along);
                const DoubleAngle turned(dot(right, s), dot(cross(along, right), s));
                carried_.turn(turned.cosine, turned.sine);
            }
            const Carried was = carried_;
            polarise(end, hn::MulAdd(D, was.I, R * was.Q), r_s * r_p * was.U, mirrored.direction,
                     tangent_or_any(s, along));
            leaf(hn::MulAdd(R, was.I, D * was.Q), mirrored, end);
            // t_s t_p, from the powers.
            const V both = hn::Sqrt(hn::Max((one - R_s) * (one - R_p), number(0.0f)));
            carried_ = {hn::NegMulAdd(D, was.Q, (one - R) * was.I),
                        hn::NegMulAdd(D, was.I, (one - R) * was.Q), both * was.U, both * was.V_};
        } else {
            leaf(R, mirrored, end);
            carried_.I = one - R;
            carried_.Q = hn::Neg(D);
            carried_.U = number(0.0f);
            carried_.V_ = number(0.0f);
        }
        // Cosine of the ray with the face before, as `turn` wants it.
        cosine_before_ = hn::Neg(q2) * over_n;
    }

    HWY_INLINE V3 tangent_or_any(const V3& s, const V3& d) const {
        const M oblique = dot(s, s) > number(1e-20f);
        return hn::AllTrue(k_floats, oblique) ? s : any_tangent(s, d, oblique);
    }
    // A path straight to the eye.
    HWY_INLINE void respond(PathWeight& direct, const V3& along) const {
        direct.polarised = true;
        direct.Q = direct.U = number(0.0f);
        direct.direction = along;
        direct.u = eye_right(eye_, along);
        direct.v = cross(along, direct.u);
        if (optics_.response) {
            direct.Q = number((*optics_.response)[1]);
            direct.U = number(-(*optics_.response)[2]);
        }
    }

    // Into the tangent of the face with normal a, from that of the face before with normal b: the
    // tangents are d x b and d x a.
    HWY_INLINE void turn(const V3& a, const V& cosine, int k) {
        const ShadedStone::Face &now = stone_.faces[facets_[k]],
                                &was = stone_.faces[facets_[k - 1]];
        const float ab = now.x * was.x + now.y * was.y + now.z * was.z;
        const V3 cross_ab{number(was.y * now.z - was.z * now.y),
                          number(was.z * now.x - was.x * now.z),
                          number(was.x * now.y - was.y * now.x)};
        (void)a;
        const DoubleAngle angle(number(ab) - cosine * cosine_before_,
                                dot(ray_.direction, cross_ab));
        carried_.turn(angle.cosine, angle.sine);
    }

    HWY_INLINE void meet(const V3& a, const V& cosine) {
        const float n = optics_.n;
        const V e = number(n * n), one = number(1.0f), half = number(0.5f), zero = number(0.0f);
        const V q1 = number(n) * hn::Max(cosine, zero);
        const V q2_squared = hn::MulAdd(q1, q1, number(-(n - 1) * (n + 1)));
        const M out = q2_squared > zero;
        V R_s = one, R_p = one, re = one, im = zero;
        const bool any_out = !hn::AllFalse(k_floats, out);
        if (any_out) {
            const V q2 = hn::Sqrt(hn::Max(q2_squared, zero));
            const V r_s = (q1 - q2) / (q1 + q2), r_p = (q1 - e * q2) / hn::MulAdd(e, q2, q1);
            R_s = hn::IfThenElse(out, r_s * r_s, one);
            R_p = hn::IfThenElse(out, r_p * r_p, one);
            re = hn::IfThenElse(out, r_s * r_p, one);
            Ray leaving{ray_.point,       plus(number(n) * ray_.direction, q2 - q1, a),
                        ray_.point_x,     ray_.point_y,
                        ray_.direction_x, ray_.direction_y};
            if constexpr (kSoft) {
                const V slope = q1 / hn::Max(q2, number(1e-6f));
                const auto change = [&](const V3& inside) HWY_ATTR {
                    const V3 turned = number(n) * inside;
                    const V dq1 = dot(a, turned);
                    return plus(turned, dq1 * slope - dq1, a);
                };
                leaving.direction_x = change(ray_.direction_x);
                leaving.direction_y = change(ray_.direction_y);
            }
            V weight = (one - half * (R_s + R_p)) * carried_.I;
            if constexpr (kPolarised) weight = weight + half * (R_p - R_s) * carried_.Q;
            PathWeight end{};
            if constexpr (kGeneral) {
                const V T = one - half * (R_s + R_p), D = half * (R_p - R_s);
                const V both = hn::Sqrt(hn::Max((one - R_s) * (one - R_p), zero));
                polarise(end, hn::IfThenElseZero(out, hn::MulAdd(D, carried_.I, T * carried_.Q)),
                         hn::IfThenElseZero(out, both * carried_.U), leaving.direction,
                         tangent_or_any(cross(ray_.direction, a), leaving.direction));
            }
            leaf(hn::IfThenElseZero(out, weight), leaving, end);
        }
        if constexpr (kPolarised) {
            if (!hn::AllTrue(k_floats, out)) {
                // r_s r_p* of total reflection: twice the angle of A + i B.
                const V kappa = hn::Sqrt(hn::Max(hn::Neg(q2_squared), zero));
                const V A = hn::MulAdd(e * kappa, kappa, q1 * q1),
                        B = number((n - 1) * (n + 1)) * kappa * q1;
                const V AA = A * A, BB = B * B, scale = one / hn::Max(AA + BB, number(1e-30f));
                re = hn::IfThenElse(out, re, (AA - BB) * scale);
                im = hn::IfThenElse(out, zero, (A + A) * B * scale);
            }
            if (any_out) {
                const V sum = half * (R_s + R_p), difference = half * (R_s - R_p), I = carried_.I;
                carried_.I = hn::MulAdd(sum, I, difference * carried_.Q);
                carried_.Q = hn::MulAdd(difference, I, sum * carried_.Q);
            }
            const V U = carried_.U;
            carried_.U = hn::MulSub(re, U, im * carried_.V_);
            carried_.V_ = hn::MulAdd(im, U, re * carried_.V_);
        } else {
            carried_.I = carried_.I * half * (R_s + R_p);
        }
        const V twice = hn::Neg(cosine + cosine);
        ray_.direction = plus(ray_.direction, twice, a);
        if constexpr (kSoft) {
            const auto mirror = [&](const V3& change) HWY_ATTR {
                const V c = dot(a, change);
                return plus(change, hn::Neg(c + c), a);
            };
            ray_.direction_x = mirror(ray_.direction_x);
            ray_.direction_y = mirror(ray_.direction_y);
        }
        cosine_before_ = hn::Neg(cosine);
    }

    const ShadedStone& stone_;
    const ShadedOptics& optics_;
    const ShadedLights& lights_;
    const ShadedEye& eye_;
    const std::uint16_t* facets_;
    int facet_count_;
    const Fragments& out_;
    Ray ray_;
    Carried carried_;
    V cosine_before_, uncovered_;
    M follows_;
    V sum_[kMany ? k_band_nodes : 1], tau_[kMany ? k_band_nodes : 1],
        before_[kMany ? k_band_nodes : 1];
};

template <bool kPolarised, bool kSoft, bool kMany, bool kGeneral>
void follow_all(const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
                int facet_count, const Fragments& fragments) {
    Follower<kPolarised, kSoft, kMany, kGeneral> follower(job, eye, facets, facet_count, fragments);
    const int lanes = static_cast<int>(hn::Lanes(k_floats));
    for (int i = 0; i < fragments.count; i += lanes) follower.follow(i);
}

void ShadeBeam(const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
               int facet_count, const Fragments& fragments) {
    using Follow =
        void (*)(const ShadingJob&, const ShadedEye&, const std::uint16_t*, int, const Fragments&);
    static constexpr Follow k_follow[8] = {
        follow_all<false, false, false, false>, follow_all<false, false, true, false>,
        follow_all<false, true, false, false>,  follow_all<false, true, true, false>,
        follow_all<true, false, false, false>,  follow_all<true, false, true, false>,
        follow_all<true, true, false, false>,   follow_all<true, true, true, false>};
    const bool many = job.lights->nodes > 1 || !job.optics->absorption.empty();
    const bool soft = fragments.soft && job.lights->any_edge;
    const bool general = job.optics->crystal || job.optics->response;
    const Follow follow =
        general ? (soft ? follow_all<true, true, true, true> : follow_all<true, false, true, true>)
                : k_follow[(job.optics->polarised ? 4 : 0) + (soft ? 2 : 0) + (many ? 1 : 0)];
    follow(job, eye, facets, facet_count, fragments);
}

template <bool kSoft>
void background(const ShadedLights& lights, const ShadedOptics& optics, const ShadedEye& eye,
                const Fragments& fragments) {
    const int lanes = static_cast<int>(hn::Lanes(k_floats));
    const V3 vx = vector(eye.direction_x), vy = vector(eye.direction_y);
    const V3 ox = vector(eye.origin_x), oy = vector(eye.origin_y);
    V sum[k_band_nodes], one[k_band_nodes];
    for (int i = 0; i < lights.nodes; ++i) one[i] = number(1.0f);
    PathWeight direct{};
    direct.weight = one;
    if (optics.response) {
        direct.polarised = true;
        one[0] = number((*optics.response)[0]);
        direct.Q = number((*optics.response)[1]);
        direct.U = number(-(*optics.response)[2]);
    }
    for (int first = 0; first < fragments.count; first += lanes) {
        const V dx = hn::LoadU(k_floats, fragments.x + first),
                dy = hn::LoadU(k_floats, fragments.y + first);
        const V3 v = plus(plus(vector(eye.direction), dx, vx), dy, vy);
        const V over = number(1.0f) / hn::Sqrt(dot(v, v));
        const V3 along = over * v;
        const V3 from = plus(plus(vector(eye.point), dx, ox), dy, oy);
        Ray ray{from, along, ox, oy, vx, vy};
        if constexpr (kSoft) {
            ray.direction_x = over * plus(vx, hn::Neg(dot(along, vx)), along);
            ray.direction_y = over * plus(vy, hn::Neg(dot(along, vy)), along);
        }
        if (direct.polarised) {
            direct.direction = along;
            direct.u = eye_right(eye, along);
            direct.v = cross(along, direct.u);
        }
        for (int i = 0; i < lights.nodes; ++i) sum[i] = number(0.0f);
        Gather<true> gather{lights, sum, direct};
        all_light<kSoft>(lights, ray, gather);
        for (int i = 0; i < lights.nodes; ++i)
            hn::StoreU(sum[i], k_floats,
                       fragments.radiance +
                           static_cast<size_t>(i) * static_cast<size_t>(fragments.stride) + first);
    }
}

template <bool kSoft>
void leaving(const ShadedLights& lights, const ShadedLeaving& beam, const Fragments& fragments) {
    const int lanes = static_cast<int>(hn::Lanes(k_floats));
    V sum[k_band_nodes], weights[k_band_nodes];
    const V zero = number(0.0f), one = number(1.0f);
    for (int first = 0; first < fragments.count; first += lanes) {
        const V dx = hn::LoadU(k_floats, fragments.x + first),
                dy = hn::LoadU(k_floats, fragments.y + first);
        const auto value = [&](const float* v) HWY_ATTR {
            return hn::MulAdd(dx, number(v[1]), hn::MulAdd(dy, number(v[2]), number(v[0])));
        };
        const auto vector_at = [&](const float v[3][3]) HWY_ATTR {
            return plus(plus(vector(v[0]), dx, vector(v[1])), dy, vector(v[2]));
        };
        const V3 along = vector_at(beam.direction);
        const V over = one / hn::Sqrt(dot(along, along));
        const V3 direction = over * along;
        Ray ray{vector_at(beam.point),     direction,
                vector(beam.point[1]),     vector(beam.point[2]),
                vector(beam.direction[1]), vector(beam.direction[2])};
        if constexpr (kSoft) {
            ray.direction_x =
                over * plus(ray.direction_x, hn::Neg(dot(direction, ray.direction_x)), direction);
            ray.direction_y =
                over * plus(ray.direction_y, hn::Neg(dot(direction, ray.direction_y)), direction);
        }
        const V weight = hn::Max(value(beam.weight), zero);
        for (int i = 0; i < lights.nodes; ++i) {
            weights[i] = weight * clamped_to_unit(value(beam.transmitted.data() + 3 * i));
            sum[i] = zero;
        }
        PathWeight path{};
        path.weight = weights;
        if (beam.polarised) {
            const V passed = clamped_to_unit(value(beam.transmitted.data()));
            const V3 s = vector_at(beam.s);
            const V3 across = plus(s, hn::Neg(dot(s, direction)), direction);
            path.polarised = true;
            path.Q = passed * value(beam.Q);
            path.U = passed * value(beam.U);
            path.direction = direction;
            path.u = (one / hn::Max(length_of(across), number(1e-20f))) * across;
            path.v = cross(direction, path.u);
        }
        Gather<true> gather{lights, sum, path};
        all_light<kSoft>(lights, ray, gather);
        for (int i = 0; i < lights.nodes; ++i)
            hn::StoreU(sum[i], k_floats,
                       fragments.radiance +
                           static_cast<size_t>(i) * static_cast<size_t>(fragments.stride) + first);
    }
}

void ShadeLeaving(const ShadedLights& lights, const ShadedLeaving& beam,
                  const Fragments& fragments) {
    if (fragments.soft && lights.any_edge) {
        leaving<true>(lights, beam, fragments);
    } else {
        leaving<false>(lights, beam, fragments);
    }
}

void ShadeBackground(const ShadedLights& lights, const ShadedOptics& optics, const ShadedEye& eye,
                     const Fragments& fragments) {
    if (fragments.soft && lights.any_edge) {
        background<true>(lights, optics, eye, fragments);
    } else {
        background<false>(lights, optics, eye, fragments);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace culet {

HWY_EXPORT(ShadeBeam);
HWY_EXPORT(ShadeBackground);
HWY_EXPORT(ShadeLeaving);

void shade_beam(const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
                int facet_count, const Fragments& fragments) {
    HWY_DYNAMIC_DISPATCH(ShadeBeam)(job, eye, facets, facet_count, fragments);
}

void shade_background(const ShadedLights& lights, const ShadedOptics& optics, const ShadedEye& eye,
                      const Fragments& fragments) {
    HWY_DYNAMIC_DISPATCH(ShadeBackground)(lights, optics, eye, fragments);
}

void shade_leaving(const ShadedLights& lights, const ShadedLeaving& beam,
                   const Fragments& fragments) {
    HWY_DYNAMIC_DISPATCH(ShadeLeaving)(lights, beam, fragments);
}

std::vector<std::string> shading_targets() {
    std::vector<std::string> names;
    for (std::int64_t target : hwy::SupportedAndGeneratedTargets())
        names.emplace_back(hwy::TargetName(target));
    return names;
}

bool use_shading_target(const std::string& name) {
    hwy::SetSupportedTargetsForTest(0);
    for (std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (name != hwy::TargetName(target)) continue;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        return true;
    }
    return false;
}

ShadedStone::ShadedStone(const FacetNet& net) : size(static_cast<float>(net.size())) {
    Vec3 low(1e300), high(-1e300);
    for (const Vec3& corner : net.corners()) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    middle = 0.5 * (low + high);
    const auto number_of = [](double v) { return static_cast<float>(v); };
    for (int f = 0; f < net.facets(); ++f) {
        const Plane& plane = net.plane(f);
        const Vec3& n = plane.normal;
        const auto& edges = net.edges(f);
        faces.push_back({number_of(n.x), number_of(n.y), number_of(n.z),
                         number_of(plane.offset - glm::dot(n, middle)),
                         static_cast<std::uint32_t>(sides.size()),
                         static_cast<std::uint32_t>(edges.size())});
        for (const NetEdge& edge : edges) {
            const Vec3 from = net.corners()[static_cast<std::size_t>(edge.from)] - middle,
                       to = net.corners()[static_cast<std::size_t>(edge.to)] - middle;
            const Vec3 across = glm::normalize(glm::cross(to - from, n));
            sides.push_back({number_of(across.x), number_of(across.y), number_of(across.z),
                             number_of(0.5 * glm::dot(across, from + to))});
        }
    }
}

ShadedEye shaded_eye(const ScreenView& view, const ScreenPoint& at, const Plane& front,
                     const Vec3& middle) {
    const Vec3 origin = view.origin(at), v = view.towards(at);
    const double length = glm::length(v);
    const Vec3 direction = v / length;
    const double distance = -height_above(front, origin) / glm::dot(front.normal, direction);
    ShadedEye eye;
    const auto store = [](const Vec3& from, float* to) {
        for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
    };
    store(origin + distance * direction - middle, eye.point);
    store(direction, eye.direction);
    store(view.vx / length, eye.direction_x);
    store(view.vy / length, eye.direction_y);
    store(view.forward, eye.forward);
    store(view.right, eye.right);
    store(view.ox, eye.origin_x);
    store(view.oy, eye.origin_y);
    store(view.ox + distance / length * view.vx, eye.point_x);
    store(view.oy + distance / length * view.vy, eye.point_y);
    eye.distance = static_cast<float>(distance);
    return eye;
}

ShadedEye shaded_eye(const ScreenView& view, const ScreenPoint& at, const Vec3& middle) {
    const Vec3 origin = view.origin(at), v = view.towards(at);
    return shaded_eye(view, at, Plane{-glm::normalize(v), -glm::dot(glm::normalize(v), origin)},
                      middle);
}

}  // namespace culet
#endif
