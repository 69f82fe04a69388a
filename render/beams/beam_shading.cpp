#include "render/beams/beam_shading.h"

#include <algorithm>

#include "render/beams/beam_forms.h"
#include "render/optics/band.h"
#include "render/setup/built_effects.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/beams/beam_shading.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h and in this order, each needing the one before.
// clang-format off
#include "render/beams/vectors-inl.h"
#include "render/beams/lights-inl.h"
#include "render/beams/crystal-inl.h"
#include "render/beams/follower-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace culet {
namespace HWY_NAMESPACE {

// A whole pixel up to rounding.
constexpr float k_filled = 1 - 1e-5f;

template <bool kSoft>
void background(const ShadedLights& lights, const ShadedOptics& optics, const ShadedEye& eye,
                const BareRow& row) {
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
    const V dy = number(row.y);
    for (int first = 0; first < row.count; first += lanes) {
        const int here = std::min(lanes, row.count - first);
        HWY_ALIGN float part[k_most_lanes];
        const float* cover = row.cover + first;
        if (here < lanes) {
            std::copy_n(cover, here, part);
            std::fill(part + here, part + lanes, 1.0f);
            cover = part;
        }
        const V covered = hn::LoadU(k_floats, cover);
        const M open = covered < number(k_filled);
        if (hn::AllFalse(k_floats, open)) continue;
        const V bare = hn::IfThenElseZero(open, number(row.factor) * (number(1.0f) - covered));
        const V dx = hn::Iota(k_floats, row.x + static_cast<float>(first));
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
        for (int i = 0; i < lights.nodes; ++i) {
            float* to = row.radiance + static_cast<size_t>(i) * row.stride + first;
            if (here == lanes) {
                hn::StoreU(hn::MulAdd(bare, sum[i], hn::LoadU(k_floats, to)), k_floats, to);
            } else {
                hn::Store(bare * sum[i], k_floats, part);
                for (int k = 0; k < here; ++k) to[k] += part[k];
            }
        }
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
        Ray ray{vector_at(beam.point),
                direction,
                vector(beam.point[1]),
                vector(beam.point[2]),
                vector(beam.direction[1]),
                vector(beam.direction[2]),
                fragments.xx != nullptr ? &fragments : nullptr,
                first};
        if constexpr (kSoft) {
            const PixelPart part = part_of(fragments, first);
            ray.point_x = part.along(ray.point_x, ray.point_y);
            ray.point_y = part.across(ray.point_y);
            ray.direction_x = part.along(ray.direction_x, ray.direction_y);
            ray.direction_y = part.across(ray.direction_y);
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
                     const BareRow& row) {
    if (row.soft && lights.any_edge) {
        background<true>(lights, optics, eye, row);
    } else {
        background<false>(lights, optics, eye, row);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace culet
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace culet {

HWY_EXPORT(ShadeBackground);
HWY_EXPORT(ShadeLeaving);

void shade_beam(const ShadingJob& job, const ShadedEye& eye, const std::uint16_t* facets,
                int facet_count, const Fragments& fragments) {
    auto* shade = shade_sharp_beam;
    if (fragments.soft && job.lights->any_edge) {
        shade = polarised(job) ? shade_soft_polarised_beam : shade_soft_beam;
    }
    shade(job, eye, facets, facet_count, fragments);
}

void shade_background(const ShadedLights& lights, const ShadedOptics& optics, const ShadedEye& eye,
                      const BareRow& row) {
    HWY_DYNAMIC_DISPATCH(ShadeBackground)(lights, optics, eye, row);
}

void shade_leaving(const ShadedLights& lights, const ShadedLeaving& beam,
                   const Fragments& fragments) {
    HWY_DYNAMIC_DISPATCH(ShadeLeaving)(lights, beam, fragments);
}

std::vector<std::string> shading_targets() {
    // Listed before any target is chosen.
    static const std::vector<std::string> names = [] {
        std::vector<std::string> found;
        for (std::int64_t target : hwy::SupportedAndGeneratedTargets())
            found.emplace_back(hwy::TargetName(target));
        return found;
    }();
    return names;
}

bool use_shading_target(const std::string& name) {
    shading_targets();
    hwy::SetSupportedTargetsForTest(0);
    for (std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (name != hwy::TargetName(target)) continue;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        return true;
    }
    return false;
}

}  // namespace culet
#endif
