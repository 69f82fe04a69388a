#include "bench/plain_tracer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "render/beams/facet_net.h"
#include "render/beams/screen_view.h"
#include "stone/text/errors.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/plain_tracer.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h.
#include <hwy/highway.h>

#ifndef CULET_PLAIN_TRACER_PREPARED
#define CULET_PLAIN_TRACER_PREPARED
namespace culet {

// Single precision, relative to the stone's middle.
struct PlainTracer::Prepared {
    struct Face {
        float x, y, z, offset;
        std::uint32_t first, count;  ///< into `neighbours`
        bool front;                  ///< the eye is above it
    };
    struct Lobe {
        float x, y, z;
        int exponent;
        float radiance;
    };
    std::vector<Face> faces;
    std::vector<std::uint16_t> neighbours;
    std::vector<Lobe> lobes;
    float constant = 0, n = 1, radius = 0;             // radius of a sphere around the stone
    float origin[3], direction[3], right[3], down[3];  // direction: to the picture's corner
    int width = 0, height = 0, depth = 1;
};

}  // namespace culet
#endif

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Prepared = PlainTracer::Prepared;
using Floats = hn::ScalableTag<float>;
using V = hn::Vec<Floats>;
using M = hn::Mask<Floats>;
constexpr Floats k_floats;
constexpr int k_most_depth = 64;
constexpr float k_tiny = 1e-18f;  // products with lengths are still normal numbers

HWY_INLINE V number(float v) {
    return hn::Set(k_floats, v);
}
struct V3 {
    V x, y, z;
};
HWY_INLINE V dot(const V3& a, const V3& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, a.z * b.z));
}
HWY_INLINE V3 plus(const V3& a, const V& f, const V3& b) {
    return {hn::MulAdd(f, b.x, a.x), hn::MulAdd(f, b.y, a.y), hn::MulAdd(f, b.z, a.z)};
}
HWY_INLINE V3 chosen(const M& which, const V3& yes, const V3& no) {
    return {hn::IfThenElse(which, yes.x, no.x), hn::IfThenElse(which, yes.y, no.y),
            hn::IfThenElse(which, yes.z, no.z)};
}
HWY_INLINE V3 normal_of(const Prepared::Face& face) {
    return {number(face.x), number(face.y), number(face.z)};
}

// How a ray meets a plane: at distance depth / towards. The quotient is formed only for the nearest
// plane.
struct Meeting {
    V towards, depth;
};
HWY_INLINE Meeting meeting(const Prepared::Face& face, const V3& at, const V3& direction) {
    const V3 n = normal_of(face);
    return {dot(n, direction), hn::Max(number(face.offset) - dot(n, at), number(k_tiny))};
}
// Of planes that rays run towards, the nearer has the larger towards / depth.
HWY_INLINE M nearer(const Meeting& a, const Meeting& b) {
    return a.towards * b.depth > b.towards * a.depth;
}

HWY_INLINE V light(const Prepared& scene, const V3& d) {
    V sum = number(scene.constant);
    for (const Prepared::Lobe& lobe : scene.lobes) {
        const V3 axis{number(lobe.x), number(lobe.y), number(lobe.z)};
        V square = hn::Max(dot(axis, d), number(0.0f)), power = number(1.0f);
        for (int e = lobe.exponent; e > 0; e >>= 1, square = square * square) {
            if (e & 1) power = power * square;
        }
        sum = hn::MulAdd(power, number(lobe.radiance), sum);
    }
    return sum;
}

struct Hit {
    V3 normal;
    Meeting meeting;
};

template <bool kPolarised, bool kWalk>
class Packets {
public:
    HWY_INLINE explicit Packets(const Prepared& scene) : scene_(scene) {
        std::fill_n(guess_, k_most_depth, 0);
    }

    HWY_INLINE V radiance(const V3& direction) {
        const V3 origin{number(scene_.origin[0]), number(scene_.origin[1]),
                        number(scene_.origin[2])};
        const V along = dot(origin, direction);
        const V beside = dot(origin, origin) - along * along;
        M hits = beside < number(scene_.radius * scene_.radius);
        Hit hit;
        if (!hn::AllFalse(k_floats, hits)) hits = enter(origin, direction, hits, hit);
        V sum = number(0.0f);
        if (!hn::AllTrue(k_floats, hits)) sum = hn::IfThenZeroElse(hits, light(scene_, direction));
        if (hn::AllFalse(k_floats, hits)) return sum;
        return hn::IfThenElse(hits, inside(origin, direction, hits, hit), sum);
    }

private:
    // The face of the packet before if all rays are in it, else the farthest of the planes that the
    // eye is above. Returns which rays meet the stone.
    HWY_INLINE M enter(const V3& origin, const V3& direction, const M& wanted, Hit& hit) {
        const Prepared::Face& guess = scene_.faces[static_cast<std::size_t>(guess_[0])];
        if (guess.front) {
            hit.meeting = before(guess, origin, direction);
            hit.normal = normal_of(guess);
            const V3 at = plus(origin, hit.meeting.depth / hit.meeting.towards, direction);
            V most = number(-1.0f);
            for (std::uint32_t i = 0; i < guess.count; ++i) {
                const Prepared::Face& face =
                    scene_.faces[scene_.neighbours[static_cast<std::size_t>(guess.first + i)]];
                most = hn::Max(most, dot(normal_of(face), at) - number(face.offset));
            }
            // In it by more than rounding errors.
            const M in =
                hn::And(hit.meeting.towards > number(0.0f), most < number(-1e-6f * scene_.radius));
            if (hn::AllTrue(k_floats, hn::Or(in, hn::Not(wanted)))) return wanted;
        }
        // Rays enter through the farthest of these, if it is nearer than the first plane on the way
        // out.
        Meeting far{number(k_tiny), number(0.0f)}, near{number(k_tiny), number(1.0f)};
        V3 normal{number(0.0f), number(0.0f), number(1.0f)};
        V facet = number(0.0f);
        for (std::size_t f = 0; f < scene_.faces.size(); ++f) {
            const Prepared::Face& face = scene_.faces[f];
            if (face.front) {
                const Meeting here = before(face, origin, direction);
                const M beyond = nearer(far, here);
                far.towards = hn::IfThenElse(beyond, here.towards, far.towards);
                far.depth = hn::IfThenElse(beyond, here.depth, far.depth);
                normal = chosen(beyond, normal_of(face), normal);
                facet = hn::IfThenElse(beyond, number(static_cast<float>(f)), facet);
            } else {
                const Meeting here = meeting(face, origin, direction);
                const M closer = nearer(here, near);
                near.towards = hn::IfThenElse(closer, here.towards, near.towards);
                near.depth = hn::IfThenElse(closer, here.depth, near.depth);
            }
        }
        hit = {normal, far};
        const M hits = hn::And(wanted, nearer(far, near));
        const auto first = hn::FindFirstTrue(k_floats, hits);
        if (first >= 0) guess_[0] = lane(facet, first);
        return hits;
    }
    // For a face below the eye: a meeting with both signs reversed.
    HWY_INLINE static Meeting before(const Prepared::Face& face, const V3& origin,
                                     const V3& direction) {
        const V3 n = normal_of(face);
        return {hn::Max(hn::Neg(dot(n, direction)), number(k_tiny)),
                dot(n, origin) - number(face.offset)};
    }
    HWY_INLINE static int lane(const V& values, std::intptr_t which) {
        HWY_ALIGN float stored[64];
        hn::Store(values, k_floats, stored);
        return static_cast<int>(stored[which]);
    }

    // A meeting nearer than those with all neighbours is the nearest: the facets are the corners of
    // the polar body, over which towards / depth is linear.
    HWY_INLINE Hit exit(const V3& at, const V3& direction, M open, int& guess) const {
        Hit hit{direction, {number(1.0f), number(1.0f)}};
        int f = guess;
        for (int step = 0; step < k_most_steps; ++step) {
            const Prepared::Face& face = scene_.faces[static_cast<std::size_t>(f)];
            const Meeting here = meeting(face, at, direction);
            Meeting best = here;
            V facet = number(static_cast<float>(f));
            const std::uint16_t* next = scene_.neighbours.data() + face.first;
            for (std::uint32_t i = 0; i < face.count; ++i) {
                const Meeting there = meeting(scene_.faces[next[i]], at, direction);
                const M better = nearer(there, best);
                best.towards = hn::IfThenElse(better, there.towards, best.towards);
                best.depth = hn::IfThenElse(better, there.depth, best.depth);
                facet = hn::IfThenElse(better, number(static_cast<float>(next[i])), facet);
            }
            const M settled = hn::And(open, facet == number(static_cast<float>(f)));
            hit.normal = chosen(settled, normal_of(face), hit.normal);
            hit.meeting.towards = hn::IfThenElse(settled, here.towards, hit.meeting.towards);
            hit.meeting.depth = hn::IfThenElse(settled, here.depth, hit.meeting.depth);
            open = hn::AndNot(settled, open);
            guess = f;
            const auto first = hn::FindFirstTrue(k_floats, open);
            if (first < 0) return hit;
            f = lane(facet, first);
        }
        const Hit others = exit_of_all(at, direction);
        hit.normal = chosen(open, others.normal, hit.normal);
        hit.meeting.towards = hn::IfThenElse(open, others.meeting.towards, hit.meeting.towards);
        hit.meeting.depth = hn::IfThenElse(open, others.meeting.depth, hit.meeting.depth);
        return hit;
    }
    HWY_INLINE Hit exit_of_all(const V3& at, const V3& direction) const {
        Hit hit{direction, {number(0.0f), number(1.0f)}};
        for (const Prepared::Face& face : scene_.faces) {
            const Meeting here = meeting(face, at, direction);
            const M better = nearer(here, hit.meeting);
            hit.normal = chosen(better, normal_of(face), hit.normal);
            hit.meeting.towards = hn::IfThenElse(better, here.towards, hit.meeting.towards);
            hit.meeting.depth = hn::IfThenElse(better, here.depth, hit.meeting.depth);
        }
        return hit;
    }

    HWY_INLINE V inside(const V3& origin, const V3& eye, const M& hits, const Hit& entry) {
        const float n = scene_.n;
        const V one = number(1.0f), zero = number(0.0f), half = number(0.5f), e = number(n * n),
                excess = number((n - 1) * (n + 1));
        V3 at = plus(origin, entry.meeting.depth / entry.meeting.towards, eye);
        V3 before = entry.normal;
        const V q1 = hn::Min(entry.meeting.towards, one);
        const V q2 = hn::Sqrt(hn::MulAdd(q1, q1, excess));
        const V r_s = (q1 - q2) / (q1 + q2), r_p = (e * q1 - q2) / hn::MulAdd(e, q1, q2);
        const V R_s = r_s * r_s, R_p = r_p * r_p, R = half * (R_s + R_p);
        V sum = R * light(scene_, plus(eye, q1 + q1, before));
        V I = one - R, Q = half * (R_p - R_s), U = zero, W = zero;
        const V over_n = number(1.0f / n), bend = (q1 - q2) * over_n;
        V3 d{hn::MulAdd(bend, before.x, over_n * eye.x), hn::MulAdd(bend, before.y, over_n * eye.y),
             hn::MulAdd(bend, before.z, over_n * eye.z)};
        V cosine_before = hn::Neg(q2) * over_n;
        for (int k = 1; k < scene_.depth; ++k) {
            const Hit hit = kWalk ? exit(at, d, hits, guess_[k]) : exit_of_all(at, d);
            const V3& a = hit.normal;
            const V cosine = hit.meeting.towards;
            at = plus(at, hit.meeting.depth / hn::Max(cosine, number(k_tiny)), d);
            if constexpr (kPolarised) turn(a, before, d, cosine, cosine_before, Q, U);
            const V inner = number(n) * cosine;
            const V outer_squared = hn::MulSub(inner, inner, excess);
            const M out = hn::And(hits, outer_squared > zero);
            V S = one, P = one, re = one, im = zero;
            const bool any_out = !hn::AllFalse(k_floats, out);
            if (any_out) {
                const V outer = hn::Sqrt(hn::Max(outer_squared, zero));
                const V s = (inner - outer) / (inner + outer),
                        p = (inner - e * outer) / hn::MulAdd(e, outer, inner);
                S = hn::IfThenElse(out, s * s, one);
                P = hn::IfThenElse(out, p * p, one);
                re = hn::IfThenElse(out, s * p, one);
                V weight = (one - half * (S + P)) * I;
                if constexpr (kPolarised) weight = hn::MulAdd(half * (P - S), Q, weight);
                const V shift = outer - inner;
                const V3 leaving{hn::MulAdd(shift, a.x, number(n) * d.x),
                                 hn::MulAdd(shift, a.y, number(n) * d.y),
                                 hn::MulAdd(shift, a.z, number(n) * d.z)};
                sum = hn::MulAdd(hn::IfThenElseZero(out, weight), light(scene_, leaving), sum);
            }
            if constexpr (kPolarised) {
                // r_s r_p* of total reflection: twice the angle of A + i B.
                const V kappa = hn::Sqrt(hn::Max(hn::Neg(outer_squared), zero));
                const V A = hn::MulAdd(e * kappa, kappa, inner * inner), B = excess * kappa * inner;
                const V scale = one / hn::Max(hn::MulAdd(A, A, B * B), number(1e-30f));
                re = hn::IfThenElse(out, re, hn::MulSub(A, A, B * B) * scale);
                im = hn::IfThenElse(out, zero, (A + A) * B * scale);
                const V mean = half * (S + P), difference = half * (S - P), I0 = I, U0 = U;
                I = hn::MulAdd(mean, I0, difference * Q);
                Q = hn::MulAdd(difference, I0, mean * Q);
                U = hn::MulSub(re, U0, im * W);
                W = hn::MulAdd(im, U0, re * W);
                before = a;
                cosine_before = hn::Neg(cosine);
            } else if (any_out) {
                I = I * half * (S + P);
            }
            d = plus(d, hn::Neg(cosine + cosine), a);
        }
        return sum;
    }

    // Rotates Q and U from d x b of the face behind into the tangent d x a of the face ahead.
    HWY_INLINE static void turn(const V3& a, const V3& b, const V3& d, const V& cosine,
                                const V& cosine_before, V& Q, V& U) {
        const V3 cross{b.y * a.z - b.z * a.y, b.z * a.x - b.x * a.z, b.x * a.y - b.y * a.x};
        const V along = dot(a, b) - cosine * cosine_before, across = dot(d, cross);
        const V al = along * along, ac = across * across, length = al + ac;
        const M any = length > number(1e-24f);
        const V scale = number(1.0f) / hn::IfThenElse(any, length, number(1.0f));
        const V cosine2 = hn::IfThenElse(any, (al - ac) * scale, number(1.0f));
        const V sine2 = hn::IfThenElseZero(any, (along + along) * across * scale);
        const V Q0 = Q;
        Q = hn::MulAdd(cosine2, Q0, sine2 * U);
        U = hn::NegMulAdd(sine2, Q0, cosine2 * U);
    }

    // If a packet's walk needs more faces, testing all planes is faster.
    static constexpr int k_most_steps = 12;
    const Prepared& scene_;
    int guess_[k_most_depth];
};

template <bool kPolarised, bool kWalk>
void draw_all(const Prepared& scene, int across, float* sums) {
    Packets<kPolarised, kWalk> packets(scene);
    constexpr int k_room = 64;
    const int lanes = static_cast<int>(hn::Lanes(k_floats));
    // Tiles as square as a power of two allows.
    int wide = 1;
    while (wide * wide < lanes) wide *= 2;
    const int high = lanes / wide, width = scene.width * across, height = scene.height * across;
    HWY_ALIGN float dx[k_room], dy[k_room], seen[k_room];
    for (int i = 0; i < lanes; ++i) {
        dx[i] = static_cast<float>(i % wide) + 0.5f;
        dy[i] = static_cast<float>(i / wide) + 0.5f;
    }
    const float step = 1 / static_cast<float>(across);
    const int columns = (width + wide - 1) / wide;
    for (int y0 = 0, row = 0; y0 < height; y0 += high, ++row) {
        for (int column = 0; column < columns; ++column) {
            // In alternating directions, so that each packet is next to the one before.
            const int x0 = (row % 2 == 0 ? column : columns - 1 - column) * wide;
            const V x = (hn::Load(k_floats, dx) + number(static_cast<float>(x0))) * number(step),
                    y = (hn::Load(k_floats, dy) + number(static_cast<float>(y0))) * number(step);
            const auto part = [&](int i) HWY_ATTR {
                return hn::MulAdd(x, number(scene.right[i]),
                                  hn::MulAdd(y, number(scene.down[i]), number(scene.direction[i])));
            };
            V3 d{part(0), part(1), part(2)};
            const V over = number(1.0f) / hn::Sqrt(dot(d, d));
            d = {over * d.x, over * d.y, over * d.z};
            hn::Store(packets.radiance(d), k_floats, seen);
            for (int i = 0; i < lanes; ++i) {
                const int px = x0 + i % wide, py = y0 + i / wide;
                if (px < width && py < height)
                    sums[(py / across) * scene.width + px / across] += seen[i];
            }
        }
    }
}

void DrawPlainly(const Prepared& scene, const PlainTracing& how, float* sums) {
    const bool walk = how.search == ExitSearch::walk;
    if (how.polarised) {
        (walk ? draw_all<true, true> : draw_all<true, false>)(scene, how.across, sums);
    } else {
        (walk ? draw_all<false, true> : draw_all<false, false>)(scene, how.across, sums);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace culet {

HWY_EXPORT(DrawPlainly);

PlainTracer::PlainTracer(const Scene& scene) : prepared_(std::make_unique<Prepared>()) {
    const Lights& lights = scene.lights;
    if (lights.environment || count_lights<CosinePowerLight>(lights) < lights.sources.size() ||
        polarised(lights) || scene.camera.aperture_radius > 0 ||
        scene.settings.wavelengths_nm.empty() || scene.settings.depth < 1 ||
        scene.settings.depth > 64)
        throw InputError("the plain tracer takes lobes, a pinhole, a wavelength and a depth <= 64");
    Prepared& p = *prepared_;
    const FacetNet net(scene.stone.solid);
    Vec3 low(1e300), high(-1e300);
    for (const Vec3& corner : net.corners()) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    const Vec3 middle = 0.5 * (low + high), eye = scene.camera.position - middle;
    const auto number = [](double v) { return static_cast<float>(v); };
    for (const Vec3& corner : net.corners())
        p.radius = std::max(p.radius, number(1.001 * glm::length(corner - middle)));
    for (int f = 0; f < net.facets(); ++f) {
        const Vec3& n = net.plane(f).normal;
        const double offset = net.plane(f).offset - glm::dot(n, middle);
        p.faces.push_back({number(n.x), number(n.y), number(n.z), number(offset),
                           static_cast<std::uint32_t>(p.neighbours.size()),
                           static_cast<std::uint32_t>(net.edges(f).size()),
                           glm::dot(n, eye) > offset});
        for (const NetEdge& edge : net.edges(f))
            p.neighbours.push_back(static_cast<std::uint16_t>(edge.beyond));
    }
    p.constant = number(lights.constant);
    for (const CosinePowerLight& lobe : lights_of_type<CosinePowerLight>(lights)) {
        if (lobe.exponent != std::floor(lobe.exponent) || lobe.exponent > 1024)
            throw InputError("the plain tracer takes whole exponents of lobes");
        const Vec3& d = lobe.direction;
        p.lobes.push_back({number(d.x), number(d.y), number(d.z), static_cast<int>(lobe.exponent),
                           number(std::get<double>(lobe.radiance.value))});
    }
    const double nm = scene.settings.wavelengths_nm.front();
    p.n = number(scene.stone.material.index[0].at(nm) / scene.immersion);
    const ScreenView view = screen_view(scene.camera);
    const Vec3 corner = view.towards({0, 0});
    const Vec3 right = view.towards({1, 0}) - corner, down = view.towards({0, 1}) - corner;
    for (int i = 0; i < 3; ++i) {
        p.origin[i] = number(eye[i]);
        p.direction[i] = number(corner[i]);
        p.right[i] = number(right[i]);
        p.down[i] = number(down[i]);
    }
    p.width = scene.camera.width;
    p.height = scene.camera.height;
    p.depth = scene.settings.depth;
}

PlainTracer::~PlainTracer() = default;

void PlainTracer::draw(const PlainTracing& how, Picture& picture) const {
    picture.width = prepared_->width;
    picture.height = prepared_->height;
    std::vector<float> sums(picture.pixels(), 0.0f);
    HWY_DYNAMIC_DISPATCH(DrawPlainly)(*prepared_, how, sums.data());
    picture.rgb.resize(3 * picture.pixels());
    const float share = 1 / static_cast<float>(how.across * how.across);
    for (std::size_t i = 0; i < picture.pixels(); ++i) {
        float* rgb = picture.rgb.data() + 3 * i;
        rgb[0] = rgb[1] = rgb[2] = share * sums[i];
    }
}

}  // namespace culet
#endif
