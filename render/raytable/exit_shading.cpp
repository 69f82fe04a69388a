#include "render/raytable/exit_lights.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/raytable/exit_shading.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h and in this order, each needing the one before.
// clang-format off
#include "render/beams/vectors-inl.h"
#include "render/beams/lights-inl.h"
#include "render/raytable/environment-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

using Shorts = hn::Rebind<std::uint16_t, Floats>;
constexpr Shorts k_shorts;

HWY_INLINE hn::Vec<Ints> whole_at(const std::uint16_t* p) {
    return hn::PromoteTo(k_ints, hn::LoadU(k_shorts, p));
}
HWY_INLINE V number_at(const std::uint16_t* p) {
    return hn::ConvertTo(k_floats, whole_at(p));
}

// As in octahedral_codes.h. In single precision each coordinate is off by up to 2^-24.
HWY_INLINE V3 direction_at(const std::int32_t* first, const std::int32_t* second) {
    const V step = number(1 / 2147483648.0f), zero = number(0.0f);
    V x = step * hn::ConvertTo(k_floats, hn::LoadU(k_ints, first)),
      y = step * hn::ConvertTo(k_floats, hn::LoadU(k_ints, second));
    const V z = number(1.0f) - hn::Abs(x) - hn::Abs(y);
    const V below = hn::Max(hn::Neg(z), zero);
    x = x - hn::CopySign(below, x);
    y = y - hn::CopySign(below, y);
    const V3 d{x, y, z};
    return number(1.0f) / length_of(d) * d;
}

HWY_INLINE V3 point_at(const ExitFrames& frames, const ExitRun& run, int i) {
    const V step = number(1 / 65535.0f);
    const V s = step * number_at(run.point[0] + i), t = step * number_at(run.point[1] + i);
    const auto facet = whole_at(run.facet + i);
    const float* plane = frames.numbers.data();
    const auto next = [&]() HWY_ATTR {
        const V of = hn::GatherIndex(k_floats, plane, facet);
        plane += frames.facets;
        return of;
    };
    V3 at, u, v;
    for (V3* vector : {&at, &u, &v}) {
        vector->x = next();
        vector->y = next();
        vector->z = next();
    }
    return plus(plus(at, s, u), t, v);
}

// Adds light to the nodes' sums. `kNodes`: their number, or 0 for any.
template <int kNodes>
struct Sums {
    V* of;
    int all;
    HWY_INLINE int nodes() const { return kNodes > 0 ? kNodes : all; }
    HWY_INLINE void operator()(const V& factor, const float* radiance,
                               const ShadedLights::Polarised&) const {
        for (int i = 0; i < nodes(); ++i) of[i] = hn::MulAdd(factor, number(radiance[i]), of[i]);
    }
};

template <int kNodes>
HWY_INLINE void all_light(const ExitLights& lights, const Ray& ray, V* sum) {
    const Sums<kNodes> sums{sum, lights.nodes};
    for (int i = 0; i < sums.nodes(); ++i) sum[i] = number(0.0f);
    V unhidden = number(1.0f);
    if (lights.any_near) unhidden = near_light<false>(lights.others, ray, number(3e38f), sums);
    distant_light<false>(lights.others, ray, unhidden, sums);
    for (const ExitLights::Cap& cap : lights.caps) {
        const V3 beside = plus(vector(cap.axis), number(-1.0f), ray.direction);
        const V chord = dot(beside, beside);
        const M within = hn::And(chord < number(cap.outer), chord >= number(cap.inner));
        sums(hn::IfThenElseZero(within, unhidden), cap.radiance.data(), {});
    }
    if (lights.environment) environment_light<kNodes>(lights, ray.direction, unhidden, sum);
}

// Shades exit events i .. i + lanes - 1 into out[node * stride]. Adds their weights after
// absorption, over all nodes, to `weighed`.
template <int kNodes>
HWY_INLINE void shade_vector(const ExitLights& lights, const ExitFrames& frames, const ExitRun& run,
                             const ExitAbsorption& absorption, int i, float* out, int stride,
                             V& weighed) {
    const V3 none{number(0.0f), number(0.0f), number(0.0f)};
    Ray ray{none, direction_at(run.direction[0] + i, run.direction[1] + i), none, none, none, none};
    if (lights.any_near) ray.point = point_at(frames, run, i);
    V sum[kNodes > 0 ? kNodes : k_band_nodes];
    all_light<kNodes>(lights, ray, sum);
    const V weight = hn::LoadU(k_floats, run.weight + i);
    V length[3];
    int lengths = 0;
    for (; lengths < 3 && run.length[lengths] != nullptr; ++lengths)
        length[lengths] = number_at(run.length[lengths] + i);
    for (int node = 0; node < Sums<kNodes>{sum, lights.nodes}.nodes(); ++node) {
        V brings = weight;
        if (lengths > 0) {
            V exponent = number(0.0f);
            for (int k = 0; k < lengths; ++k)
                exponent = hn::NegMulAdd(length[k], number(absorption[k][node]), exponent);
            brings = weight * decayed(exponent);
        }
        weighed = weighed + brings;
        hn::StoreU(brings * sum[node], k_floats, out + node * stride);
    }
}

// The events left after full vectors, padded with events of no weight.
struct Tail {
    float weight[k_most_lanes] = {};
    std::int32_t direction[2][k_most_lanes] = {};
    std::uint16_t point[2][k_most_lanes] = {}, facet[k_most_lanes] = {},
                  length[3][k_most_lanes] = {};
    float out[k_band_nodes * k_most_lanes];

    ExitRun of(const ExitRun& run, int from) {
        const int count = run.count - from;
        ExitRun tail;
        const auto copy = [&](auto* to, const auto* list) {
            std::copy_n(list + from, count, to);
            return to;
        };
        tail.weight = copy(weight, run.weight);
        for (size_t k = 0; k < 2; ++k) {
            tail.direction[k] = copy(direction[k], run.direction[k]);
            tail.point[k] = copy(point[k], run.point[k]);
        }
        tail.facet = copy(facet, run.facet);
        for (size_t k = 0; k < 3; ++k) {
            if (run.length[k] != nullptr) tail.length[k] = copy(length[k], run.length[k]);
        }
        return tail;
    }
};

template <int kNodes>
double shade_all(const ExitLights& lights, const ExitFrames& frames, const ExitRun& run,
                 const ExitAbsorption& absorption, float* radiance, int stride) {
    const int lanes = static_cast<int>(hn::Lanes(k_floats));
    V weighed = number(0.0f);
    int i = 0;
    for (; i + lanes <= run.count; i += lanes)
        shade_vector<kNodes>(lights, frames, run, absorption, i, radiance + i, stride, weighed);
    if (i < run.count) {
        Tail tail;
        const ExitRun rest = tail.of(run, i);
        shade_vector<kNodes>(lights, frames, rest, absorption, 0, tail.out, lanes, weighed);
        for (int node = 0; node < lights.nodes; ++node)
            std::copy_n(tail.out + node * lanes, run.count - i, radiance + node * stride + i);
    }
    HWY_ALIGN float part[k_most_lanes];
    hn::Store(weighed, k_floats, part);
    double sum = 0;
    for (int lane = 0; lane < lanes; ++lane) sum += static_cast<double>(part[lane]);
    return sum / lights.nodes;
}

double ShadeExits(const ExitLights& lights, const ExitFrames& frames, const ExitRun& run,
                  const ExitAbsorption& absorption, float* radiance, int stride) {
    const auto shade = lights.nodes == 1   ? shade_all<1>
                       : lights.nodes == 3 ? shade_all<3>
                                           : shade_all<0>;
    return shade(lights, frames, run, absorption, radiance, stride);
}

// Calls visit(ray, first, count) for one vector of rays at a time.
template <class Visit>
HWY_INLINE void each_ray(const AirRays& rays, Visit&& visit) {
    const int lanes = static_cast<int>(hn::Lanes(k_floats));
    const V3 none{number(0.0f), number(0.0f), number(0.0f)};
    for (int i = 0; i < rays.count; i += lanes) {
        const int here = std::min(lanes, rays.count - i);
        HWY_ALIGN float part[k_most_lanes];
        const auto load = [&](const std::vector<float>& list) HWY_ATTR {
            if (here == lanes) return hn::LoadU(k_floats, list.data() + i);
            std::copy_n(list.data() + i, here, part);
            std::fill(part + here, part + lanes, 0.5f);
            return hn::Load(k_floats, part);
        };
        const auto load3 = [&](const std::array<std::vector<float>, 3>& of) HWY_ATTR {
            return V3{load(of[0]), load(of[1]), load(of[2])};
        };
        visit(Ray{load3(rays.origin), load3(rays.direction), none, none, none, none}, i, here);
    }
}

HWY_INLINE void store_some(const V& v, int count, float* to) {
    if (count == static_cast<int>(hn::Lanes(k_floats))) return hn::StoreU(v, k_floats, to);
    HWY_ALIGN float part[k_most_lanes];
    hn::Store(v, k_floats, part);
    std::copy_n(part, count, to);
}

template <int kNodes>
void shade_all_rays(const ExitLights& lights, const AirRays& rays, float* radiance, int stride) {
    V sum[kNodes > 0 ? kNodes : k_band_nodes];
    each_ray(rays, [&](const Ray& ray, int first, int count) HWY_ATTR {
        all_light<kNodes>(lights, ray, sum);
        for (int node = 0; node < lights.nodes; ++node)
            store_some(sum[node], count, radiance + node * stride + first);
    });
}

void ShadeRays(const ExitLights& lights, const AirRays& rays, float* radiance, int stride) {
    const auto shade = lights.nodes == 1   ? shade_all_rays<1>
                       : lights.nodes == 3 ? shade_all_rays<3>
                                           : shade_all_rays<0>;
    shade(lights, rays, radiance, stride);
}

void NearestLights(const ExitLights& lights, const AirRays& rays, float* distance) {
    const V far = number(3e38f);
    each_ray(rays, [&](const Ray& ray, int first, int count) HWY_ATTR {
        V nearest = far;
        const auto look = [&](const V& share, const V& at) HWY_ATTR {
            nearest = hn::Min(nearest, hn::IfThenElse(share > number(0.0f), at, far));
        };
        V at = far;
        for (const auto& sphere : lights.others.spheres)
            look(sphere_share<false>(sphere, ray, at), at);
        for (const auto& plane : lights.others.planes) look(plane_share<false>(plane, ray, at), at);
        store_some(nearest, count, distance + first);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace culet {

HWY_EXPORT(ShadeExits);
HWY_EXPORT(ShadeRays);
HWY_EXPORT(NearestLights);

double shade_exits(const ExitLights& lights, const ExitFrames& frames, const ExitRun& run,
                   const ExitAbsorption& absorption, float* radiance, int stride) {
    return HWY_DYNAMIC_DISPATCH(ShadeExits)(lights, frames, run, absorption, radiance, stride);
}

void shade_rays(const ExitLights& lights, const AirRays& rays, float* radiance, int stride) {
    HWY_DYNAMIC_DISPATCH(ShadeRays)(lights, rays, radiance, stride);
}

void nearest_lights(const ExitLights& lights, const AirRays& rays, float* distance) {
    HWY_DYNAMIC_DISPATCH(NearestLights)(lights, rays, distance);
}

}  // namespace culet
#endif
